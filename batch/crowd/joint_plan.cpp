// SPDX-License-Identifier: MIT
#include "batch/crowd/joint_plan.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/joint_frame.h"

namespace swivel {

namespace {

std::uint32_t depth_of(const swivel_skeleton& skeleton, std::uint32_t joint)
{
    std::uint32_t depth = 0;
    for (std::int32_t at = parent_of(skeleton, joint); at >= 0; ++depth)
        at = parent_of(skeleton, static_cast<std::uint32_t>(at));
    return depth;
}

// The joint a number of steps above another; -1: one step above a root.
std::int32_t ancestor_of(const swivel_skeleton& skeleton, std::uint32_t joint, std::uint32_t steps)
{
    auto at = static_cast<std::int32_t>(joint);
    for (; steps > 0; --steps) at = parent_of(skeleton, static_cast<std::uint32_t>(at));
    return at;
}
// The number of joints at or above one joint, but not at or above the other. From one depth on, both chains go up
// together until they meet.
std::uint32_t steps_apart(const swivel_skeleton& skeleton, std::uint32_t joint, std::uint32_t other)
{
    const std::uint32_t depth = depth_of(skeleton, joint), other_depth = depth_of(skeleton, other),
                        common = std::min(depth, other_depth);
    std::uint32_t steps = depth - common;
    std::int32_t at = ancestor_of(skeleton, joint, steps),
                 other_at = ancestor_of(skeleton, other, other_depth - common);
    for (; at != other_at; ++steps) {
        at = parent_of(skeleton, static_cast<std::uint32_t>(at));
        other_at = parent_of(skeleton, static_cast<std::uint32_t>(other_at));
    }
    return steps;
}

// The number of joints that groups need. Each end adds the joints above it that no earlier end has counted. Marking
// joints would take memory, which is not there before their number is known.
std::uint32_t needed_count(const swivel_crowd_def& def, const swivel_skeleton& skeleton)
{
    std::uint32_t count = 0;
    for (std::uint32_t g = 0; g < def.group_count; ++g) {
        const NeededEnds ends(unlinked_group(def, g));
        std::uint32_t added[kMaxTurned];
        for (std::uint32_t n = 0; n < ends.count; ++n) added[n] = depth_of(skeleton, ends.joint[n]) + 1;
        for (std::uint32_t other = 0; other <= g; ++other) {
            const NeededEnds others(unlinked_group(def, other));
            for (std::uint32_t n = 0; n < ends.count; ++n)
                for (std::uint32_t m = 0; m < (other == g ? n : others.count); ++m)
                    added[n] = std::min(added[n], steps_apart(skeleton, ends.joint[n], others.joint[m]));
        }
        for (std::uint32_t n = 0; n < ends.count; ++n) count += added[n];
    }
    return count;
}

// body_size() counts joints, and the plan lists them, in ways of their own. If the two ever disagreed, this would end
// the program before anything is stored outside of its place in the arena.
void check_size(bool is_as_counted)
{
    if (!is_as_counted) __builtin_trap();
}

// Marks the joints that groups turn and need, and lists the needed ones, which fill the list.
void mark_joints(const swivel_crowd_def& def, const JointPlan& plan, std::span<BodyJoint> needed)
{
    std::size_t count = 0;
    for (std::uint32_t g = 0; g < def.group_count; ++g) {
        const GroupDef group = unlinked_group(def, g);
        for (const std::uint32_t joint : TurnedJoints(plan.skeleton, group)) {
            plan.joints[joint].mover = static_cast<std::int32_t>(joint);
            plan.joints[joint].group = g;
            plan.joints[joint].is_of_look = (group.features & kLook) != 0;
        }
        for (const std::uint32_t end : NeededEnds(group))
            for (auto at = static_cast<std::int32_t>(end); at >= 0 && !plan.joints[at].is_needed;
                 at = parent_of(plan.skeleton, static_cast<std::uint32_t>(at))) {
                plan.joints[at].is_needed = true;
                check_size(count < needed.size());
                needed[count++].skeleton_joint = static_cast<std::uint32_t>(at);
            }
    }
    check_size(count == needed.size());
}

// Every other joint moves with the nearest joint above it that moves with a group.
void find_movers(const JointPlan& plan)
{
    for (std::uint32_t joint = 0; joint < plan.skeleton.joint_count; ++joint) {
        SkeletonJoint& found = plan.joints[joint];
        for (std::int32_t at = parent_of(plan.skeleton, joint); at >= 0 && found.mover < 0;
             at = parent_of(plan.skeleton, static_cast<std::uint32_t>(at))) {
            const SkeletonJoint& above = plan.joints[at];
            found.mover = above.mover, found.group = above.group, found.is_of_look = above.is_of_look;
        }
    }
}

// The nearest joint at or above a joint that group g turns; -1: none.
std::int32_t mover_in_group(const JointPlan& plan, std::uint32_t g, std::int32_t joint)
{
    while (joint >= 0) {
        const SkeletonJoint& at = plan.joints[joint];
        if (at.mover < 0 || at.group == g) return at.mover;
        joint = parent_of(plan.skeleton, static_cast<std::uint32_t>(at.mover));
    }
    return -1;
}

RestJoint rest_of(const swivel_skeleton& skeleton, std::uint32_t joint)
{
    RestJoint rest;
    read_joint(skeleton, joint, rest);
    return rest;
}

}  // namespace

BodySize body_size(const swivel_crowd_def& def)
{
    const swivel_skeleton skeleton = skeleton_of(def);
    const std::uint32_t needed = needed_count(def, skeleton);
    std::uint32_t turned = 0, looks = 0, own_rows = 0;
    GroupPlan ignored{};
    for (std::uint32_t g = 0; g < def.group_count; ++g) {
        const GroupDef group = group_at(def, g);
        turned += TurnedJoints(skeleton, group).count;  // groups turn joints of their own, which are all needed
        looks += group.features & kLook ? 1 : 0;
        own_rows = plan_own_rows(group.features, own_rows, ignored);
    }
    BodySize size;
    size.joint_count = 1 + needed;
    size.first_own_row = kRootJoint + (1 + needed - turned) * joint_row_count(false) + turned * joint_row_count(true);
    size.row_count = size.first_own_row + own_rows;
    size.skeleton_joint_count = skeleton.joint_count;
    size.following_count = std::uint64_t{looks} * needed;
    return size;
}

JointPlan plan_joints(const swivel_crowd_def& def, const BodySize& size, SkeletonJoint* joints, BodyJoint* root)
{
    const JointPlan plan{skeleton_of(def), joints};
    const swivel_skeleton& skeleton = plan.skeleton;
    std::fill_n(joints, skeleton.joint_count, SkeletonJoint{-1, 0, false, false, 0});
    *root = {};
    root->row = kRootJoint;
    const std::span<BodyJoint> needed(root + 1, size.joint_count - 1);
    mark_joints(def, plan, needed);
    find_movers(plan);
    for (BodyJoint& each : needed) each.row = depth_of(skeleton, each.skeleton_joint);  // until its row is known
    std::sort(needed.begin(), needed.end(), [](const BodyJoint& a, const BodyJoint& b) {
        return a.row != b.row ? a.row < b.row : a.skeleton_joint < b.skeleton_joint;
    });
    std::uint32_t row = kRootJoint + joint_row_count(false);
    for (BodyJoint& each : needed) {
        const std::uint32_t joint = each.skeleton_joint;
        SkeletonJoint& planned = joints[joint];
        const RestJoint rest = rest_of(skeleton, joint);
        each.row = planned.row = row;
        each.parent = plan.parent_first_row_of(joint);
        each.mover = planned.mover < 0 || planned.is_of_look ? 0 : plan.first_row_of(planned.mover);
        each.is_turned = planned.mover == static_cast<std::int32_t>(joint);
        for (std::size_t c = 0; c < 3; ++c) each.translation[c] = static_cast<float>(rest.place.c[c]);
        row += joint_row_count(each.is_turned != 0);
    }
    check_size(row == size.first_own_row);
    return plan;
}

BodyLimb plan_limb(const JointPlan& plan, const GroupDef& group, const swivel_binding& binding)
{
    BodyLimb limb{};
    if (!group.joints) return limb;
    const swivel_limb_joints joints = joints_of(group);
    const TurnedJoints turned(plan.skeleton, group);
    const float(&q)[4] = binding.upper_from_arm;
    const Vector<float> hinge = swivel::turned(rotor(q[0], q[1], q[2], q[3]), vector(1.0f, 0.0f, 0.0f));
    limb.parent = plan.parent_first_row_of(joints.shoulder), limb.shoulder = plan.first_row_of(joints.shoulder);
    limb.elbow_parent = plan.parent_first_row_of(joints.elbow), limb.elbow = plan.first_row_of(joints.elbow);
    limb.wrist_parent = plan.parent_first_row_of(joints.wrist), limb.wrist = plan.first_row_of(joints.wrist);
    for (std::uint32_t n = 0; n < twist_bone_count(group.features); ++n) {
        const std::uint32_t bone = joints.twist_bones[n];
        limb.twist_bones[n].row = plan.first_row_of(bone), limb.twist_bones[n].parent = plan.parent_first_row_of(bone);
        store(normalise(rest_of(plan.skeleton, bone).rotation), limb.twist_bones[n].rest);
    }
    std::copy(std::begin(hinge.c), std::end(hinge.c), limb.hinge);
    if (group.features & SWIVEL_WITH_CLAVICLE)
        store(normalise(rest_of(plan.skeleton, turned.joint[0]).rotation), limb.clavicle_rest);
    return limb;
}

GroupJoints plan_moved(const JointPlan& plan, std::uint32_t g, const GroupDef& group, std::span<MovedJoint> moved,
                       std::span<FollowingJoint> following)
{
    const TurnedJoints turned(plan.skeleton, group);
    GroupJoints joints{};
    if (turned.count == 0) return joints;
    for (const std::uint32_t joint : turned) {
        const std::int32_t above = mover_in_group(plan, g, parent_of(plan.skeleton, joint));
        joints.turned[joints.turned_count++] = {joint, plan.first_row_of(joint), plan.parent_first_row_of(joint),
                                                above < 0 ? 0 : plan.first_row_of(above)};
    }
    const bool is_look = (group.features & kLook) != 0;
    if (const std::int32_t parent = parent_of(plan.skeleton, turned.joint[0]);
        parent >= 0 && plan.joints[parent].mover >= 0)
        joints.above = plan.first_row_of(plan.joints[parent].mover), joints.above_group = plan.joints[parent].group;
    joints.moved = moved.data();
    joints.following = following.data();
    for (std::uint32_t joint = 0; joint < plan.skeleton.joint_count; ++joint) {
        const SkeletonJoint& at = plan.joints[joint];
        if (at.mover >= 0 && at.group == g) {
            check_size(joints.moved_count < moved.size());
            moved[joints.moved_count++] = {joint, plan.first_row_of(at.mover), is_look ? 0 : joints.above};
        }
        if (!is_look || !at.is_needed) continue;
        const std::int32_t mover = mover_in_group(plan, g, static_cast<std::int32_t>(joint));
        if (mover < 0 || mover == static_cast<std::int32_t>(joint)) continue;
        const auto* const found = std::find(turned.begin(), turned.end(), static_cast<std::uint32_t>(mover));
        check_size(joints.following_count < following.size());
        following[joints.following_count++] = {at.row, static_cast<std::uint32_t>(found - turned.begin())};
    }
    return joints;
}

std::uint32_t plan_own_rows(swivel_features features, std::uint32_t first, GroupPlan& group)
{
    const auto take = [&](std::uint32_t rows) { return std::exchange(first, first + rows); };
    if (features & kLibraryGoal) group.limb.goal = take(kGoalRows);
    if (features & SWIVEL_WITH_HAND_TRANSFORM) group.limb.hand_frame = take(kHeldRows);
    if (features & kProp) group.prop.frame = take(kPropRows);
    return first;
}

}  // namespace swivel
