// SPDX-License-Identifier: MIT
//
// From joints of a skeleton, named by index, to a limb at rest. Knows no arm frame.
#pragma once

#include "batch/crowd/rig.h"

namespace swivel {

// Gives the limb of these joints as swivel_bind_joints() promises, or a refusal.
swivel_status rest_limb(const swivel_skeleton& skeleton, const swivel_limb_joints& joints, RestLimb& limb);

// Whether a joint is in the skeleton, and its parents lead to a root. name: what the line calls it.
swivel_status check_parents(const swivel_skeleton& skeleton, const char* name, std::uint32_t joint);

// A joint's parent, and the joint alone, relative to that; or a refusal. The joint is in the skeleton.
std::int32_t parent_of(const swivel_skeleton& skeleton, std::uint32_t joint);
swivel_status read_joint(const swivel_skeleton& skeleton, std::uint32_t joint, RestJoint& rest);

}  // namespace swivel
