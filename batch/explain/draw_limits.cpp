// SPDX-License-Identifier: MIT
//
// Limits as lines in space. Trigonometry is allowed here, because no solve sees it.
#include "batch/explain/draw.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "batch/explain/explain_probe.h"
#include "batch/query/limb_value.h"
#include "core/joint_frame.h"
#include "core/region.h"

namespace swivel {

namespace {

constexpr double kCircle = 2 * std::numbers::pi;

// A cone's rim, and eight lines to it.
void draw_cone(const Vector<double>& apex, const Vector<double>& axis, double cosine, double radius, Drawing& to)
{
    const double sine = std::sqrt(std::fmax(1 - cosine * cosine, 0));
    const Vector<double> unit = normalise(axis), centre = apex + radius * cosine * unit,
                         a = radius * sine * any_across(unit), b = cross(unit, a);
    to.arc(SWIVEL_SHAPE_CONE, centre, a, b, 0, kCircle);
    for (int n = 0; n < 8; ++n) {
        const double t = n * kCircle / 8;
        to.line(SWIVEL_SHAPE_CONE, apex, centre + std::cos(t) * a + std::sin(t) * b);
    }
}

// The pieces of half-spaces' borders that are the region's: where it leaves no room.
void draw_region(const swivel_region& region, const ArmFrame& arm, double radius, Drawing& to)
{
    constexpr double kOnBorder = 1e-5;  // half-spaces are floats
    constexpr int kPieces = 72;
    for (std::uint32_t n = 0; n < region.first[region.part_count]; ++n) {
        const swivel_half_space& half = region.half_space[n];
        if (half.is_edge == 0) continue;
        const double cosine = double{half.cosine}, sine = std::sqrt(std::fmax(1 - cosine * cosine, 0));
        const Vector<double> axis = normalise(vector<double>(half.axis[0], half.axis[1], half.axis[2])),
                             a = sine * any_across(axis), b = cross(axis, a);
        const auto direction = [&](double piece) {
            const double t = piece * kCircle / kPieces;
            return Vector<double>(cosine * axis + std::cos(t) * a + std::sin(t) * b);
        };
        const auto place = [&](double piece) {
            return Vector<double>(arm.shoulder + sandwich(arm.rotation, radius * direction(piece)));
        };
        for (int piece = 0; piece < kPieces; ++piece)
            if (std::fabs(room(region, direction(piece + 0.5))) <= kOnBorder)
                to.line(SWIVEL_SHAPE_REGION, place(piece), place(piece + 1));
    }
}

// The pose of a limb without limits of its swivel; none if an input is bad. Not inlined, so that the probe is gone from
// the stack before arcs are asked for.
[[gnu::noinline]] std::optional<LimbPose> wished_pose(const Group& group, std::uint32_t limb)
{
    Probe probe(group, limb);
    for_each_limit([&](const FlagRow& row) { probe.give_up(row); });
    // Else arcs count from the wish as the step leaves it.
    if (probe.has(SWIVEL_STEP_WINS)) probe.give_up(SWIVEL_MAX_SWIVEL);
    if (probe.solve() & SWIVEL_BAD_INPUT) return std::nullopt;
    return probe.pose();
}

}  // namespace

void draw_limits(const Group& group, std::size_t limb, const LimbPose& pose, Drawing& to)
{
    const ArmFrame arm = arm_frame(group, limb);
    const double upper = std::sqrt(len2(pose.elbow - pose.shoulder));
    if (group.features & SWIVEL_WITH_SHOULDER_CONE) {
        const LimbValue cone(group, limb, SWIVEL_SHOULDER_CONE);
        draw_cone(pose.shoulder, sandwich(arm.rotation, vector_of(cone)), cone[3], upper, to);
    }
    // The hand's axis is at most so far from the forearm.
    if (group.features & SWIVEL_WITH_HAND_CONE)
        draw_cone(pose.wrist, pose.wrist - pose.elbow, LimbValue(group, limb, SWIVEL_HAND_CONE)[3], 2 * to.size, to);
    if (group.features & SWIVEL_WITH_REGION) draw_region(*group.region, arm, upper, to);
}

void draw_allowed(const swivel_crowd& crowd, std::uint32_t g, std::uint32_t limb, Drawing& to)
{
    const Group& group = crowd.groups[g];
    if (!(group.features & kSwivelLimits)) return;
    const std::optional<LimbPose> wished = wished_pose(group, limb);
    if (!wished) return;
    to.point(SWIVEL_SHAPE_WISH, wished->elbow);
    // The elbow's circle, from where it is wished on.
    const Vector<double> axis = normalise(wished->wrist - wished->shoulder), bone = wished->elbow - wished->shoulder,
                         centre = wished->shoulder + scalar_product(axis, bone) * axis, a = wished->elbow - centre,
                         b = cross(axis, a);
    constexpr std::uint32_t kArcs = 16;  // limits hardly ever leave more
    swivel_arc arcs[kArcs];
    std::uint32_t count = 0;
    if (swivel_allowed_arcs(&crowd, g, limb, arcs, kArcs, &count) != SWIVEL_OK) return;
    for (std::uint32_t n = 0; n < std::min(count, kArcs); ++n) {
        const double start = std::atan2(arcs[n].from[1], arcs[n].from[0]);
        const double angle = std::atan2(arcs[n].to[1], arcs[n].to[0]) - start;
        to.arc(SWIVEL_SHAPE_ALLOWED, centre, a, b, start, angle > 0 ? angle : angle + kCircle);
    }
}

}  // namespace swivel
