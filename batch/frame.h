// SPDX-License-Identifier: MIT
//
// The members of a swivel_frame and the fields they stand for.
#pragma once

#include <iterator>

#include "batch/swivel.h"

namespace swivel {

struct FrameInput {
    swivel_field field;
    swivel_in swivel_frame::*member;
};
inline constexpr FrameInput kFrameInputs[] = {
    {SWIVEL_TARGET, &swivel_frame::target},
    {SWIVEL_POLE, &swivel_frame::pole},
    {SWIVEL_LENGTHS, &swivel_frame::lengths},
    {SWIVEL_SHOULDER_POSITION, &swivel_frame::shoulder_position},
    {SWIVEL_PARENT_ROTATION, &swivel_frame::parent_rotation},
    {SWIVEL_PARENT_SCALE, &swivel_frame::parent_scale},
    {SWIVEL_HAND, &swivel_frame::hand},
    {SWIVEL_EFFECTOR, &swivel_frame::effector},
    {SWIVEL_ANGLE, &swivel_frame::angle},
    {SWIVEL_INCOMING_SHOULDER, &swivel_frame::incoming_shoulder},
    {SWIVEL_INCOMING_ELBOW, &swivel_frame::incoming_elbow},
    {SWIVEL_INCOMING_WRIST, &swivel_frame::incoming_wrist},
    {SWIVEL_WEIGHTS, &swivel_frame::weights},
    {SWIVEL_REACH, &swivel_frame::reach},
    {SWIVEL_MOST_SWIVEL, &swivel_frame::most_swivel},
    {SWIVEL_FLEXION_LIMIT, &swivel_frame::flexion_limit},
    {SWIVEL_SHOULDER_CONE, &swivel_frame::shoulder_cone},
    {SWIVEL_HUMERAL_TWIST, &swivel_frame::humeral_twist},
    {SWIVEL_SHOULDER_BOX, &swivel_frame::shoulder_box},
    {SWIVEL_HAND_CONE, &swivel_frame::hand_cone},
    {SWIVEL_FOREARM_TWIST, &swivel_frame::forearm_twist},
    {SWIVEL_HAND_TWIST, &swivel_frame::hand_twist},
    {SWIVEL_WRIST_BOX, &swivel_frame::wrist_box},
    {SWIVEL_AIM, &swivel_frame::aim},
    {SWIVEL_CLAVICLE, &swivel_frame::clavicle},
};

static_assert(std::size(kFrameInputs) == SWIVEL_SHOULDER, "every input");

struct FrameOutput {
    swivel_field field;
    swivel_out swivel_frame::*member;
};
inline constexpr FrameOutput kFrameOutputs[] = {
    {SWIVEL_SHOULDER, &swivel_frame::shoulder}, {SWIVEL_ELBOW, &swivel_frame::elbow},
    {SWIVEL_WRIST, &swivel_frame::wrist},       {SWIVEL_FLAGS, &swivel_frame::flags},
    {SWIVEL_STRETCH, &swivel_frame::stretch},   {SWIVEL_NORMAL, &swivel_frame::normal},
    {SWIVEL_TWIST_BONES, &swivel_frame::twist}, {SWIVEL_CLAVICLE_TURN, &swivel_frame::clavicle_turn},
};
static_assert(std::size(kFrameOutputs) == SWIVEL_FIELD_COUNT - SWIVEL_SHOULDER, "every result");

}  // namespace swivel
