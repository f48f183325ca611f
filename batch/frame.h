// SPDX-License-Identifier: MIT
//
// The frames of a job, the members of a frame and the fields they stand for.
#pragma once

#include <iterator>

#include "batch/sized.h"
#include "batch/swivel.h"
#include "simd/fields.h"

namespace swivel {

struct FrameInput {
    Field field;
    swivel_in swivel_frame::*member;
};
inline constexpr FrameInput kFrameInputs[] = {
    {Field::target, &swivel_frame::target},
    {Field::pole, &swivel_frame::pole},
    {Field::lengths, &swivel_frame::lengths},
    {Field::shoulder_position, &swivel_frame::shoulder_position},
    {Field::parent_rotation, &swivel_frame::parent_rotation},
    {Field::parent_scale, &swivel_frame::parent_scale},
    {Field::hand, &swivel_frame::hand},
    {Field::effector, &swivel_frame::effector},
    {Field::angle, &swivel_frame::angle},
    {Field::incoming_shoulder, &swivel_frame::incoming_shoulder},
    {Field::incoming_elbow, &swivel_frame::incoming_elbow},
    {Field::incoming_wrist, &swivel_frame::incoming_wrist},
    {Field::weights, &swivel_frame::weights},
    {Field::reach, &swivel_frame::reach},
    {Field::most_swivel, &swivel_frame::most_swivel},
    {Field::flexion_limit, &swivel_frame::flexion_limit},
    {Field::shoulder_cone, &swivel_frame::shoulder_cone},
    {Field::humeral_twist, &swivel_frame::humeral_twist},
    {Field::shoulder_box, &swivel_frame::shoulder_box},
    {Field::hand_cone, &swivel_frame::hand_cone},
    {Field::forearm_twist, &swivel_frame::forearm_twist},
    {Field::hand_twist, &swivel_frame::hand_twist},
    {Field::wrist_box, &swivel_frame::wrist_box},
    {Field::aim, &swivel_frame::aim},
    {Field::clavicle, &swivel_frame::clavicle},
};

static_assert(std::size(kFrameInputs) == kInputCount, "every input");

struct FrameOutput {
    Field field;
    swivel_out swivel_frame::*member;
};
inline constexpr FrameOutput kFrameOutputs[] = {
    {Field::shoulder, &swivel_frame::shoulder},
    {Field::elbow, &swivel_frame::elbow},
    {Field::wrist, &swivel_frame::wrist},
    {Field::flags, &swivel_frame::flags},
    {Field::stretch, &swivel_frame::stretch},
    {Field::normal, &swivel_frame::normal},
    {Field::twist_bones, &swivel_frame::twist_bones},
    {Field::clavicle_turn, &swivel_frame::clavicle_turn},
};
static_assert(std::size(kFrameOutputs) == kFieldCount - kInputCount, "every result");

// The frame of a group. If an older header made the frames shorter, it is a copy in `filled`.
inline const swivel_frame& frame_at(const swivel_frame* frames, std::size_t group, swivel_frame& filled)
{
    const char* const at = reinterpret_cast<const char*>(frames) + group * size_of(frames);
    return whole(reinterpret_cast<const swivel_frame*>(at), swivel_default_frame, filled);
}

}  // namespace swivel
