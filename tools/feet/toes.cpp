// SPDX-License-Identifier: MIT
#include "tools/feet/toes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::Clip;

constexpr double kBendSpeed = 2 * std::numbers::pi;  // radians a second

// How far toes bend up about their axis so that their tip is at least `rise` over the toe, radians. From toes that
// point ahead: 90 degrees at most, and less where they point back, which feet do that kneel or lie.
double bend_to(const Vector3d& way_w, const Vector3d& across_w, const Vector3d& up_w, double rise)
{
    // In the plane that the toes bend in.
    const Vector3d up = up_w - up_w.dot(across_w) * across_w, way = way_w - way_w.dot(across_w) * across_w;
    const double reach = up.norm() * way.norm();
    if (reach == 0 || across_w.isZero()) return 0;  // it lies on its side, or points straight down at rest
    const double angle = std::atan2(way.dot(up), way.dot(up.cross(across_w)));
    const double beside = way_w.dot(across_w) * up_w.dot(across_w);
    const double min_angle = std::asin(std::clamp((rise - beside) / reach, -1.0, 1.0));
    return std::max(0.0, std::min({min_angle - angle, std::numbers::pi / 2, angle + std::numbers::pi}));
}

// How far the toes of one leg bend up in each frame, radians.
std::vector<double> bends_of(const LegPath& leg, const std::vector<Quaterniond>& turn_w, const LegMotion& motion,
                             const Floor& floor)
{
    std::vector<double> bends;
    for (std::size_t frame = 0; frame < motion.frame_count(); ++frame)
        bends.push_back(bend_to(leg.tip_w[frame] - leg.toe_w[frame], leg.across_w[frame], turn_w[frame] * motion.up_w,
                                leg.tip_rise - std::max(floor.over(leg.toe_w[frame]), 0.0)));
    // Those that come and go in a frame begin earlier and end later.
    const double step = kBendSpeed * motion.frame_time;
    for (std::size_t n = 1; n < bends.size(); ++n) bends[n] = std::max(bends[n], bends[n - 1] - step);
    for (std::size_t n = bends.size(); n-- > 1;) bends[n - 1] = std::max(bends[n - 1], bends[n] - step);
    return bends;
}

// A joint's local rotation after a turn of the world.
Quaterniond turned(const Clip& clip, std::size_t frame, int joint, const Quaterniond& turn_w)
{
    const int parent = joint_at(clip, joint).parent;
    const formats::JointPose parent_w =
        parent < 0 ? formats::JointPose() : formats::world_pose(clip, frame)[static_cast<std::size_t>(parent)];
    const Quaterniond inner = parent_w.rotation.conjugate() * turn_w * parent_w.rotation;
    return (parent_w.mirrored ? formats::mirrored(inner) : inner) *
           clip.rotation[frame * clip.joints.size() + static_cast<std::size_t>(joint)];
}

}  // namespace

std::vector<TurnedJoint> bend_toes(const Clip& clip, const LegMotion& motion, const PlacedFeet& placed,
                                   const Floor& floor)
{
    std::vector<TurnedJoint> bent;
    for (std::size_t n = 0; n < motion.legs.size(); ++n) {
        const LegPath& leg = motion.legs[n];
        if (!leg.has_toe) continue;
        const std::vector<double> bends = bends_of(leg, placed.legs[n].turn_w, motion, floor);
        if (std::ranges::max(bends) == 0) continue;
        TurnedJoint toes{leg.toe, {}, {}};
        for (std::size_t frame = 0; frame < clip.frame_count; ++frame)
            toes.rotation.push_back(
                turned(clip, frame, leg.toe, Quaterniond(Eigen::AngleAxisd(bends[frame], leg.across_w[frame]))));
        bent.push_back(std::move(toes));
    }
    return bent;
}

}  // namespace swivel::tools
