// SPDX-License-Identifier: MIT
//
// The joints of a crowd of bodies, planned once: which of the skeleton some group needs, parents first; which of them a
// group's limb or look turns; which joints move with those; and the rows of all. Knows no constants of groups.
#pragma once

#include "batch/crowd/body_joints.h"
#include "batch/crowd/crowd.h"
#include "batch/crowd/group_def.h"

namespace swivel {

// A joint of the skeleton, as all groups have it.
struct SkeletonJoint {
    std::int32_t mover;   // the joint that it moves with: it, or the next one above that a group turns; -1: none
    std::uint32_t group;  // the group that turns the mover
    bool is_of_look;      // whether that is a look
    bool is_needed;       // whether some group needs the joint
    std::uint32_t row;    // if so, its first row
};
struct JointPlan {
    swivel_skeleton skeleton;
    SkeletonJoint* joints;  // one for each of the skeleton

    // The first row of a needed joint. -1: the root's, which is the parent of joints without one.
    std::uint32_t row_of(std::int32_t joint) const { return joint < 0 ? kRootJoint : joints[joint].row; }
    std::uint32_t row_of(std::uint32_t joint) const { return joints[joint].row; }
    std::uint32_t parent_row_of(std::uint32_t joint) const { return row_of(parent_of(skeleton, joint)); }
};

// These take a def that is right.
struct BodySize {
    std::uint32_t joint_count, row_count;  // needed joints, the root among them; rows of a block
    std::uint32_t first_own_row;           // the first row behind those of joints
    std::uint32_t skeleton_joint_count;    // at most so many joints move with groups
    std::uint64_t following_count;         // at most so many joints follow looks, those of all looks together
};
BodySize body_size(const swivel_crowd_def& def);
// Plans the joints of all groups, in memory for each joint of the skeleton and for the needed ones. Stores the needed
// ones depth after depth. So those that follow each other seldom wait for each other.
JointPlan plan_joints(const swivel_crowd_def& def, SkeletonJoint* joints, BodyJoint* needed);
// Gives a group's limb.
BodyLimb plan_limb(const JointPlan& plan, const GroupDef& group, const swivel_binding& binding);
// Adds the joints that group g turns and moves; stores the moved and the following ones from here on.
void plan_moved(const JointPlan& plan, std::uint32_t g, const GroupDef& group, BodyLimb& limb, MovedJoint* moved,
                FollowingJoint* following);
// Gives a group with these features its rows behind those of joints, from `first` on. Returns the first one after them.
std::uint32_t plan_own_rows(swivel_features features, std::uint32_t first, BodyLimb& limb);

}  // namespace swivel
