// SPDX-License-Identifier: MIT
//
// Forward kinematics of one solved limb, counted within its group, and its distance from the target. In double, without
// lanes.
#pragma once

#include "batch/crowd/crowd.h"
#include "core/arm.h"
#include "core/space.h"

namespace swivel {

// A binding's quaternion, normalised.
inline Rotor<double> rotor_of(const float (&q)[4]) { return normalise(rotor<double>(q[0], q[1], q[2], q[3])); }

struct LimbPose {
    Vector<double> shoulder, elbow, wrist;  // in the space of the targets
    Rotor<double> hand;                     // without SWIVEL_WITH_HAND the rotation of the wrist's parent
};

LimbPose forward(const Group& group, std::size_t limb);

// The rotations that the joints add to the rest pose, in the arm frame: unit; elbow and wrist with w >= 0.
struct ArmRotors {
    Rotor<double> shoulder, elbow, wrist;
};
ArmRotors arm_rotors(const Group& group, std::size_t limb);

// The length of both bones in the space of the targets, scaled and stretched.
double length_of(const Group& group, std::size_t limb);

// The distance of the wrist, or the effector, from the target; with an aim, of the target from the hand's ray. NaN for
// a limb with bad input.
double distance_missed(const Group& group, std::size_t limb);
// That distance over length_of(); 0 for a limb of no length.
double residual(const Group& group, std::size_t limb);

}  // namespace swivel
