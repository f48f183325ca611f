// SPDX-License-Identifier: MIT
#include "tools/rig/limb_bend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

using Eigen::Vector3d;
using formats::Clip;
using formats::JointPose;
using formats::LimbKind;
using formats::LimbName;

// Of 10 degrees: above what modelling and noise leave of straight limbs.
constexpr double kSine10 = 0.17364817766693033;
// A rest pose that bends a limb clearly: twice that. Among 1,072 limbs of files in use one rested bent by 10.5 degrees,
// and its clip bent it by 90 in the mean, 77 degrees away from there.
constexpr double kSine20 = 0.3420201433256687;
// A clip that bends a limb clearly: three times that in the mean, and one way in so many tenths of its frames. One
// tenth is left for frames that pass through straight.
constexpr double kSine30 = 0.5;
constexpr std::ptrdiff_t kTenthsOneWay = 9;
constexpr double kCosine30 = 0.8660254037844386;

// The axis that two bones are bent about, as long as the sine of the bend: the cross product of the unit bones, lower
// by upper. It is in the upper joint's axes, with the upper bone turned to where it is at rest.
Vector3d axis_of(const ChainPose& pose, const Vector3d& rest_upper)
{
    const Vector3d upper = pose.upper_bone().normalized();
    const Vector3d lower = (pose.turn[0].conjugate() * (pose.turn[1] * pose.lower_bone())).normalized();
    return aim(rest_upper, upper).conjugate() * lower.cross(upper);
}

// The axis of each frame; zero where a bone has no length.
std::vector<Vector3d> frame_axes(const Clip& clip, const LimbChain& chain, const Vector3d& rest_upper)
{
    std::vector<Vector3d> axes;
    axes.reserve(clip.frame_count);
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const Vector3d axis = axis_of(chain_pose(clip, frame, chain), rest_upper);
        axes.push_back(axis.allFinite() ? axis : Vector3d(Vector3d::Zero()));
    }
    return axes;
}

// Zero without frames.
Vector3d mean_of(std::span<const Vector3d> axes)
{
    const Vector3d sum = std::accumulate(axes.begin(), axes.end(), Vector3d(Vector3d::Zero()));
    return sum / static_cast<double>(std::max<std::size_t>(axes.size(), 1));
}

double degrees_of_sine(double sine) { return std::asin(std::min(sine, 1.0)) * (180 / std::numbers::pi); }

// What one witness says of a bend.
struct Said {
    Vector3d axis;     // as long as the sine of the bend
    bool is_clear;     // beyond doubt
    std::string text;  // for people

    bool tells() const { return axis.norm() > kSine10; }
};

Said rest_says(const ChainPose& rest, const Vector3d& upper)
{
    const Vector3d axis = axis_of(rest, upper);
    const double degrees = degrees_between(rest.turn[0] * rest.upper_bone(), rest.turn[1] * rest.lower_bone());
    return {axis, axis.norm() > kSine20, fmt::format("the rest pose, bent by {:.1f} degrees", degrees)};
}

Said clip_says(std::span<const Vector3d> axes)
{
    const Vector3d mean = mean_of(axes);
    const auto one_way = std::ranges::count_if(axes, [&](const Vector3d& axis) { return axis.dot(mean) > 0; });
    const bool is_steady = 10 * one_way >= kTenthsOneWay * std::ssize(axes);
    return {mean, mean.norm() > kSine30 && is_steady,
            fmt::format("the clip, bent by {:.1f} degrees in the mean", degrees_of_sine(mean.norm()))};
}

// Where flexion carries a lower bone that turns about the opposite of this axis: across the bone, unit.
Vector3d bend_of_hinge(const Vector3d& upper_bone, const Vector3d& axis) { return upper_bone.cross(axis).normalized(); }

}  // namespace

Bend choose_bend(const Clip& clip, LimbName limb, const LimbChain& chain, const ChainPose& rest,
                 const JointPose& parent_w, const Facing& facing)
{
    const Vector3d upper = rest.upper_bone().normalized();
    const Said by_rest = rest_says(rest, upper), by_clip = clip_says(frame_axes(clip, chain, upper));
    if (by_clip.is_clear && by_rest.tells() && !by_rest.is_clear)
        return {bend_of_hinge(upper, by_clip.axis), by_clip.text + "; it is clearer than " + by_rest.text};
    for (const Said& said : {by_rest, by_clip})
        if (said.tells()) return {bend_of_hinge(upper, said.axis), said.text};

    const bool is_arm = limb.kind == LimbKind::arm;
    const auto seen = [&](const Vector3d& v) { return parent_w.mirrored ? formats::mirrored(v) : v; };
    const auto in_joint = [&](const Vector3d& v_w) -> Vector3d {
        const Vector3d v = rest.turn[0].conjugate() * seen(parent_w.rotation.conjugate() * v_w);
        return (v - v.dot(upper) * upper).normalized();
    };
    const Vector3d upper_w = parent_w.rotation * seen(rest.turn[0] * upper);
    const Vector3d way_w = is_arm ? facing.forwards_w : Vector3d(-facing.forwards_w);
    if (std::abs(upper_w.dot(way_w)) > kCosine30)
        throw CannotBind(
            fmt::format("it is straight and points {} (forwards is told by {}), so nothing tells which way it bends",
                        upper_w.dot(facing.forwards_w) > 0 ? "ahead" : "behind", facing.forwards_source),
            fmt::format("write bend = {} under [limb.{}] in a crowd file, if it hung and was swung there",
                        toml_row(in_joint(aim(-facing.up_w, upper_w) * way_w)), limb_word(limb)));
    return {in_joint(way_w),
            fmt::format("{}; forwards is told by {}", is_arm ? "elbows bend forwards" : "knees bend backwards",
                        facing.forwards_source)};
}

std::string clip_against(const Clip& clip, LimbName limb, const LimbChain& chain, const ChainPose& rest,
                         const Vector3d& bend)
{
    const Vector3d upper = rest.upper_bone().normalized(), mean = mean_of(frame_axes(clip, chain, upper));
    if (!(bend_of_hinge(upper, mean).dot(bend) < 0)) return "";
    double most = 0;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const ChainPose pose = chain_pose(clip, frame, chain);
        if (bend_of_hinge(upper, axis_of(pose, upper)).dot(bend) < 0)
            most = std::max(most, degrees_between(pose.turn[0] * pose.upper_bone(), pose.turn[1] * pose.lower_bone()));
    }
    if (!(most > 30)) return "";
    return fmt::format(
        "the clip bends it to the other side, by up to {:.0f} degrees; to follow the clip, write bend = {} under "
        "[limb.{}] in a crowd file",
        most, toml_row(bend_of_hinge(upper, mean)), limb_word(limb));
}

}  // namespace swivel::tools
