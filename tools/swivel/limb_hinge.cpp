// SPDX-License-Identifier: MIT
#include "tools/swivel/limb_hinge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <span>

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::Clip;
using formats::JointPose;
using formats::LimbKind;

constexpr double kDegree = std::numbers::pi / 180;

bool speaks_of_toes(std::string name)
{
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
    return name.find("toe") != std::string::npos || name.find("ball") != std::string::npos;
}

// Where a foot points: to the joints below it that are called toe or ball, else to the only one.
struct Toes {
    Vector3d direction = Vector3d::Zero();  // in the world: the sum of unit steps to them
    int count = 0;
    bool named = false;
};
Toes toes_of(const Clip& clip, std::span<const JointPose> pose_w, int foot)
{
    const auto step = [&](int joint) -> Vector3d {
        return pose_w[static_cast<std::size_t>(joint)].position - pose_w[static_cast<std::size_t>(foot)].position;
    };
    const std::vector<int> below = formats::child_joints(clip, foot);
    Toes toes;
    for (const int joint : below) {
        if (!speaks_of_toes(formats::joint_at(clip, joint).name)) continue;
        toes.direction += step(joint).normalized();
        ++toes.count;
        toes.named = true;
    }
    if (!toes.named && below.size() == 1) toes = {step(below[0]).normalized(), 1, false};
    return toes;
}

// The joint that both hang on, or -1.
int fork_of(const Clip& clip, int a, int b)
{
    while (a != b) {
        int& later = a > b ? a : b;  // parents come before their children
        later = formats::joint_at(clip, later).parent;
    }
    return a;
}

// `v` without its part along `axis`, unit; nothing where little is left.
std::optional<Vector3d> across(const Vector3d& v, const Vector3d& axis)
{
    const Vector3d rest = v - v.dot(axis) * axis;
    if (!(rest.norm() > 0.1 * v.norm())) return std::nullopt;
    return rest.normalized();
}

// The bend of two bones given in one space: the axis, as long as its sine.
Vector3d bend_of(const Vector3d& upper, const Vector3d& lower) { return lower.normalized().cross(upper.normalized()); }

// Its bend in the upper joint's axes, the upper bone laid where it is at rest.
Vector3d bend_of(const ChainPose& pose, const Vector3d& rest_bone)
{
    const Vector3d upper = pose.upper_bone(), lower = pose.turn[0].conjugate() * (pose.turn[1] * pose.lower_bone());
    return aim(rest_bone, upper).conjugate() * bend_of(upper, lower);
}

// The mean of the frames' bends, axes as long as their sines; nothing for a clip that hardly bends the limb, or to both
// sides.
std::optional<Vector3d> mean_bend(const Clip& clip, const LimbChain& chain, const Vector3d& rest_bone)
{
    if (clip.frame_count < 2) return std::nullopt;  // one pose is no motion
    Vector3d sum = Vector3d::Zero();
    double weight = 0;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const Vector3d bend = bend_of(chain_pose(clip, frame, chain), rest_bone);
        if (!bend.allFinite()) continue;
        sum += bend;
        weight += bend.norm();
    }
    // 0.02: a mean bend of one degree; half: the bends must agree on an axis, not cancel.
    const bool is_clear = weight > 0.02 * static_cast<double>(clip.frame_count) && sum.norm() > 0.5 * weight;
    return is_clear ? std::optional(Vector3d(sum / static_cast<double>(clip.frame_count))) : std::nullopt;
}

// Where flexion takes the lower bone by the table, in the world.
Vector3d flexion_by_table(LimbKind kind, const Vector3d& upper_w, const Front& front)
{
    const double sense = kind == LimbKind::arm ? 1 : -1;
    const bool points_forwards = std::abs(upper_w.dot(front.forwards)) > 0.9;
    return sense * (points_forwards ? front.up : front.forwards);
}

}  // namespace

Front figure_front(const Clip& clip, const std::array<std::optional<LimbJoints>, 4>& joints)
{
    const std::vector<JointPose> pose_w = formats::rest_pose(clip);
    const auto place = [&](std::size_t limb, std::size_t part) -> const Vector3d& {
        return pose_w[static_cast<std::size_t>((*joints[limb])[part])].position;
    };
    const bool arms = joints[0] && joints[1], legs = joints[2] && joints[3];
    Front front;
    Vector3d up = Vector3d::Zero();
    if (arms && legs) up = place(0, 0) + place(1, 0) - place(2, 0) - place(3, 0);
    front.up_source = "hips to shoulders";
    if (legs && !(up.norm() > 0)) {
        up = place(2, 0) + place(3, 0) - place(2, 2) - place(3, 2);
        front.up_source = "the legs";
    }
    if (up.norm() > 0)
        front.up = up.normalized();
    else
        front.up_source = Front().up_source;

    if (!arms && !legs) return front;
    const std::size_t pair = arms ? 0 : 2;
    const Vector3d left = place(pair, 0) - place(pair + 1, 0);
    const int fork = fork_of(clip, (*joints[pair])[0], (*joints[pair + 1])[0]);
    const bool mirrored = fork >= 0 && pose_w[static_cast<std::size_t>(fork)].mirrored;
    const auto level = across(mirrored ? Vector3d(-left) : left, front.up);
    const std::optional<Vector3d> by_pair = level ? std::optional(Vector3d(level->cross(front.up))) : std::nullopt;
    if (legs) {
        Toes both;
        for (const std::size_t leg : {2u, 3u}) {
            const Toes toes = toes_of(clip, pose_w, (*joints[leg])[2]);
            both.direction += toes.direction;
            both.count += toes.count;
            both.named = both.named || toes.named;
        }
        // A foot's only joint without a name may be its heel, or hold a shoe; a bird's toes point both ways. They tell
        // within 60 degrees of the pair, or, by name, of its back: a figure whose mirror is baked into its joints.
        const bool agree_on_one = both.direction.norm() > 0.25 * both.count;
        const auto ahead = agree_on_one ? across(both.direction, front.up) : std::nullopt;
        const double agree = ahead && by_pair ? ahead->dot(*by_pair) : 1;
        if (ahead && (agree > 0.5 || (both.named && agree < -0.5)))
            return {*ahead, front.up, "the toes", front.up_source};
    }
    if (by_pair) return {*by_pair, front.up, arms ? "left and right shoulder" : "left and right hip", front.up_source};
    return front;
}

Hinge choose_hinge(const Clip& clip, LimbKind kind, const LimbChain& chain, const ChainPose& rest,
                   const JointPose& parent_w, const Front& front)
{
    const Vector3d upper = rest.upper_bone().normalized();
    const Vector3d bend = bend_of(rest, upper);
    const double bend_deg = std::asin(std::min(bend.norm(), 1.0)) / kDegree;
    const auto mean = mean_bend(clip, chain, upper);
    // Knock-knees, or a forearm that hangs, bend at rest across what the clip does; knees pressed through, against it.
    const double more = mean ? mean->norm() / bend.norm() : 0;
    const double agreement = mean ? mean->normalized().dot(bend.normalized()) : 1;
    const bool clip_differs =
        (agreement < std::cos(30 * kDegree) && more > 2) || (agreement < std::cos(120 * kDegree) && more > 1);
    if (bend_deg > 5 && !clip_differs)
        return {bend.normalized(), fmt::format("bend of the rest pose, {:.1f} degrees", bend_deg)};
    if (mean) return {mean->normalized(), "mean bend of the clip"};

    const auto to_world = [&](const Vector3d& v) {
        const Vector3d v_p = rest.turn[0] * v;
        return Vector3d(parent_w.rotation * (parent_w.mirrored ? formats::mirrored(v_p) : v_p));
    };
    const Vector3d flexion_w = flexion_by_table(kind, to_world(upper), front);
    const Vector3d turned = parent_w.rotation.conjugate() * flexion_w;
    const Vector3d flexion = rest.turn[0].conjugate() * (parent_w.mirrored ? formats::mirrored(turned) : turned);
    const Vector3d by_table = flexion.cross(upper).normalized();
    if (bend_deg > 0.5 && bend.dot(by_table) > std::cos(45 * kDegree) * bend.norm())
        return {bend.normalized(), fmt::format("slight bend of the rest pose, {:.1f} degrees", bend_deg)};
    return {by_table, fmt::format("{} {}, facing by {}, as neither rest pose nor clip tells",
                                  kind == LimbKind::arm ? "elbows bend" : "knees bend",
                                  std::abs(to_world(upper).dot(front.forwards)) > 0.9
                                      ? (kind == LimbKind::arm ? "upwards" : "downwards")
                                      : (kind == LimbKind::arm ? "forwards" : "backwards"),
                                  front.source)};
}

}  // namespace swivel::tools
