// SPDX-License-Identifier: MIT
//
// The bodies' poses: what is a right one, and the way of solved joints back into it.
#pragma once

#include "batch/crowd.h"
#include "batch/lane_mask.h"

namespace swivel {

// What swivel_solve() promises of a pose, which may be null.
swivel_status check_pose(const swivel_crowd& crowd, const swivel_pose* given);
// A pose that is right, and all of its members.
swivel_pose full_pose(const swivel_pose* given);

// The origin of the positions in a job's frames: the root, where it is doubles.
inline swivel_in origin_of(const swivel_pose& pose) { return pose.root_is_double ? pose.root_position : swivel_in{}; }

// Copies the joints of a group's limb from a block's rows to the caller's poses.
void pose_out(const swivel_pose& pose, const swivel_crowd& crowd, const Group& group, const BodyBlock& block);

}  // namespace swivel
