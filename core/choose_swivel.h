// SPDX-License-Identifier: MIT
//
// The two searches for a swivel. Where the limits forbid the wish, the limb takes the nearest end of an allowed arc. If
// no swivel is allowed, it takes the one that violates the limits least. simd/limbs/choose_stages.h asks in this order.
// The wish is phi = 0, so near means a large cosine. Each lane chooses from a fixed list of candidates. A candidate
// costs one root and no angle. The nearest legal swivel as such is Tolani, Goswami and Badler's (2000); they find it by
// angles. Lines that do not vary over the circle allow all of it or nothing.
//
// Both searches take any limits that have room(), allows(), for_each_end() and for_each_peak(): here Limits, and with a
// region LimitsInRegion (region.h).
#pragma once

#include "core/limits.h"

namespace swivel::inline SWIVEL_ISA {

template <class T>
struct FoundSwivel {
    Turned<T> swivel;
    Mask<T> allowed;  // false: no swivel was found that is
};

// Calls take() for each of two. With boxes this stays a loop, because what it does is long.
template <int Boxes, class Each, class Take>
SWIVEL_INLINE constexpr void for_both(const Each& first, const Each& second, const Take& take)
{
    if constexpr (Boxes == 0) {
        take(first);
        take(second);
    } else {
        SWIVEL_KEEP_LOOP
        for (const Each* each : {&first, &second}) take(*each);
    }
}

// Calls take(end, exist) for all places where an allowed arc can end.
template <class T, int Boxes, class Take>
SWIVEL_INLINE constexpr void for_each_end(const Limits<T, Boxes>& limits, const Take& take)
{
    Edge<T> edge[kMaxEdges<Boxes>];
    const int count = edges(limits, false, edge);
    for (int n = 0; n < count; ++n) {
        const Crossings<T> ends = crossings(edge[n].line());
        const Mask<T> exist = ends.exist & edge[n].live();
        for_both<Boxes>(ends.first, ends.second, [&](const Turned<T>& end) SWIVEL_INLINE_LAMBDA { take(end, exist); });
    }
}
// Whether the limits allow a swivel. Only the lanes of a mask count; those of a region may skip the rest.
template <class T, int Boxes>
SWIVEL_INLINE constexpr Mask<T> allows(const Limits<T, Boxes>& limits, const Turned<T>& swivel, const Mask<T>&)
{
    return inlined_room(limits, swivel) >= T(kNoRoom);
}
// The nearest end of an allowed arc, where there is one.
template <class T, template <class, int> class Bounds, int Boxes>
SWIVEL_INLINE constexpr FoundSwivel<T> nearest_end(const Bounds<T, Boxes>& limits)
{
    constexpr double kNone = -2;  // farther than any end, whose cosine is -1 or more but for rounding
    Turned<T> best{T(-1), T(0)};
    T nearest = T(kNone);
    for_each_end(limits, [&](const Turned<T>& end, const Mask<T>& exist) SWIVEL_INLINE_LAMBDA {
        const Mask<T> nearer = exist & (end.cos > nearest);
        const Mask<T> better = nearer & allows(limits, end, nearer);
        best = select(better, end, best);
        nearest = select(better, end.cos, nearest);
    });
    return {best, nearest > T(kNone)};
}

// Whether x and sign times y are lines of one alternative.
template <class T>
SWIVEL_INLINE constexpr bool meet(const Edge<T>& x, const Edge<T>& y, int sign)
{
    const bool front = x.front * y.front == sign, back = x.back * y.back == sign;
    const bool crosswise = x.front * y.back == sign || x.back * y.front == sign;
    return front || back || (x.box != y.box && crosswise);
}

// Rooms and cosines that differ by less than this count as equal, so rounding seldom decides.
inline constexpr double kTie = 1e-6;

// The candidate with the most room; among equal ones the one nearest to the wish, then the first. Each candidate is
// compared with the best one so far. Equality within kTie is not transitive, so the candidates' order matters.
template <class T>
struct MaxRoom {
    Turned<T> best;
    T best_room, max_room;

    SWIVEL_INLINE constexpr void consider(const Turned<T>& swivel, const Mask<T>& exists, const T& left)
    {
        max_room = select(exists, hi(left, max_room), max_room);
        // An allowed one never ties with a forbidden one.
        const T enough = select(max_room < T(kNoRoom), max_room - T(kTie), T(kNoRoom));
        const Mask<T> preferred = (best_room < enough) | (swivel.cos > best.cos + T(kTie));
        const Mask<T> better = exists & (left >= enough) & preferred;
        best = select(better, swivel, best);
        best_room = select(better, left, best_room);
    }
};

// Calls take(swivel, exists) for all places where the room can peak. The room is the largest over alternatives of the
// smallest over their lines. So it peaks where a line peaks, or where two lines of an alternative are equal.
//
// A box has 16 peaks and 41 pairs of lines. Nearly all are needed: in 1.8 million random cases that one box forbids,
// each of 37 pairs won at least 7,834 times. The other four are the two ends of one range. They matter only where that
// range has no width.
template <class T, int Boxes, class Take>
SWIVEL_INLINE constexpr void for_each_peak(const Limits<T, Boxes>& limits, const Take& take)
{
    Edge<T> edge[kMaxEdges<Boxes>];
    const int count = edges(limits, true, edge);
    struct Candidate {
        Turned<T> swivel;
        Mask<T> exists;
    };
    const auto consider = [&](const Candidate& candidate)
                              SWIVEL_INLINE_LAMBDA { take(candidate.swivel, candidate.exists); };
    const Mask<T> never = no_lanes<T>();
    for (int n = 0; n < count; ++n) {
        const OnCircle<T> line = edge[n].line();
        const T r2 = line.a * line.a + line.b * line.b;
        const Mask<T> peaks = edge[n].live() & (r2 > T(kFlat2));
        const T per_r = T(1) / sqrt(select(peaks, r2, T(1)));
        const Turned<T> peak{per_r * line.a, per_r * line.b};
        for_both<Boxes>(Candidate{peak, edge[n].front > 0 || edge[n].back > 0 ? peaks : never},
                        Candidate{{-peak.cos, -peak.sin}, edge[n].front < 0 || edge[n].back < 0 ? peaks : never},
                        consider);
        for (int m = 0; m < n; ++m)
            for_both<Boxes>(1, -1, [&](int sign) SWIVEL_INLINE_LAMBDA {
                if (!meet(edge[n], edge[m], sign)) return;
                const OnCircle<T> other = edge[m].line(), off = sign > 0 ? line - other : line + other;
                const Crossings<T> equal = crossings(off);
                const Mask<T> exist = equal.exist & edge[n].live() & edge[m].live();
                for_both<Boxes>(Candidate{equal.first, exist}, Candidate{equal.second, exist}, consider);
            });
    }
}
// The swivel with the smallest violation. It is allowed where the allowed arc is too short to have two ends.
template <class T, template <class, int> class Bounds, int Boxes>
SWIVEL_INLINE constexpr FoundSwivel<T> min_violation(const Bounds<T, Boxes>& limits)
{
    const Turned<T> wish{T(1), T(0)};
    const T first_room = room(limits, wish);
    MaxRoom<T> found{wish, first_room, first_room};
    for_each_peak(limits, [&](const Turned<T>& swivel, const Mask<T>& exists) SWIVEL_OUT_OF_LINE_LAMBDA {
        if (any(exists)) found.consider(swivel, exists, room(limits, swivel));
    });
    return {found.best, found.max_room >= T(kNoRoom)};
}

}  // namespace swivel::inline SWIVEL_ISA
