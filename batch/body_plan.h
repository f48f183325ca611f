// SPDX-License-Identifier: MIT
//
// The joints of a crowd of bodies: which of the skeleton some group needs, in an order in which parents come first, and
// which of them are a group's limb.
#pragma once

#include "batch/crowd.h"

namespace swivel {

// What swivel_crowd_create() promises of a def with a skeleton, whose groups are otherwise right.
swivel_status check_bodies(const swivel_crowd_def& def);

// These take a def that is right. How many joints are needed, the root among them; all of them; how a group's limb lies
// to the arm frame at rest; and which of the joints it has.
std::uint32_t needed_joint_count(const swivel_crowd_def& def);
void plan_joints(const swivel_crowd_def& def, BodyJoint* joints);
swivel_binding body_binding(const swivel_crowd_def& def, const swivel_group_def& group);
BodyLimb body_limb(const swivel_crowd_def& def, const swivel_group_def& group, const swivel_binding& binding,
                   const BodyJoint* joints, std::uint32_t joint_count);

}  // namespace swivel
