// SPDX-License-Identifier: MIT
//
// Limits as lines in space. Trigonometry is allowed here, because no solve sees it.
#include "batch/explain/draw.h"

#include <cmath>
#include <numbers>
#include <optional>

#include "batch/explain/explain_probe.h"
#include "batch/query/allowed_arcs.h"
#include "batch/query/limb_value.h"
#include "core/joint_frame.h"
#include "core/region.h"

namespace swivel {

namespace {

constexpr double kCircle = 2 * std::numbers::pi;

// A cone's rim, and eight lines to it.
void draw_cone(const Vector<double>& apex, const Vector<double>& axis, double cosine, double radius, Drawing& drawing)
{
    const double sine = std::sqrt(std::fmax(1 - cosine * cosine, 0));
    const Vector<double> unit = normalise(axis), centre = apex + radius * cosine * unit,
                         a = radius * sine * any_across(unit), b = cross(unit, a);
    drawing.arc(SWIVEL_SHAPE_CONE, centre, a, b, 0, kCircle);
    for (int n = 0; n < 8; ++n) {
        const double t = n * kCircle / 8;
        drawing.line(SWIVEL_SHAPE_CONE, apex, centre + std::cos(t) * a + std::sin(t) * b);
    }
}

// The pieces of half-spaces' borders that are the region's: where it leaves no room.
void draw_region(const swivel_region& region, const ArmFrame& arm, double radius, Drawing& drawing)
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
                drawing.line(SWIVEL_SHAPE_REGION, place(piece), place(piece + 1));
    }
}

// The elbow of a limb without limits, and the unit axis that it swivels about.
struct Wish {
    Vector<double> shoulder, elbow, axis;
};

// None if an input is bad. Not inlined, so that the probe is gone from the stack before arcs are asked for.
[[gnu::noinline]] std::optional<Wish> wish_of(const Group& group, std::uint32_t limb)
{
    Probe probe(group, limb);
    probe.give_up_limits();
    if (probe.solve() & SWIVEL_BAD_INPUT) return std::nullopt;
    const LimbPose pose = probe.pose();
    return Wish{pose.shoulder, pose.elbow, probe.swivel_axis()};
}

}  // namespace

void draw_limits(const Group& group, std::size_t limb, const LimbPose& pose, Drawing& drawing)
{
    const ArmFrame arm = arm_frame(group, limb);
    const double upper = std::sqrt(len2(pose.elbow - pose.shoulder));
    if (group.features & SWIVEL_WITH_SHOULDER_CONE) {
        const LimbValue cone(group, limb, SWIVEL_SHOULDER_CONE);
        draw_cone(pose.shoulder, sandwich(arm.rotation, vector_of(cone)), cone[3], upper, drawing);
    }
    // The hand's axis is at most so far from the forearm.
    if (group.features & SWIVEL_WITH_HAND_CONE)
        draw_cone(pose.wrist, pose.wrist - pose.elbow, LimbValue(group, limb, SWIVEL_HAND_CONE)[3], 2 * drawing.size,
                  drawing);
    if (group.features & SWIVEL_WITH_REGION) draw_region(*group.region, arm, upper, drawing);
}

void draw_allowed(const Group& group, std::uint32_t limb, Drawing& drawing)
{
    if (!(group.features & kSwivelLimits)) return;
    const std::optional<Wish> wish = wish_of(group, limb);
    if (!wish) return;
    drawing.point(SWIVEL_SHAPE_WISH, wish->elbow);
    // The elbow's circle, from where it is wished on.
    const Vector<double> bone = wish->elbow - wish->shoulder,
                         centre = wish->shoulder + scalar_product(wish->axis, bone) * wish->axis,
                         a = wish->elbow - centre, b = cross(wish->axis, a);
    ArcEnds arcs[kMaxArcs];
    const std::uint32_t count = allowed_arcs(group, limb, arcs);
    for (std::uint32_t n = 0; n < count; ++n) {
        const double start = std::atan2(arcs[n].from[1], arcs[n].from[0]);
        const double angle = std::atan2(arcs[n].to[1], arcs[n].to[0]) - start;
        drawing.arc(SWIVEL_SHAPE_ALLOWED, centre, a, b, start, angle > 0 ? angle : angle + kCircle);
    }
}

}  // namespace swivel
