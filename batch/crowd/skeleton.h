// SPDX-License-Identifier: MIT
//
// Makes a limb at rest from joints of a skeleton, named by index. Knows no arm frame.
#pragma once

#include "batch/crowd/rig.h"

namespace swivel {

// Gives the limb of these joints as swivel_bind_joints() promises, or a refusal.
swivel_status rest_limb(const swivel_skeleton& skeleton, const swivel_limb_joints& joints, RestLimb& limb);

// Refuses a joint that is not in the skeleton or whose parents lead to no root. name: of the joint, in the message.
swivel_status check_parents(const swivel_skeleton& skeleton, const char* name, std::uint32_t joint);

// A joint's parent; -1: none. The joint must be in the skeleton.
std::int32_t parent_of(const swivel_skeleton& skeleton, std::uint32_t joint);
// Reads a joint's rest pose relative to its parent, or refuses it. The joint must be in the skeleton.
swivel_status read_joint(const swivel_skeleton& skeleton, std::uint32_t joint, RestJoint& rest);

}  // namespace swivel
