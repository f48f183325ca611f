// SPDX-License-Identifier: MIT
//
// The checks of the bodies' pose.
#pragma once

#include "batch/crowd/crowd.h"

namespace swivel {

// Checks what swivel_solve() promises of a pose, which may be null, for the groups that a job names; and what does not
// depend on groups.
swivel_status check_pose(const swivel_crowd& crowd, const std::uint32_t* groups, const swivel_pose* given);
swivel_status check_pose(const swivel_crowd& crowd, const swivel_pose* given);

}  // namespace swivel
