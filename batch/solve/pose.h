// SPDX-License-Identifier: MIT
//
// The way of solved joints back into the bodies' poses.
#pragma once

#include "batch/crowd/crowd.h"

namespace swivel {

// A validated pose, padded to the current size of the structure.
swivel_pose full_pose(const swivel_pose* given);

// The origin of the positions in a job's streams: the root, where it is doubles.
inline swivel_in origin_of(const swivel_pose& pose) { return pose.root_is_double ? pose.root_position : swivel_in{}; }

// Whether a pose asks for where all needed joints are.
inline bool gives_joints(const swivel_pose& pose) { return pose.joint_rotations.data || pose.joint_positions.data; }

// These write a block's bodies to the caller's memory: the joints that a group moves; and, once all groups are solved,
// where all needed joints are.
void pose_out(const BodyKernels& kernels, const BodyPlan& plan, const Group& group, const BodyBlock& block);
// The same of a pose in the body's space, where the group's own motion is known.
void carry_out(const BodyKernels& kernels, const BodyPlan& plan, const Group& group, const BodyBlock& block);
void joints_out(const BodyKernels& kernels, const BodyPlan& plan, const BodyBlock& block);
// Sets how a limb or look that is not solved moves its joints: no more than what is above them.
void stay(const Group& group, const BodyBlock& block);

}  // namespace swivel
