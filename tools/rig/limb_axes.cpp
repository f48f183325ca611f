// SPDX-License-Identifier: MIT
#include "tools/rig/limb_axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

void take(AngleRange& range, double angle)
{
    range.min = std::min(range.min, angle);
    range.max = std::max(range.max, angle);
}

// To the next tenth. 0.002 covers what floats add in a solve: a cosine is off by some 1e-7 there, which is less than
// 0.002 degrees from an opening of 0.2 on. "rig axes: a clip fits into the limits that are printed" solves under them.
double tenth_above(double angle) { return std::min(180.0, std::ceil(10 * (angle + 0.002)) / 10); }
double tenth_below(double angle) { return std::max(0.0, std::floor(10 * (angle - 0.002)) / 10); }

}  // namespace

std::string direction_words(const Vector3d& direction_w, const Facing& facing)
{
    const Vector3d left = facing.up_w.cross(facing.forwards_w);
    struct Way {
        double share;
        std::string_view positive, negative;
    };
    std::array<Way, 3> ways = {Way{direction_w.dot(left), "left", "right"},
                               Way{direction_w.dot(facing.up_w), "up", "down"},
                               Way{direction_w.dot(facing.forwards_w), "forwards", "backwards"}};
    std::stable_sort(ways.begin(), ways.end(),
                     [](const Way& a, const Way& b) { return std::abs(a.share) > std::abs(b.share); });
    std::string words;
    for (const Way& way : ways) {
        // 0.38: the sine of 22.5 degrees, half way from an axis to the diagonal.
        if (!words.empty() && std::abs(way.share) < 0.38) break;
        words.append(words.empty() ? "" : " and ").append(way.share > 0 ? way.positive : way.negative);
    }
    return words;
}

std::optional<LimbRange> range_of(const formats::Clip& clip, const Limb& limb)
{
    if (clip.frame_count < 2) return std::nullopt;
    LimbRange range{};
    range.bend = to_three_decimals(limb.bend);
    formats::LimbRest rest = limb.rest;
    put(limb.as_solved(Vector3d(range.bend.stableNormalized())), rest.bend);
    const Quaterniond arm_from_parent = quaternion(binding_of(rest).parent_from_arm).conjugate();
    std::vector<Vector3d> upper;
    Vector3d sum = Vector3d::Zero();
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const ChainPose pose = chain_pose(clip, frame, limb.chain);
        const Vector3d bone = pose.position[1] - pose.position[0], lower = pose.position[2] - pose.position[1];
        if (!(bone.norm() > 0) || !(lower.norm() > 0)) continue;
        upper.push_back(arm_from_parent * limb.as_solved(Vector3d(bone.normalized())));
        sum += upper.back();
        take(range.from_z, degrees_between(upper.back(), Vector3d::UnitZ()));
        take(range.flexion, degrees_between(bone, lower));
    }
    if (upper.empty()) return std::nullopt;
    // 1e-3: directions that cancel have no mean; then any axis will do.
    const bool has_mean = sum.norm() > 1e-3 * static_cast<double>(upper.size());
    range.axis = has_mean ? to_three_decimals(sum.normalized()) : Vector3d::UnitZ();
    double opening = 0;
    for (const Vector3d& bone : upper) opening = std::max(opening, degrees_between(bone, range.axis));
    range.opening_deg = tenth_above(opening);
    range.flexion = {tenth_below(range.flexion.min), tenth_above(range.flexion.max)};
    // A limb that never moves tells no limits. All is rounded to tenths.
    constexpr double kTenth = 0.100001;
    if (range.opening_deg <= kTenth && range.flexion.max - range.flexion.min <= kTenth) return std::nullopt;
    return range;
}

}  // namespace swivel::tools
