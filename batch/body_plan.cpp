// SPDX-License-Identifier: MIT
#include "batch/body_plan.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "batch/sized.h"
#include "batch/skeleton.h"
#include "batch/status.h"
#include "core/joint_frame.h"

namespace swivel {

namespace {

swivel_skeleton skeleton_of(const swivel_crowd_def& def) { return element(def.skeleton, 0, swivel_default_skeleton()); }
swivel_limb_joints joints_of(const swivel_group_def& group)
{
    return element(group.joints, 0, swivel_default_limb_joints(0, 0, 0));
}

std::array<std::uint32_t, 3> turned_joints(const swivel_limb_joints& limb)
{
    return {limb.shoulder, limb.elbow, limb.wrist};
}

// Whether a joint is another or above it. Both are in the skeleton, and parents lead to a root.
bool is_above(const swivel_skeleton& skeleton, std::uint32_t joint, std::uint32_t below)
{
    for (auto at = static_cast<std::int32_t>(below); at >= 0; at = parent_of(skeleton, static_cast<std::uint32_t>(at)))
        if (static_cast<std::uint32_t>(at) == joint) return true;
    return false;
}

std::uint32_t wrist_of(const swivel_crowd_def& def, std::uint32_t g) { return joints_of(group_at(def, g)).wrist; }
// Calls take(joint) for each needed joint, once: those of all limbs and what is above them.
template <class Take>
void for_each_needed(const swivel_crowd_def& def, const swivel_skeleton& skeleton, const Take& take)
{
    const auto is_taken = [&](std::uint32_t joint, std::uint32_t group_count) {
        for (std::uint32_t g = 0; g < group_count; ++g)
            if (is_above(skeleton, joint, wrist_of(def, g))) return true;
        return false;
    };
    for (std::uint32_t g = 0; g < def.group_count; ++g)
        for (auto at = static_cast<std::int32_t>(wrist_of(def, g)); at >= 0;
             at = parent_of(skeleton, static_cast<std::uint32_t>(at))) {
            const auto joint = static_cast<std::uint32_t>(at);
            if (is_taken(joint, g)) break;
            take(joint);
        }
}

bool is_turned(const swivel_crowd_def& def, std::uint32_t joint)
{
    for (std::uint32_t g = 0; g < def.group_count; ++g)
        if (const auto turned = turned_joints(joints_of(group_at(def, g)));
            std::find(turned.begin(), turned.end(), joint) != turned.end())
            return true;
    return false;
}

swivel_status check_limb(const swivel_skeleton& skeleton, const swivel_group_def& group, swivel_binding& binding)
{
    RestLimb limb;
    const swivel_status status = rest_limb(skeleton, joints_of(group), limb);
    return status == SWIVEL_OK ? bind("swivel_bind_joints", limb, binding) : status;
}

// The line of a call that failed, as one about a group.
swivel_status fail_in_group(std::uint32_t g, swivel_status status)
{
    char line[256];
    std::snprintf(line, sizeof line, "%s", last_error());
    return fail(status, "group %u: %s", g, line);
}

swivel_status check_group_joints(const swivel_crowd_def& def, const swivel_skeleton& skeleton, std::uint32_t g)
{
    const swivel_group_def group = group_at(def, g);
    if (!group.joints)
        return fail(SWIVEL_INVALID_ARGUMENT, "group %u names no joints; in a crowd of bodies each group does", g);
    if (element(def.groups, g, swivel_default_group_def(0)).limb_count != 0 && group.limb_count != def.body_count)
        return fail(SWIVEL_INVALID_ARGUMENT, "group %u has %u limbs, but there are %u bodies; leave the count 0", g,
                    group.limb_count, def.body_count);
    swivel_binding binding = swivel_default_binding();
    swivel_status status = check_size<swivel_limb_joints>("limb joints", size_of(group.joints));
    if (status == SWIVEL_OK) status = check_reserved("limb joints", joints_of(group));
    if (status == SWIVEL_OK) status = check_limb(skeleton, group, binding);
    return status == SWIVEL_OK ? status : fail_in_group(g, status);
}

// Limbs hang beside each other: what one turns is above no joint that another turns.
swivel_status check_apart(const swivel_crowd_def& def, const swivel_skeleton& skeleton, std::uint32_t g)
{
    const auto turning = turned_joints(joints_of(group_at(def, g)));
    for (std::uint32_t other = 0; other < def.group_count; ++other) {
        if (other == g) continue;
        for (const std::uint32_t joint : turned_joints(joints_of(group_at(def, other))))
            for (const std::uint32_t above : turning)
                if (is_above(skeleton, above, joint))
                    return fail(SWIVEL_INVALID_ARGUMENT,
                                "group %u turns joint %u, which is %s joint %u of group %u; a body's limbs hang beside "
                                "each other",
                                g, above, above == joint ? "also" : "above", joint, other);
    }
    return SWIVEL_OK;
}

// A needed joint's place in the plan; joint_count if it is not there yet.
std::uint32_t find(const BodyJoint* joints, std::uint32_t joint_count, std::int32_t skeleton_joint)
{
    if (skeleton_joint < 0) return 0;
    std::uint32_t n = 1;
    while (n < joint_count && joints[n].skeleton_joint != static_cast<std::uint32_t>(skeleton_joint)) ++n;
    return n;
}

}  // namespace

swivel_status check_bodies(const swivel_crowd_def& def)
{
    swivel_status status = check_size<swivel_skeleton>("skeleton", size_of(def.skeleton));
    const swivel_skeleton skeleton = skeleton_of(def);
    if (status == SWIVEL_OK) status = check_reserved("skeleton", skeleton);
    for (std::uint32_t g = 0; g < def.group_count && status == SWIVEL_OK; ++g)
        status = check_group_joints(def, skeleton, g);
    for (std::uint32_t g = 0; g < def.group_count && status == SWIVEL_OK; ++g) status = check_apart(def, skeleton, g);
    if (status != SWIVEL_OK) return status;
    for_each_needed(def, skeleton, [&](std::uint32_t joint) {
        RestJoint rest;
        if (status == SWIVEL_OK) status = read_joint(skeleton, joint, rest);
    });
    return status;
}

std::uint32_t needed_joint_count(const swivel_crowd_def& def)
{
    std::uint32_t count = 1;
    for_each_needed(def, skeleton_of(def), [&](std::uint32_t) { ++count; });
    return count;
}

void plan_joints(const swivel_crowd_def& def, BodyJoint* joints)
{
    const swivel_skeleton skeleton = skeleton_of(def);
    joints[0] = {};
    std::uint32_t count = 1;
    const auto is_planned = [&](std::int32_t joint) { return find(joints, count, joint) < count; };
    const auto plan = [&](std::uint32_t joint) {
        RestJoint rest;
        read_joint(skeleton, joint, rest);
        const auto number = [](double x) { return static_cast<float>(x); };
        joints[count] = {joint,
                         find(joints, count, parent_of(skeleton, joint)),
                         is_turned(def, joint),
                         {number(rest.place.at<kE1>()), number(rest.place.at<kE2>()), number(rest.place.at<kE3>())}};
        ++count;
    };
    for_each_needed(def, skeleton, [&](std::uint32_t each) {
        while (!is_planned(static_cast<std::int32_t>(each))) {
            std::uint32_t joint = each;
            while (!is_planned(parent_of(skeleton, joint)))
                joint = static_cast<std::uint32_t>(parent_of(skeleton, joint));
            plan(joint);
        }
    });
}

BodyLimb body_limb(const swivel_crowd_def& def, const swivel_group_def& group, const swivel_binding& binding,
                   const BodyJoint* joints, std::uint32_t joint_count)
{
    const swivel_skeleton skeleton = skeleton_of(def);
    const swivel_limb_joints of = joints_of(group);
    const auto planned = [&](std::uint32_t joint) {
        return find(joints, joint_count, static_cast<std::int32_t>(joint));
    };
    const auto parent = [&](std::uint32_t joint) { return find(joints, joint_count, parent_of(skeleton, joint)); };
    const float(&q)[4] = binding.upper_from_arm;
    const Vector<float> hinge = turned(rotor(q[0], q[1], q[2], q[3]), vector(1.0f, 0.0f, 0.0f));
    return {parent(of.shoulder),
            planned(of.shoulder),
            parent(of.elbow),
            planned(of.elbow),
            parent(of.wrist),
            planned(of.wrist),
            {hinge.at<kE1>(), hinge.at<kE2>(), hinge.at<kE3>()}};
}

swivel_binding body_binding(const swivel_crowd_def& def, const swivel_group_def& group)
{
    swivel_binding binding = swivel_default_binding();
    check_limb(skeleton_of(def), group, binding);
    return binding;
}

}  // namespace swivel
