// SPDX-License-Identifier: MIT
//
// Forward kinematics of one solved limb, counted within its group, and how far it is from its target. It is in double
// and needs no lanes.
#pragma once

#include "batch/crowd/crowd.h"
#include "core/arm.h"
#include "core/space.h"

namespace swivel {

// A binding's quaternion, normalised.
inline Rotor<double> rotor_of(const float (&q)[4]) { return normalise(rotor<double>(q[0], q[1], q[2], q[3])); }

struct LimbPose {
    Vector<double> shoulder, elbow, wrist;  // in the space of the targets
    Rotor<double> hand;                     // without SWIVEL_WITH_HAND that of the wrist's parent joint
};

LimbPose forward(const Group& group, std::size_t limb);

// The rotations that the joints add to the rest pose, in the arm frame: of unit length, the elbow and the wrist with w
// >= 0.
struct ArmRotors {
    Rotor<double> shoulder, elbow, wrist;
};
ArmRotors arm_rotors(const Group& group, std::size_t limb);

// Both bones' length in the space of the targets, scaled and stretched.
double length_of(const Group& group, std::size_t limb);

// How far the wrist, or the effector, is from the target, or with an aim the target from the hand's ray. residual() is
// that over both bones' length, scaled and stretched: 0 for a limb of no length. NaN for a limb with bad input.
double distance_missed(const Group& group, std::size_t limb);
double residual(const Group& group, std::size_t limb);

}  // namespace swivel
