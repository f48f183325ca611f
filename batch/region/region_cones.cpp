// SPDX-License-Identifier: MIT
//
// Cones in order with bridges between neighbours.
#include <cmath>
#include <numbers>

#include "batch/refusal/status.h"
#include "batch/region/region.h"
#include "simd/float_env.h"

using namespace swivel;

namespace swivel {

namespace {

constexpr double kPi = std::numbers::pi;

double cos_between(const Vector<double>& a, const Vector<double>& b) { return scalar_product(a, b); }
double angle_between(const Vector<double>& a, const Vector<double>& b)
{
    return std::atan2(std::sqrt(len2(cross(a, b))), cos_between(a, b));
}

// Below this an angle is noise of floats: 1e-6. No circle of such a radius fits between two cones.
constexpr double kNoAngle = 1e-6;

bool needs_bridge(const RegionCone& one, const RegionCone& two)
{
    const double between = angle_between(one.axis, two.axis);
    return between > std::fabs(one.angle - two.angle) + kNoAngle && one.angle + two.angle < kPi - 2 * kNoAngle;
}
bool are_opposite(const RegionCone& one, const RegionCone& two)
{
    return needs_bridge(one, two) && angle_between(one.axis, two.axis) > kPi - kNoAngle;
}

// Two circles that touch both cones, one on each side. Half a turn less both cones' angles is their opening: with any
// other it may be that no circle touches both.
struct Bridge {
    Vector<double> circle[2];
    double angle;
    Vector<double> touch[2][2];  // [cone][side]
};
Bridge bridge_of(const RegionCone& one, const RegionCone& two)
{
    Bridge bridge;
    bridge.angle = 0.5 * (kPi - one.angle - two.angle);
    // circle . one = cos(one.angle + angle), circle . two = cos(two.angle + angle). The rest of its length is across.
    const Vector<double> pole = cross(one.axis, two.axis);
    const double d = cos_between(one.axis, two.axis), s2 = len2(pole);
    const double x = std::cos(one.angle + bridge.angle), y = std::cos(two.angle + bridge.angle);
    const Vector<double> in = ((x - d * y) / s2) * one.axis + ((y - d * x) / s2) * two.axis;
    const double rest = std::sqrt(std::fmax(0, 1 - len2(in)) / s2);
    for (int side = 0; side < 2; ++side) {
        const Vector<double> circle = normalise(in + (side == 0 ? rest : -rest) * pole);
        bridge.circle[side] = circle;
        for (int n = 0; n < 2; ++n) {
            const RegionCone& cone = n == 0 ? one : two;
            const Vector<double> out = normalise(circle - cos_between(circle, cone.axis) * cone.axis);
            bridge.touch[n][side] = std::cos(cone.angle) * cone.axis + std::sin(cone.angle) * out;
        }
    }
    return bridge;
}

// Outside of both circles and between the great circles through each cone's points of touch. Each great circle lies
// within its cone between these points, and beyond them within the circles. So there is no gap, and nothing but the
// bridge. This holds where the circles meet on the arc between the cones. They do so only if both cones are less than a
// half-space.
void add_lune(RegionBuilder& builder, const Bridge& bridge, const Vector<double>& pole)
{
    for (const Vector<double>& circle : bridge.circle) builder.add({-circle, -std::cos(bridge.angle), true});
    for (int n = 0; n < 2; ++n) {
        const Vector<double> other = bridge.touch[1 - n][0] + bridge.touch[1 - n][1];
        const Vector<double> through = cross(bridge.touch[n][0], bridge.touch[n][1]);
        const Vector<double> axis = len2(through) > 1e-24 ? normalise(through) : pole;
        builder.add({cos_between(axis, other) < 0 ? -axis : axis, 0, false});
    }
    builder.end_part();
}
// Else it is two parts: the triangle of both cones' axes and a circle's, less the circle.
void add_triangles(RegionBuilder& builder, const Bridge& bridge, const RegionCone& one, const RegionCone& two)
{
    for (int side = 0; side < 2; ++side) {
        const Vector<double>&circle = bridge.circle[side], &from = side == 0 ? one.axis : two.axis,
              &to = side == 0 ? two.axis : one.axis;
        builder.add({-circle, -std::cos(bridge.angle), true});
        builder.add({normalise(cross(from, to)), 0, false});
        builder.add({normalise(cross(to, circle)), 0, false});
        builder.add({normalise(cross(circle, from)), 0, false});
        builder.end_part();
    }
}
void add_bridge(RegionBuilder& builder, const RegionCone& one, const RegionCone& two)
{
    if (!needs_bridge(one, two)) return;
    const Bridge bridge = bridge_of(one, two);
    const Vector<double> pole = normalise(cross(one.axis, two.axis));
    const bool meet = cos_between(bridge.circle[0], pole) > std::cos(bridge.angle) + kNoAngle;
    if (meet)
        add_lune(builder, bridge, pole);
    else
        add_triangles(builder, bridge, one, two);
}

// The neighbours of cones in order: the nth and its next one.
std::uint32_t neighbour_count(std::uint32_t count, bool closed) { return closed && count > 2 ? count : count - 1; }

}  // namespace

std::uint32_t first_opposite(const RegionCone* cones, std::uint32_t count, bool closed)
{
    for (std::uint32_t n = 0; n < neighbour_count(count, closed); ++n)
        if (are_opposite(cones[n], cones[(n + 1) % count])) return n;
    return count;
}

void add_cones(RegionBuilder& builder, const RegionCone* cones, std::uint32_t count, bool closed)
{
    for (std::uint32_t n = 0; n < count; ++n) {
        builder.add({cones[n].axis, std::cos(cones[n].angle), true});
        builder.end_part();
    }
    for (std::uint32_t n = 0; n < neighbour_count(count, closed); ++n)
        add_bridge(builder, cones[n], cones[(n + 1) % count]);
}

}  // namespace swivel

swivel_status swivel_region_add_cones(swivel_region* region, const swivel_region_cone* cones, std::uint32_t count,
                                      std::uint32_t closed)
{
    const FloatEnv env;
    constexpr const char* kCall = "swivel_region_add_cones";
    if (const swivel_status status = check_region(kCall, region); status != SWIVEL_OK) return status;
    if (count < 1 || count > SWIVEL_MAX_REGION_PARTS)
        return refuse("%s: %u cones are not 1 to %d", kCall, count, SWIVEL_MAX_REGION_PARTS);
    if (!cones) return refuse("%s: cones is null", kCall);
    RegionCone read[SWIVEL_MAX_REGION_PARTS];
    for (std::uint32_t n = 0; n < count; ++n)
        if (const swivel_status status = read_cone(kCall, n, cones[n], read[n]); status != SWIVEL_OK) return status;
    if (const std::uint32_t n = first_opposite(read, count, closed != 0); n < count)
        return refuse("%s: cones %u and %u are opposite; give one on the way", kCall, n, (n + 1) % count);
    RegionBuilder builder(*region);
    add_cones(builder, read, count, closed != 0);
    return keep(kCall, builder, region);
}
