// SPDX-License-Identifier: MIT
//
// The plan of a crowd of bodies, made once. It lists the joints of the skeleton that some group needs, parents first.
// It says which of them are a group's limb, and which joints move with them.
#pragma once

#include "batch/crowd/crowd.h"
#include "batch/crowd/group_def.h"

namespace swivel {

// Checks what swivel_crowd_create() promises of a def with a skeleton, whose groups are otherwise right
// (body_check.cpp).
swivel_status check_bodies(const swivel_crowd_def& def);

// These take a def that is right.
struct BodySize {
    std::uint32_t joint_count, row_count, moved_count;  // needed joints, the root among them; rows of a block
    std::uint32_t first_own_row;                        // the first row behind those of joints
    std::uint32_t following_count;                      // joints that follow looks, of all groups
};
BodySize body_size(const swivel_crowd_def& def);
// Stores the needed joints of all groups, depth after depth. So those that follow each other seldom wait for each
// other.
void plan_joints(const swivel_crowd_def& def, BodyJoint* joints);
// Gives a group's limb.
struct PlannedJoints {
    const BodyJoint* joints;
    std::uint32_t count;
};
BodyLimb plan_limb(const swivel_crowd_def& def, const GroupDef& group, const swivel_binding& binding,
                   PlannedJoints joints);
// Adds the joints that a group turns and moves; stores the moved and the following ones from here on.
void plan_moved(const swivel_crowd_def& def, const GroupDef& group, PlannedJoints joints, BodyLimb& limb,
                MovedJoint* moved, FollowingJoint* following);
// Adds the constants of plants, shifts, grounds, props and looks.
void plan_group(const swivel_crowd_def& def, const GroupDef& group, BodyLimb& limb);
// Gives a group with these features its rows behind those of joints, from `first` on. Returns the first one after them.
std::uint32_t plan_own_rows(swivel_features features, std::uint32_t first, BodyLimb& limb);
// Joins the limbs of a crowd to what they are linked to. All else of their groups is planned.
void plan_links(const swivel_crowd_def& def, swivel_crowd& crowd);
// How a group's limb lies to the arm frame at rest.
swivel_binding body_binding(const swivel_crowd_def& def, const GroupDef& group);

}  // namespace swivel
