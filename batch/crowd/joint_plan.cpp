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

// How many joints are at or above one joint, but not at or above the other.
std::uint32_t steps_apart(const swivel_skeleton& skeleton, std::uint32_t joint, std::uint32_t other)
{
    std::uint32_t steps = 0;
    for (auto at = static_cast<std::int32_t>(joint);
         at >= 0 && !is_above(skeleton, static_cast<std::uint32_t>(at), other);
         at = parent_of(skeleton, static_cast<std::uint32_t>(at)))
        ++steps;
    return steps;
}

// How many joints some group needs. Each end adds those above it that are above no end before it. There is no memory
// to mark joints in before their number is known.
std::uint32_t needed_count(const swivel_crowd_def& def, const swivel_skeleton& skeleton)
{
    std::uint32_t count = 0;
    for (std::uint32_t g = 0; g < def.group_count; ++g) {
        const NeededEnds ends(unlinked_group(def, g));
        std::uint32_t added[kMaxNeededEnds];
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

// Marks the joints that groups turn and need, and lists the needed ones from here on. Returns the end of the list.
BodyJoint* mark_joints(const swivel_crowd_def& def, const JointPlan& plan, BodyJoint* needed)
{
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
                (needed++)->skeleton_joint = static_cast<std::uint32_t>(at);
            }
    }
    return needed;
}

// Each other joint moves as the next one above does that moves with a group.
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

// The next joint that group g turns, from a joint upwards; -1: none.
std::int32_t mover_in_group(const JointPlan& plan, std::uint32_t g, std::int32_t joint)
{
    while (joint >= 0) {
        const SkeletonJoint& at = plan.joints[joint];
        if (at.mover < 0 || at.group == g) return at.mover;
        joint = parent_of(plan.skeleton, static_cast<std::uint32_t>(at.mover));
    }
    return -1;
}

void store(const Rotor<double>& q, float (&numbers)[4])
{
    numbers[0] = static_cast<float>(q.at<kI>());
    numbers[1] = static_cast<float>(q.at<kJ>());
    numbers[2] = static_cast<float>(q.at<kK>());
    numbers[3] = static_cast<float>(q.at<kScalar>());
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
    BodyLimb ignored{};
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

JointPlan plan_joints(const swivel_crowd_def& def, SkeletonJoint* joints, BodyJoint* needed)
{
    const JointPlan plan{skeleton_of(def), joints};
    const swivel_skeleton& skeleton = plan.skeleton;
    std::fill_n(joints, skeleton.joint_count, SkeletonJoint{-1, 0, false, false, 0});
    needed[0] = {};
    needed[0].row = kRootJoint;
    BodyJoint* const end = mark_joints(def, plan, needed + 1);
    find_movers(plan);
    for (BodyJoint* each = needed + 1; each != end; ++each)
        each->row = depth_of(skeleton, each->skeleton_joint);  // until its row is known
    std::sort(needed + 1, end, [](const BodyJoint& a, const BodyJoint& b) {
        return a.row != b.row ? a.row < b.row : a.skeleton_joint < b.skeleton_joint;
    });
    std::uint32_t row = kRootJoint + joint_row_count(false);
    for (BodyJoint* each = needed + 1; each != end; ++each) {
        const std::uint32_t joint = each->skeleton_joint;
        SkeletonJoint& planned = joints[joint];
        const RestJoint rest = rest_of(skeleton, joint);
        each->row = planned.row = row;
        each->parent = plan.parent_row_of(joint);
        each->mover = planned.mover < 0 || planned.is_of_look ? 0 : plan.row_of(planned.mover);
        each->is_turned = planned.mover == static_cast<std::int32_t>(joint);
        each->translation[0] = static_cast<float>(rest.place.at<kE1>());
        each->translation[1] = static_cast<float>(rest.place.at<kE2>());
        each->translation[2] = static_cast<float>(rest.place.at<kE3>());
        row += joint_row_count(each->is_turned != 0);
    }
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
    limb.parent = plan.parent_row_of(joints.shoulder), limb.shoulder = plan.row_of(joints.shoulder);
    limb.elbow_parent = plan.parent_row_of(joints.elbow), limb.elbow = plan.row_of(joints.elbow);
    limb.wrist_parent = plan.parent_row_of(joints.wrist), limb.wrist = plan.row_of(joints.wrist);
    for (std::uint32_t n = 0; n < twist_bone_count(group.features); ++n) {
        const std::uint32_t bone = joints.twist_bones[n];
        limb.twist_bones[n] = plan.row_of(bone), limb.twist_parents[n] = plan.parent_row_of(bone);
        store(normalise(rest_of(plan.skeleton, bone).rotation), limb.twist_rest[n]);
    }
    std::copy(std::begin(hinge.c), std::end(hinge.c), limb.hinge);
    if (group.features & SWIVEL_WITH_CLAVICLE)
        store(normalise(rest_of(plan.skeleton, turned.joint[0]).rotation), limb.clavicle_rest);
    return limb;
}

void plan_moved(const JointPlan& plan, std::uint32_t g, const GroupDef& group, BodyLimb& limb, MovedJoint* moved,
                FollowingJoint* following)
{
    const TurnedJoints turned(plan.skeleton, group);
    if (turned.count == 0) return;
    for (const std::uint32_t joint : turned) {
        const std::int32_t above = mover_in_group(plan, g, parent_of(plan.skeleton, joint));
        limb.turned[limb.turned_count++] = {joint, plan.row_of(joint), plan.parent_row_of(joint),
                                            above < 0 ? 0 : plan.row_of(above)};
    }
    limb.is_look = (group.features & kLook) != 0;
    if (const std::int32_t parent = parent_of(plan.skeleton, turned.joint[0]);
        parent >= 0 && plan.joints[parent].mover >= 0)
        limb.above = plan.row_of(plan.joints[parent].mover), limb.above_group = plan.joints[parent].group;
    limb.moved = moved;
    limb.following = following;
    for (std::uint32_t joint = 0; joint < plan.skeleton.joint_count; ++joint) {
        const SkeletonJoint& at = plan.joints[joint];
        if (at.mover >= 0 && at.group == g)
            moved[limb.moved_count++] = {joint, plan.row_of(at.mover), limb.is_look ? 0 : limb.above};
        if (!limb.is_look || !at.is_needed) continue;
        const std::int32_t mover = mover_in_group(plan, g, static_cast<std::int32_t>(joint));
        if (mover < 0 || mover == static_cast<std::int32_t>(joint)) continue;
        const auto* const found = std::find(turned.begin(), turned.end(), static_cast<std::uint32_t>(mover));
        following[limb.following_count++] = {at.row, static_cast<std::uint32_t>(found - turned.begin())};
    }
}

std::uint32_t plan_own_rows(swivel_features features, std::uint32_t first, BodyLimb& limb)
{
    const auto take = [&](std::uint32_t rows) { return std::exchange(first, first + rows); };
    if (features & kLibraryGoal) limb.goal = take(kGoalRows);
    if (features & SWIVEL_WITH_HAND_TRANSFORM) limb.frame = take(kHeldRows);
    if (features & kProp) limb.frame = take(kPropRows);
    return first;
}

}  // namespace swivel
