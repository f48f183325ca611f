// SPDX-License-Identifier: MIT
//
// Forward kinematics of one solved limb, counted within its group, its distance from the target, and its joint angles.
// In double, without lanes.
#pragma once

#include "batch/crowd/crowd.h"
#include "core/angle_limits.h"
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

// The arm frame in the space of the targets, as the clavicle has it or without the clavicle's turn, and the scale of
// the bones' unit there.
struct ArmFrame {
    Vector<double> shoulder;
    Rotor<double> rotation;
    double scale;
};
ArmFrame arm_frame(const Group& group, std::size_t limb, bool with_clavicle = true);
// The direction of an aiming hand's ray, likewise; of any length. hand: as solved.
Vector<double> aim_axis(const Group& group, std::size_t limb, const Rotor<double>& hand);

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

// joint_angles.cpp: a pose as joint angles, in radians.
struct JointAngles {
    double shoulder[3], flexion, wrist[3];
};
JointAngles joint_angles(const ArmRotors& arm, swivel_euler_order shoulder_order, swivel_euler_order wrist_order,
                         int family);
// The three angles of R = R_p(first) R_q(middle) R_r(last), of a family: see swivel_joint_angles().
void euler_angles(const Rotor<double>& q, const EulerOrder& order, int family, double (&angles)[3]);

}  // namespace swivel
