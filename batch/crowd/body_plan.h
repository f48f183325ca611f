// SPDX-License-Identifier: MIT
//
// Plans a crowd's groups of bodies once: the formulas' constants, and the links between groups.
#pragma once

#include "batch/crowd/crowd.h"
#include "batch/crowd/group_def.h"
#include "batch/crowd/joint_plan.h"

namespace swivel {

// Checks the skeleton's part of a def, as swivel_crowd_create() promises. Groups are otherwise valid (body_check.cpp).
swivel_status check_bodies(const swivel_crowd_def& def);

// Adds the constants of plants, shifts, grounds, props and looks to a group's plan. The def must be valid, here and
// below.
void plan_group(const swivel_crowd_def& def, const GroupDef& group, GroupPlan& plan);
// Connects linked limbs to the limbs and props that they hold. Call it when all groups are planned.
void plan_links(const swivel_crowd_def& def, const JointPlan& plan, swivel_crowd& crowd);
// The binding of a group's limb, from the skeleton at rest.
swivel_binding body_binding(const swivel_crowd_def& def, const GroupDef& group);

}  // namespace swivel
