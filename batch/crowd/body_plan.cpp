// SPDX-License-Identifier: MIT
#include "batch/crowd/body_plan.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "batch/crowd/body_joints.h"
#include "core/joint_frame.h"

namespace swivel {

namespace {

// The next joint that a group's limb turns, from a joint upwards; -1: none.
std::int32_t mover_of(const swivel_skeleton& skeleton, const TurnedJoints& turned, std::int32_t joint)
{
    while (joint >= 0 && !turned.has(joint)) joint = parent_of(skeleton, static_cast<std::uint32_t>(joint));
    return joint;
}
// The same of all groups, and the group that turns it.
struct Mover {
    std::int32_t joint = -1;
    bool is_look = false;
    std::uint32_t group = 0;
};
Mover mover_of(const swivel_crowd_def& def, const swivel_skeleton& skeleton, std::int32_t joint)
{
    for (; joint >= 0; joint = parent_of(skeleton, static_cast<std::uint32_t>(joint)))
        for (std::uint32_t g = 0; g < def.group_count; ++g) {
            const GroupDef group = unlinked_group(def, g);
            if (TurnedJoints(skeleton, group).has(joint)) return {joint, (group.features & kLook) != 0, g};
        }
    return {};
}

// The place of a needed joint in the list. The root is the parent of those without one.
std::uint32_t find(PlannedJoints joints, std::int32_t skeleton_joint)
{
    if (skeleton_joint < 0) return 0;
    std::uint32_t n = 1;
    while (n < joints.count && joints.joints[n].skeleton_joint != static_cast<std::uint32_t>(skeleton_joint)) ++n;
    return n;
}
std::uint32_t row_of(PlannedJoints joints, std::int32_t skeleton_joint)
{
    return joints.joints[find(joints, skeleton_joint)].row;
}

std::uint32_t depth_of(const swivel_skeleton& skeleton, std::uint32_t joint)
{
    std::uint32_t depth = 0;
    for (std::int32_t at = parent_of(skeleton, joint); at >= 0; ++depth)
        at = parent_of(skeleton, static_cast<std::uint32_t>(at));
    return depth;
}

void store(const Rotor<double>& q, float (&to)[4])
{
    to[0] = static_cast<float>(q.at<kI>());
    to[1] = static_cast<float>(q.at<kJ>());
    to[2] = static_cast<float>(q.at<kK>());
    to[3] = static_cast<float>(q.at<kScalar>());
}
RestJoint rest_of(const swivel_skeleton& skeleton, std::uint32_t joint)
{
    RestJoint rest;
    read_joint(skeleton, joint, rest);
    return rest;
}

// Calls take(joint, mover) for each needed joint that moves with a group's look and is not of it.
template <class Take>
void for_each_following(const swivel_crowd_def& def, const swivel_skeleton& skeleton, const GroupDef& group,
                        const Take& take)
{
    if (!(group.features & kLook)) return;
    const TurnedJoints turned(skeleton, group);
    for_each_needed(def, skeleton, [&](std::uint32_t joint) {
        const auto number = static_cast<std::int32_t>(joint);
        if (const std::int32_t mover = mover_of(skeleton, turned, number); mover >= 0 && mover != number)
            take(joint, mover);
    });
}

// Each turned joint with its parent and what moves that.
void plan_turned(const swivel_skeleton& skeleton, const TurnedJoints& turned, PlannedJoints joints, BodyLimb& limb)
{
    for (const std::uint32_t joint : turned) {
        const std::int32_t parent = parent_of(skeleton, joint), above = mover_of(skeleton, turned, parent);
        limb.turned[limb.turned_count++] = {joint, row_of(joints, static_cast<std::int32_t>(joint)),
                                            row_of(joints, parent), above < 0 ? 0 : row_of(joints, above)};
    }
}

}  // namespace

BodySize body_size(const swivel_crowd_def& def)
{
    const swivel_skeleton skeleton = skeleton_of(def);
    BodySize size{1, kRootJoint + joint_row_count(false), 0, 0, 0};
    for_each_needed(def, skeleton, [&](std::uint32_t joint) {
        ++size.joint_count;
        const Mover mover = mover_of(def, skeleton, static_cast<std::int32_t>(joint));
        size.row_count += joint_row_count(mover.joint == static_cast<std::int32_t>(joint));
    });
    for (std::uint32_t joint = 0; joint < skeleton.joint_count; ++joint)
        size.moved_count += mover_of(def, skeleton, static_cast<std::int32_t>(joint)).joint >= 0;
    for (std::uint32_t g = 0; g < def.group_count; ++g)
        for_each_following(def, skeleton, group_at(def, g),
                           [&](std::uint32_t, std::int32_t) { ++size.following_count; });
    size.first_own_row = size.row_count;
    BodyLimb ignored{};
    for (std::uint32_t g = 0; g < def.group_count; ++g)
        size.row_count = plan_own_rows(group_at(def, g).features, size.row_count, ignored);
    return size;
}

void plan_joints(const swivel_crowd_def& def, BodyJoint* joints)
{
    const swivel_skeleton skeleton = skeleton_of(def);
    BodyJoint* end = joints;
    *end++ = {};
    for_each_needed(def, skeleton, [&](std::uint32_t joint) {
        end->skeleton_joint = joint;
        (end++)->row = depth_of(skeleton, joint);  // until its row is known
    });
    std::sort(joints + 1, end, [](const BodyJoint& a, const BodyJoint& b) {
        return a.row != b.row ? a.row < b.row : a.skeleton_joint < b.skeleton_joint;
    });
    joints[0].row = kRootJoint;
    std::uint32_t row = kRootJoint + joint_row_count(false);
    for (BodyJoint* to = joints + 1; to != end; ++to) {
        const PlannedJoints planned{joints, static_cast<std::uint32_t>(to - joints) + 1};
        const std::uint32_t joint = to->skeleton_joint;
        const Mover mover = mover_of(def, skeleton, static_cast<std::int32_t>(joint));
        const RestJoint rest = rest_of(skeleton, joint);
        to->row = row;
        to->parent = row_of(planned, parent_of(skeleton, joint));
        to->mover = mover.joint < 0 || mover.is_look ? 0 : row_of(planned, mover.joint);
        to->is_turned = mover.joint == static_cast<std::int32_t>(joint);
        to->translation[0] = static_cast<float>(rest.place.at<kE1>());
        to->translation[1] = static_cast<float>(rest.place.at<kE2>());
        to->translation[2] = static_cast<float>(rest.place.at<kE3>());
        row += joint_row_count(to->is_turned != 0);
    }
}

BodyLimb plan_limb(const swivel_crowd_def& def, const GroupDef& group, const swivel_binding& binding,
                   PlannedJoints joints)
{
    BodyLimb limb{};
    if (!group.joints) return limb;
    const swivel_skeleton skeleton = skeleton_of(def);
    const swivel_limb_joints limb_joints = joints_of(group);
    const TurnedJoints turned(skeleton, group);
    const auto row = [&](std::uint32_t joint) { return row_of(joints, static_cast<std::int32_t>(joint)); };
    const auto parent = [&](std::uint32_t joint) { return row_of(joints, parent_of(skeleton, joint)); };
    const float(&q)[4] = binding.upper_from_arm;
    const Vector<float> hinge = swivel::turned(rotor(q[0], q[1], q[2], q[3]), vector(1.0f, 0.0f, 0.0f));
    limb.parent = parent(limb_joints.shoulder), limb.shoulder = row(limb_joints.shoulder);
    limb.elbow_parent = parent(limb_joints.elbow), limb.elbow = row(limb_joints.elbow);
    limb.wrist_parent = parent(limb_joints.wrist), limb.wrist = row(limb_joints.wrist);
    for (std::uint32_t n = 0; n < twist_bone_count(group.features); ++n) {
        limb.twist_bones[n] = row(limb_joints.twist_bones[n]),
        limb.twist_parents[n] = parent(limb_joints.twist_bones[n]);
        store(normalise(rest_of(skeleton, limb_joints.twist_bones[n]).rotation), limb.twist_rest[n]);
    }
    std::copy(std::begin(hinge.c), std::end(hinge.c), limb.hinge);
    if (group.features & SWIVEL_WITH_CLAVICLE)
        store(normalise(rest_of(skeleton, turned.joint[0]).rotation), limb.clavicle_rest);
    return limb;
}

void plan_moved(const swivel_crowd_def& def, const GroupDef& group, PlannedJoints joints, BodyLimb& limb,
                MovedJoint* moved, FollowingJoint* following)
{
    const swivel_skeleton skeleton = skeleton_of(def);
    const TurnedJoints turned(skeleton, group);
    if (turned.count == 0) return;
    plan_turned(skeleton, turned, joints, limb);
    limb.is_look = (group.features & kLook) != 0;
    if (const Mover above = mover_of(def, skeleton, parent_of(skeleton, turned.joint[0])); above.joint >= 0)
        limb.above = row_of(joints, above.joint), limb.above_group = above.group;
    limb.moved = moved;
    for (std::uint32_t joint = 0; joint < skeleton.joint_count; ++joint)
        if (const Mover mover = mover_of(def, skeleton, static_cast<std::int32_t>(joint)); turned.has(mover.joint))
            moved[limb.moved_count++] = {joint, row_of(joints, mover.joint), mover.is_look ? 0 : limb.above};
    limb.following = following;
    for_each_following(def, skeleton, group, [&](std::uint32_t joint, std::int32_t mover) {
        const auto* const at = std::find(turned.begin(), turned.end(), static_cast<std::uint32_t>(mover));
        following[limb.following_count++] = {row_of(joints, static_cast<std::int32_t>(joint)),
                                             static_cast<std::uint32_t>(at - turned.begin())};
    });
}

namespace {

constexpr PlantRules plant_rules(const swivel_plant& plant)
{
    const auto per = [](float time) { return 1 / (time > kShortestTime ? double(time) : kShortestTime); };
    const double lock = plant.lock_radius;
    return {plant.lock_radius,
            plant.unlock_radius,
            plant.relock_speed,
            plant.reset_time,
            plant.stop_time,
            plant.release_time,
            static_cast<float>(double(plant.anchor_lead) * plant.stop_time / 3),
            static_cast<float>(3 * lock * per(plant.stop_time)),
            static_cast<float>(6.75 * lock *
                               per(plant.release_time)),  // an offset swings out by at most 4/27 of speed times time
            static_cast<float>(per(plant.stop_time)),
            static_cast<float>(2 * per(plant.release_time)),
            plant.speed[0],
            plant.speed[1],
            plant.height[0],
            plant.height[1]};
}

GroundRules ground_rules(const swivel_ground& ground)
{
    const double cos = ground.cos_max;  // of the whole angle
    return {{ground.heel[0], ground.heel[1], ground.heel[2]},
            ground.toe_clearance,
            ground.heel_clearance,
            static_cast<float>(sqrt(0.5 + 0.5 * cos)),
            static_cast<float>(sqrt(0.5 - 0.5 * cos)),
            spring_rule(ground.half_life)};
}

LookRules look_rules(const swivel_look_def& look)
{
    LookRules rules{};
    double left = 0;
    for (std::uint32_t n = look.joint_count; n-- > 0;) {
        left += double(look.share[n]);
        const double cos = look.cos_max[n];  // of the whole angle
        rules.joint[n] = {static_cast<float>(look.share[n] / left), static_cast<float>(sqrt(0.5 + 0.5 * cos)),
                          static_cast<float>(sqrt(0.5 - 0.5 * cos))};
    }
    rules.fade = {look.cos_none, static_cast<float>(1 / (double(look.cos_full) - look.cos_none)), look.fade_distance};
    const Vector<double> axis = normalise(vector<double>(look.axis[0], look.axis[1], look.axis[2]));
    for (std::size_t c = 0; c < 3; ++c) rules.eye[c] = look.eye[c], rules.axis[c] = static_cast<float>(axis.c[c]);
    rules.rate = look.rate;
    return rules;
}

// The first group with a feature; there is one.
GroupDef first_with(const swivel_crowd_def& def, swivel_features feature)
{
    std::uint32_t g = 0;
    while (!(group_at(def, g).features & feature)) ++g;
    return group_at(def, g);
}
float rest_length(const swivel_crowd_def& def, const GroupDef& group)
{
    const swivel_binding binding = body_binding(def, group);
    return binding.lengths[0] + binding.lengths[1];
}

}  // namespace

void plan_group(const swivel_crowd_def& def, const GroupDef& group, BodyLimb& limb)
{
    constexpr double kLongest = 1e15;
    const Vector<double> up = normalise(vector<double>(def.up[0], def.up[1], def.up[2]));
    for (std::size_t c = 0; c < 3; ++c) limb.up[c] = static_cast<float>(up.c[c]);
    limb.rules = plant_rules(group.plant);
    limb.shift = {group.shift.drop, group.shift.rise, spring_rule(group.shift.half_life)};
    if (group.features & SWIVEL_WITH_NEXT_TARGET) {
        const float ahead = first_with(def, kShift).shift.lookahead;
        limb.per_ahead = static_cast<float>(std::min(1 / double(ahead), kLongest));
    }
    if (group.features & (SWIVEL_WITH_PLANT | kShift))
        limb.rest_length = rest_length(def, group.features & kShift ? first_with(def, SWIVEL_WITH_PELVIS_FIT) : group);
    if (group.features & SWIVEL_WITH_GROUND) limb.ground = ground_rules(group.ground);
    limb.prop.max_move = group.prop.max_move;
    if (group.features & kLook) limb.look = look_rules(group.look);
}

std::uint32_t plan_own_rows(swivel_features features, std::uint32_t first, BodyLimb& limb)
{
    const auto take = [&](std::uint32_t rows) { return std::exchange(first, first + rows); };
    if (features & kLibraryGoal) limb.goal = take(kGoalRows);
    if (features & SWIVEL_WITH_HAND_TRANSFORM) limb.frame = take(kHeldRows);
    if (features & kProp) limb.frame = take(kPropRows);
    return first;
}

void plan_links(const swivel_crowd_def& def, swivel_crowd& crowd)
{
    for (std::uint32_t g = 0; g < crowd.group_count; ++g) {
        const GroupDef group = group_at(def, g);
        BodyLimb& limb = crowd.groups[g].limb;
        if (group.features & kProp && group.prop.joint >= 0)
            limb.prop.joint = row_of({crowd.joints, crowd.joint_count}, group.prop.joint);
        if (!(group.features & SWIVEL_WITH_LINK)) continue;
        BodyLimb& to = crowd.groups[group.link].limb;
        limb.link.row = to.frame;
        limb.link.group = group.link;
        limb.link.is_prop = group_at(def, group.link).features & kProp;
        if (!limb.link.is_prop) continue;
        if (to.prop.holder_count == 0) to.rest_length = rest_length(def, group);
        limb.link.number = to.prop.holder_count++;
        limb.link.holder = to.frame + kHoldersRow + limb.link.number * kHolderRows;
    }
}

swivel_binding body_binding(const swivel_crowd_def& def, const GroupDef& group)
{
    RestLimb limb;
    swivel_binding binding = swivel_default_binding();
    rest_limb(skeleton_of(def), joints_of(group), limb);
    bind(limb, binding);
    return binding;
}

}  // namespace swivel
