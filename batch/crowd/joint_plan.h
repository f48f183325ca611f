// SPDX-License-Identifier: MIT
//
// Plans a crowd of bodies once. joint_plan.cpp plans its joints: those that groups need, parents first, those that
// groups turn, those that move with them, and their rows. body_plan.cpp plans the constants of formulas, and the links
// between groups.
#pragma once

#include <span>

#include "batch/crowd/body_joints.h"
#include "batch/crowd/crowd.h"
#include "batch/crowd/group_def.h"

namespace swivel {

// A joint of the skeleton.
struct SkeletonJoint {
    std::int32_t mover;   // the nearest joint at or above it that a group turns; -1: none
    std::uint32_t group;  // the group that turns the mover
    bool is_of_look;      // whether that group is a look
    bool is_needed;       // whether some group needs the joint
    std::uint32_t row;    // the first row of a needed joint
};
struct JointPlan {
    swivel_skeleton skeleton;
    SkeletonJoint* joints;  // one for each of the skeleton

    // The first row of a needed joint. -1: the root's, which is the parent of joints without one.
    std::uint32_t first_row_of(std::int32_t joint) const { return joint < 0 ? kRootJoint : joints[joint].row; }
    std::uint32_t first_row_of(std::uint32_t joint) const { return joints[joint].row; }
    std::uint32_t parent_first_row_of(std::uint32_t joint) const { return first_row_of(parent_of(skeleton, joint)); }
};

// The functions below take a valid def.
struct BodySize {
    std::uint32_t joint_count, row_count;  // needed joints, the root among them; rows of a block
    std::uint32_t first_own_row;           // the first row behind those of joints
    std::uint32_t skeleton_joint_count;    // an upper bound of the joints that move with groups
    std::uint64_t following_count;         // an upper bound of the joints that follow looks, all looks together
};
BodySize body_size(const swivel_crowd_def& def);
// Plans the joints of all groups. size: body_size(def); a plan that needs more ends the program. joints: room for each
// joint of the skeleton. root: room for the root and the needed joints behind it, which come depth after depth, so that
// neighbours seldom wait for each other's results.
JointPlan plan_joints(const swivel_crowd_def& def, const BodySize& size, SkeletonJoint* joints, BodyJoint* root);
// Gives a group's limb its joints, and no rules yet.
BodyLimb plan_limb(const JointPlan& plan, const GroupDef& group, const swivel_binding& binding);
// The joints that group g turns and moves. Stores the moved and the following ones at the start of these two, which
// have room for those of all groups from g on.
GroupJoints plan_moved(const JointPlan& plan, std::uint32_t g, const GroupDef& group, std::span<MovedJoint> moved,
                       std::span<FollowingJoint> following);
// Gives a group its rows after the joints', from `first` on. Returns the next free row.
std::uint32_t plan_own_rows(swivel_features features, std::uint32_t first, GroupPlan& group);

// Adds the constants of plants, shifts, grounds, props and looks to a group's plan.
void plan_group(const swivel_crowd_def& def, const GroupDef& group, GroupPlan& plan);
// Connects linked limbs to the limbs and props that they hold. Call it when all groups are planned.
void plan_links(const swivel_crowd_def& def, const JointPlan& plan, swivel_crowd& crowd);
// The binding of a group's limb, from the skeleton at rest.
swivel_binding body_binding(const swivel_crowd_def& def, const GroupDef& group);

}  // namespace swivel
