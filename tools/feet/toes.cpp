// SPDX-License-Identifier: MIT
#include "tools/feet/toes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/rig/limb_chain.h"

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::Clip;

constexpr double kBendSpeed = 2 * std::numbers::pi;  // radians a second
constexpr double kUpright = 1e-6;                    // of a way's length, across

// The angle of a way over the ground, radians.
double elevation(const Vector3d& way_w, const Vector3d& up_w)
{
    return std::asin(std::clamp(way_w.normalized().dot(up_w), -1.0, 1.0));
}

// The turn that raises a way by an angle, upright at most; one that is upright stays.
Quaterniond raise_by(const Vector3d& way_w, const Vector3d& up_w, double angle)
{
    const Vector3d level_w = way_w - way_w.dot(up_w) * up_w;
    if (level_w.norm() < kUpright * way_w.norm()) return Quaterniond::Identity();
    const double after = std::min(elevation(way_w, up_w) + angle, std::numbers::pi / 2);
    return aim(way_w, std::cos(after) * level_w.normalized() + std::sin(after) * up_w);
}

// How far the toes of one leg bend up in each frame, radians.
std::vector<double> bends_of(const LegPath& leg, const std::vector<Quaterniond>& turn_w, const LegMotion& motion,
                             const Floor& floor)
{
    std::vector<double> bends;
    for (std::size_t frame = 0; frame < motion.frame_count(); ++frame) {
        const Vector3d way_w = leg.tip_w[frame] - leg.toe_w[frame];
        const double rise = leg.tip_rise - std::max(floor.over(leg.toe_w[frame]), 0.0);
        const double min_angle = std::asin(std::clamp(rise / way_w.norm(), -1.0, 1.0));
        bends.push_back(std::max(0.0, min_angle - elevation(way_w, turn_w[frame] * motion.up_w)));
    }
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
        const std::vector<Quaterniond>& turn_w = placed.legs[n].turn_w;
        const std::vector<double> bends = bends_of(leg, turn_w, motion, floor);
        if (std::ranges::max(bends) == 0) continue;
        TurnedJoint toes{leg.toe, {}, {}};
        for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
            const Vector3d way_w = leg.tip_w[frame] - leg.toe_w[frame];
            toes.rotation.push_back(
                turned(clip, frame, leg.toe, raise_by(way_w, turn_w[frame] * motion.up_w, bends[frame])));
        }
        bent.push_back(std::move(toes));
    }
    return bent;
}

}  // namespace swivel::tools
