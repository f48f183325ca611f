// SPDX-License-Identifier: MIT
//
// The constants of a crowd's groups of bodies, as the formulas take them, and the links between groups, planned once.
#pragma once

#include "batch/crowd/crowd.h"
#include "batch/crowd/group_def.h"
#include "batch/crowd/joint_plan.h"

namespace swivel {

// Checks what swivel_crowd_create() promises of a def with a skeleton, whose groups are otherwise right
// (body_check.cpp).
swivel_status check_bodies(const swivel_crowd_def& def);

// Adds the constants of plants, shifts, grounds, props and looks to a group's limb. The def is right, here and below.
void plan_group(const swivel_crowd_def& def, const GroupDef& group, BodyLimb& limb);
// Joins the limbs of a crowd to what they are linked to. All else of their groups is planned.
void plan_links(const swivel_crowd_def& def, const JointPlan& plan, swivel_crowd& crowd);
// How a group's limb lies to the arm frame at rest.
swivel_binding body_binding(const swivel_crowd_def& def, const GroupDef& group);

}  // namespace swivel
