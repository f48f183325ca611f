// SPDX-License-Identifier: MIT
#include "tools/retarget/rest_figure.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

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

using formats::Clip;
using Poses = std::vector<formats::JointPose>;

constexpr double kNearGround = 0.3, kStill = 0.3;  // legs; legs a second
constexpr std::size_t kFewest = 10;

struct Feet {
    const RestFigure& figure;
    bool has_toes;

    int ankle(std::size_t side) const { return (*figure.limbs[2 + side])[2]; }
    int ground_joint(std::size_t side) const { return has_toes ? figure.toes[side] : ankle(side); }
    Vector3d own_place(const Poses& pose_w, int joint) const { return figure.own(formats::position_of(pose_w, joint)); }
    double height(const Poses& pose_w) const
    {
        double lowest = HUGE_VAL;
        for (std::size_t side = 0; side < 2; ++side)
            if (figure.limbs[2 + side]) lowest = std::min(lowest, own_place(pose_w, ground_joint(side)).y());
        return lowest;
    }
    double slope(const Poses& pose_w, std::size_t side) const
    {
        return slope_of(own_place(pose_w, figure.toes[side]) - own_place(pose_w, ankle(side)));
    }
    double step(const Poses& before_w, const Poses& after_w, int joint) const
    {
        return (own_place(after_w, joint) - own_place(before_w, joint)).norm();
    }
};

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

double slope_of(const Vector3d& way) { return std::atan2(way.y(), std::hypot(way.x(), way.z())); }

Stance stance_of(const Clip& clip, const RestFigure& figure, bool has_toes)
{
    const Feet feet{figure, has_toes};
    const auto has_slope = [&](std::size_t side) { return has_toes && figure.limbs[2 + side]; };
    Stance stance;
    const bool is_files_own = std::ranges::all_of(clip.joints, [](const formats::Joint& joint) {
        return pose_without_keys(joint).rotation.coeffs() == joint.rest_rotation.coeffs();
    });  // a frame in mid-step tells nothing of flat feet
    if (is_files_own && std::abs(feet.height(figure.pose_w)) < kNearGround * figure.leg) {
        stance.height = feet.height(figure.pose_w);
        for (std::size_t side = 0; side < 2; ++side)
            if (has_slope(side)) stance.slope[side] = feet.slope(figure.pose_w, side);
        return stance;
    }
    if (clip.frame_count < 2) return stance;
    std::vector<double> heights, still;  // of the lower foot in each frame, and where it is still
    std::vector<double> slopes;          // of both feet: in some clips one of them hardly stands
    Poses before_w;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const Poses pose_w = formats::world_pose(clip, frame);
        heights.push_back(feet.height(pose_w));
        const double max_step = kStill * figure.leg * clip.frame_time;
        for (std::size_t side = 0; side < 2 && frame > 0; ++side) {
            if (!figure.limbs[2 + side] || feet.step(before_w, pose_w, feet.ankle(side)) >= max_step ||
                feet.step(before_w, pose_w, feet.ground_joint(side)) >= max_step)
                continue;
            if (const double height = feet.own_place(pose_w, feet.ground_joint(side)).y(); height <= heights.back())
                still.push_back(height);
            if (has_toes) slopes.push_back(feet.slope(pose_w, side));
        }
        before_w = pose_w;
    }
    stance.height = still.size() >= kFewest ? quantile(still, 0.5) : quantile(heights, 0.05);
    for (std::size_t side = 0; side < 2; ++side)
        if (has_slope(side) && slopes.size() >= kFewest) stance.slope[side] = quantile(slopes, 0.9);
    return stance;
}

}  // namespace swivel::tools
