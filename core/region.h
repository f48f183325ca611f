// SPDX-License-Identifier: MIT
//
// A reach region: where the upper arm may point. It is a union of parts, each an intersection of half-spaces a . d >=
// c, less forbidden cones. A half-space leaves a direction d the margin a . d - c. The room of d is the largest over
// the parts of the smallest margin in a part, or the margin of a forbidden cone if that is smaller. While the arm
// swivels, each component of the direction goes as a cos phi + b sin phi + c. So each half-space is a line on the
// circle, as every other limit is (joint_limits.h). Rows keep these nine numbers, and lines are made where they are
// needed.
//
// Sources: cones in order with bridges between them, the kusudamas of E. Gjoni, which Godot has; the search on the
// circle is our own.
#pragma once

#include "core/choose_swivel.h"
#include "core/joint_limits.h"
#include "include/swivel/swivel_regions.h"

namespace swivel::inline SWIVEL_ISA {

// How much room each half-space leaves: room_of(n) is that of the nth.
template <class T, class RoomOf>
SWIVEL_INLINE constexpr T room_of_parts(const swivel_region& region, const RoomOf& room_of)
{
    constexpr double kLessThanAnyRoom = -4;
    T max = T(kLessThanAnyRoom);
    for (std::uint32_t part = 0; part < region.part_count; ++part) {
        T min = T(kMaxRoom);
        for (std::uint32_t n = region.first[part]; n < region.first[part + 1]; ++n) min = lo(room_of(n), min);
        max = hi(min, max);
    }
    for (std::uint32_t n = 0; n < region.cut_count; ++n) max = lo(room_of(n), max);
    return max;
}
// The room of a unit direction.
template <class T>
SWIVEL_INLINE constexpr T room(const swivel_region& region, const Vector<T>& direction)
{
    const T x = direction.template at<kE1>(), y = direction.template at<kE2>(), z = direction.template at<kE3>();
    return room_of_parts<T>(region, [&](std::uint32_t n) SWIVEL_INLINE_LAMBDA {
        const swivel_half_space& half = region.half_space[n];
        return T(half.axis[0]) * x + T(half.axis[1]) * y + T(half.axis[2]) * z - T(half.cosine);
    });
}

// A direction that turns with the swivel, by its components; and the region that it must stay in.
template <class T>
struct RegionOnCircle {
    const swivel_region* region;
    OnCircle<T> x, y, z;

    SWIVEL_INLINE constexpr OnCircle<T> line(std::uint32_t n) const
    {
        const swivel_half_space& half = region->half_space[n];
        return T(half.axis[0]) * x + T(half.axis[1]) * y + T(half.axis[2]) * z - constant(T(half.cosine));
    }
};
// Where the upper arm points.
template <class T, class Lift>
SWIVEL_INLINE constexpr RegionOnCircle<T> region_limit(const SwivellingArm<T, Lift>& arm, const swivel_region* region)
{
    const auto bone = sandwich(arm.to_arm, unit<T, kE3>());
    const auto along = [&](const auto& axis)
                           SWIVEL_INLINE_LAMBDA { return per_size(arm) * inner(in_line(arm, axis), bone); };
    return {region, along(unit<T, kE1>()), along(unit<T, kE2>()), along(unit<T, kE3>())};
}
template <class T>
SWIVEL_INLINE constexpr T room(const RegionOnCircle<T>& on, const Turned<T>& swivel)
{
    return room(*on.region, vector(on.x.at(swivel), on.y.at(swivel), on.z.at(swivel)));
}

// Calls take(swivel, exist) for the two places where a line crosses zero.
template <class T, class Take>
SWIVEL_INLINE constexpr void for_crossings(const OnCircle<T>& x, const Take& take)
{
    const Crossings<T> both = crossings(x);
    take(both.first, both.exist);
    take(both.second, both.exist);
}
// The same for all places where an arc within the region can end.
template <class T, class Take>
SWIVEL_INLINE constexpr void for_each_end(const RegionOnCircle<T>& on, const Take& take)
{
    const std::uint32_t count = on.region->first[on.region->part_count];
    for (std::uint32_t n = 0; n < count; ++n)
        if (on.region->half_space[n].is_edge != 0) for_crossings(on.line(n), take);
}
// The same for all places where the region's room can peak: where a half-space's line peaks, or where two lines are
// equal, of one part, of two cuts, or of a part and a cut.
template <class T, class Take>
SWIVEL_INLINE constexpr void for_each_peak(const RegionOnCircle<T>& on, const Take& take)
{
    const swivel_region& region = *on.region;
    const auto take_peaks = [&](std::uint32_t n, std::uint32_t part_first) SWIVEL_OUT_OF_LINE_LAMBDA {
        const OnCircle<T> line = on.line(n);
        const T r2 = line.a * line.a + line.b * line.b;
        const Mask<T> peaks = r2 > T(kFlat2);
        const T per_r = T(1) / sqrt(select(peaks, r2, T(1)));
        take(Turned<T>{per_r * line.a, per_r * line.b}, peaks);
        for (std::uint32_t cut = 0; cut < n && cut < region.cut_count; ++cut) for_crossings(line - on.line(cut), take);
        for (std::uint32_t m = part_first; m < n; ++m) for_crossings(line - on.line(m), take);
    };
    for (std::uint32_t n = 0; n < region.cut_count; ++n) take_peaks(n, n);
    for (std::uint32_t part = 0; part < region.part_count; ++part)
        for (std::uint32_t n = region.first[part]; n < region.first[part + 1]; ++n) take_peaks(n, region.first[part]);
}

// An arm's other limits, and the region of its upper arm.
template <class T, int Boxes>
struct LimitsInRegion {
    Limits<T, Boxes> limits;
    RegionOnCircle<T> region;
};
// It is long, and a function of its own.
template <class T, int Boxes>
SWIVEL_FLATTEN [[gnu::noinline]] constexpr T room(const LimitsInRegion<T, Boxes>& both, const Turned<T>& swivel)
{
    return lo(room(both.limits, swivel), room(both.region, swivel));
}

// Skips the room where no lane counts.
template <class T, int Boxes>
SWIVEL_INLINE constexpr Mask<T> allows(const LimitsInRegion<T, Boxes>& both, const Turned<T>& swivel,
                                       const Mask<T>& lanes)
{
    if (!any(lanes)) return lanes;
    return room(both, swivel) >= T(kNoRoom);
}
template <class T, int Boxes, class Take>
SWIVEL_INLINE constexpr void for_each_end(const LimitsInRegion<T, Boxes>& both, const Take& take)
{
    for_each_end(both.limits, take);
    for_each_end(both.region, take);
}
// The room can also peak where a line of the region equals one of another limit.
template <class T, int Boxes, class Take>
SWIVEL_INLINE constexpr void for_each_peak(const LimitsInRegion<T, Boxes>& both, const Take& take)
{
    for_each_peak(both.limits, take);
    for_each_peak(both.region, take);
    Edge<T> edge[kMaxEdges<Boxes>];
    const int edge_count = edges(both.limits, true, edge);
    const std::uint32_t count = both.region.region->first[both.region.region->part_count];
    for (std::uint32_t n = 0; n < count; ++n) {
        const OnCircle<T> line = both.region.line(n);
        for (int m = 0; m < edge_count; ++m) {
            const auto take_live = [&](const Turned<T>& swivel, const Mask<T>& exists) {
                take(swivel, exists & edge[m].live());
            };
            const OnCircle<T> other = edge[m].line();
            if (edge[m].front > 0 || edge[m].back > 0) for_crossings(line - other, take_live);
            if (edge[m].front < 0 || edge[m].back < 0) for_crossings(line + other, take_live);
        }
    }
}

}  // namespace swivel::inline SWIVEL_ISA
