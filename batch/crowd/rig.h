// SPDX-License-Identifier: MIT
//
// Makes a limb at rest from joints of a skeleton, named by index, and a binding from a limb at rest: bone lengths and
// axes, bend, and the constant rotors between arm frame and joints.
#pragma once

#include <optional>

#include "core/conformal.h"
#include "include/swivel/swivel_bodies.h"

namespace swivel {

// A joint at rest, below another one. The joints between them are rigid.
struct RestJoint {
    Rotor<double> rotation;                // relative to its parent, of any usable length
    std::optional<Rotor<double>> between;  // its parent's, unit, relative to the joint above; none if they are the same
    Vector<double> place;                  // in the joint above's frame
};

// A limb at rest.
struct RestLimb {
    RestJoint shoulder, elbow, wrist;  // of the shoulder only the rotation counts
    Vector<double> bend;               // in the shoulder's frame
    std::uint32_t twist_bone_count;
    RestJoint twist_bones[SWIVEL_MAX_TWIST_BONES];  // below the elbow
};

// skeleton.cpp, which knows no arm frame. Gives the limb of these joints as swivel_bind_joints() promises, or a
// refusal.
swivel_status rest_limb(const swivel_skeleton& skeleton, const swivel_limb_joints& joints, RestLimb& limb);

// Refuses a joint that is not in the skeleton or whose parents lead to no root. name: of the joint, in the message.
swivel_status check_parents(const swivel_skeleton& skeleton, const char* name, std::uint32_t joint);

// A joint's parent; -1: none. The joint must be in the skeleton.
std::int32_t parent_of(const swivel_skeleton& skeleton, std::uint32_t joint);
// Reads a joint's rest pose relative to its parent, or refuses it. The joint must be in the skeleton.
swivel_status read_joint(const swivel_skeleton& skeleton, std::uint32_t joint, RestJoint& rest);

// Stores a rotor as x, y, z, w.
inline void store(const Rotor<double>& q, float (&numbers)[4])
{
    numbers[0] = static_cast<float>(q.at<kI>());
    numbers[1] = static_cast<float>(q.at<kJ>());
    numbers[2] = static_cast<float>(q.at<kK>());
    numbers[3] = static_cast<float>(q.at<kScalar>());
}

// rig.cpp: does what swivel_bind_joints() promises, for a limb whose rotations are usable.
swivel_status bind(const RestLimb& limb, swivel_binding& binding);

// Does what swivel_arm_axis() promises; arguments are already checked for null.
swivel_status arm_axis(const swivel_binding& binding, const float* parent_rotation, const double* direction,
                       double* axis);
// Whether a binding has unit quaternions, and not too many twist bones.
bool is_binding(const swivel_binding& binding);

}  // namespace swivel
