// SPDX-License-Identifier: MIT
#include "tools/rig/facing.h"

#include <vector>

namespace swivel::tools {

namespace {

using Eigen::Vector3d;
using formats::Clip;

constexpr std::size_t kArms = 0, kLegs = 2;  // where a pair starts in formats::kLimbNames

// The part of `v` at right angles to up, unit; nothing within 30 degrees of up.
std::optional<Vector3d> level(const Vector3d& v, const Vector3d& up)
{
    const Vector3d across = v - v.dot(up) * up;
    if (!(across.norm() > 0.5 * v.norm())) return std::nullopt;
    return across.normalized();
}

}  // namespace

Facing facing_of(const Clip& clip, const KnownLimbs& joints)
{
    const std::vector<formats::JointPose> pose_w = formats::rest_pose(clip);
    const auto has = [&](std::size_t pair) { return joints[pair] && joints[pair + 1]; };
    const auto start_w = [&](std::size_t limb) -> const Vector3d& { return position_of(pose_w, (*joints[limb])[0]); };
    Facing facing;
    if (has(kArms) && has(kLegs)) {
        const Vector3d trunk_w = (start_w(kArms) + start_w(kArms + 1)) / 2 - (start_w(kLegs) + start_w(kLegs + 1)) / 2;
        if (trunk_w.norm() > 0) {
            facing.up_w = trunk_w.normalized();
            facing.up_source = "hips to shoulders";
        }
    }
    Vector3d way_of_toes_w = Vector3d::Zero();
    for (const std::size_t leg : {kLegs, kLegs + 1}) {
        if (!joints[leg]) continue;
        const int foot = (*joints[leg])[2];
        for (const int toe : toes_of(clip, formats::kLimbNames[leg].side, foot))
            way_of_toes_w += (position_of(pose_w, toe) - position_of(pose_w, foot)).normalized();
    }
    if (const auto way = level(way_of_toes_w, facing.up_w)) {
        facing.forwards_w = *way;
        facing.forwards_source = "the toes";
        return facing;
    }
    for (const std::size_t pair : {kArms, kLegs}) {
        if (!has(pair)) continue;
        const auto left = level(start_w(pair) - start_w(pair + 1), facing.up_w);
        if (!left) continue;
        const int fork = fork_of(clip, (*joints[pair])[0], (*joints[pair + 1])[0]);
        const bool is_mirrored = fork >= 0 && pose_w[static_cast<std::size_t>(fork)].mirrored;
        facing.forwards_w = (is_mirrored ? Vector3d(-*left) : *left).cross(facing.up_w);
        facing.forwards_source = pair == kArms ? "left and right shoulder" : "left and right hip";
        return facing;
    }
    facing.forwards_w = level(facing.forwards_w, facing.up_w).value_or(facing.up_w.unitOrthogonal());
    return facing;
}

}  // namespace swivel::tools
