// SPDX-License-Identifier: MIT
#include "tools/rig/facing.h"

#include <vector>

namespace swivel::tools {

namespace {

using Eigen::Vector3d;
using formats::Clip;
using formats::JointPose;

constexpr std::size_t kArms = 0, kLegs = 2;  // where a pair starts in formats::kLimbNames

// The part of `v` at right angles to up, unit; nothing within 30 degrees of up.
std::optional<Vector3d> level(const Vector3d& v, const Vector3d& up)
{
    const Vector3d across = v - v.dot(up) * up;
    if (!(across.norm() > 0.5 * v.norm())) return std::nullopt;
    return across.normalized();
}

struct RestingFigure {
    const Clip& clip;
    const KnownLimbs& joints;
    std::vector<JointPose> pose_w = formats::rest_pose(clip);

    const JointPose& pose(int joint) const { return pose_w[static_cast<std::size_t>(joint)]; }
    bool has(std::size_t pair) const { return joints[pair] && joints[pair + 1]; }
    // The upper joints of a pair: from right to left, and the middle.
    const Vector3d& start_w(std::size_t limb) const { return pose((*joints[limb])[0]).position; }
    Vector3d to_left_w(std::size_t pair) const { return start_w(pair) - start_w(pair + 1); }
    Vector3d middle_w(std::size_t pair) const { return (start_w(pair) + start_w(pair + 1)) / 2; }

    bool is_mirrored(std::size_t pair) const
    {
        const int fork = fork_of(clip, (*joints[pair])[0], (*joints[pair + 1])[0]);
        return fork >= 0 && pose(fork).mirrored;
    }

    Vector3d way_of_toes_w() const
    {
        Vector3d way_w = Vector3d::Zero();
        for (const std::size_t leg : {kLegs, kLegs + 1}) {
            if (!joints[leg]) continue;
            const int foot = (*joints[leg])[2];
            for (const int toe : toes_of(clip, formats::kLimbNames[leg].side, foot))
                way_w += (pose(toe).position - pose(foot).position).normalized();
        }
        return way_w;
    }
};

}  // namespace

Facing facing_of(const Clip& clip, const KnownLimbs& joints)
{
    const RestingFigure figure{clip, joints};
    Facing facing;
    if (figure.has(kArms) && figure.has(kLegs)) {
        const Vector3d trunk_w = figure.middle_w(kArms) - figure.middle_w(kLegs);
        if (trunk_w.norm() > 0) {
            facing.up_w = trunk_w.normalized();
            facing.up_source = "hips to shoulders";
        }
    }
    if (const auto way = level(figure.way_of_toes_w(), facing.up_w)) {
        facing.forwards_w = *way;
        facing.forwards_source = "the toes";
        return facing;
    }
    for (const std::size_t pair : {kArms, kLegs}) {
        if (!figure.has(pair)) continue;
        const auto left = level(figure.to_left_w(pair), facing.up_w);
        if (!left) continue;
        facing.forwards_w = (figure.is_mirrored(pair) ? Vector3d(-*left) : *left).cross(facing.up_w);
        facing.forwards_source = pair == kArms ? "left and right shoulder" : "left and right hip";
        return facing;
    }
    facing.forwards_w = level(facing.forwards_w, facing.up_w).value_or(facing.up_w.unitOrthogonal());
    return facing;
}

}  // namespace swivel::tools
