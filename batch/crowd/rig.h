// SPDX-License-Identifier: MIT
//
// Makes a limb's binding from its rest pose: bone lengths and axes, bend, and the constant rotors between arm frame and
// joints.
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

// Does what swivel_bind_joints() promises, for a limb whose rotations are usable.
swivel_status bind(const RestLimb& limb, swivel_binding& binding);

// Does what swivel_arm_axis() promises; arguments are already checked for null.
swivel_status arm_axis(const swivel_binding& binding, const float (&parent_rotation)[4], const double (&direction)[3],
                       double (&axis)[3]);
// Whether a binding has unit quaternions, and not too many twist bones.
bool is_binding(const swivel_binding& binding);

}  // namespace swivel
