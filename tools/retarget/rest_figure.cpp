// SPDX-License-Identifier: MIT
#include "tools/retarget/rest_figure.h"

#include <cmath>
#include <numbers>

#include "tools/rig/facing.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

using Eigen::Vector3d;

constexpr double kNearAxis_deg = 15;

Eigen::Quaterniond axes_of(const Facing& facing)
{
    const Vector3d up = nearest_axis(facing.up_w);
    Vector3d forwards = (facing.forwards_w - facing.forwards_w.dot(up) * up).normalized();
    const Vector3d axis = nearest_axis(forwards);
    if (forwards.dot(axis) > std::cos(kNearAxis_deg * std::numbers::pi / 180)) forwards = axis;
    Eigen::Matrix3d axes;
    axes << up.cross(forwards), up, forwards;
    return Eigen::Quaterniond(axes);
}

}  // namespace

RestFigure rest_figure(const formats::Clip& clip, const std::vector<BodyPart>& parts)
{
    RestFigure figure;
    figure.pose_w = formats::rest_pose(clip);
    figure.limbs = limbs_of(parts);
    figure.axes = axes_of(facing_of(clip, figure.limbs));
    if (const std::vector<int> hips = joints_of(parts, "hips"); !hips.empty())
        figure.mirrored = figure.pose_w[static_cast<std::size_t>(hips[0])].mirrored;
    int count = 0;
    for (std::size_t side = 0; side < 2; ++side) {
        const std::vector<int> toes = joints_of(parts, side == 0 ? "leftToes" : "rightToes");
        if (!toes.empty()) figure.toes[side] = toes[0];
        if (!figure.limbs[2 + side]) continue;
        figure.leg += figure.length(2 + side);
        ++count;
    }
    if (count > 0) figure.leg /= count;
    return figure;
}

}  // namespace swivel::tools
