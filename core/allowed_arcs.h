// SPDX-License-Identifier: MIT
//
// The swivels that a limb's limits allow, as arcs. IKAN calls them psi intervals; here they need no angle. This is for
// one limb, with time to spare: the solver itself needs only the nearest end.
#pragma once

#include <algorithm>

#include "core/region.h"

namespace swivel::inline SWIVEL_ISA {

template <class T>
struct Arc {
    Turned<T> from, to;  // by the right hand about the line; equal for the whole circle
};
// Each edge of a limit crosses zero twice, and there are two lines where the room is just enough.
inline constexpr int kMaxArcEnds = 4 * (kMaxEdges<kMaxBoxes> + SWIVEL_MAX_HALF_SPACES);
inline constexpr int kMaxAllowedArcs = kMaxArcEnds / 2 + 1;  // those that touch are joined, but the last and first
template <class T>
struct AllowedArcs {
    Arc<T> arc[kMaxAllowedArcs];
    int count = 0;
};

// The sine of the turn from a to b. In double, products of floats are exact, so the sign is right for close turns, too.
template <class T>
constexpr double sine_between(const Turned<T>& a, const Turned<T>& b)
{
    return double{a.cos} * double{b.sin} - double{a.sin} * double{b.cos};
}
// Whether a comes before b from 0 to 2 pi. The comparison is exact: first by the half of the circle, then by the sine
// between them.
template <class T>
constexpr bool is_before(const Turned<T>& a, const Turned<T>& b)
{
    const auto second_half = [](const Turned<T>& turn) { return turn.sin < 0 || (turn.sin == 0 && turn.cos < 0); };
    if (second_half(a) != second_half(b)) return second_half(b);
    return sine_between(a, b) > 0;
}
// Halfway from a to b.
template <class T>
Turned<T> between(const Turned<T>& a, const Turned<T>& b)
{
    // Takes b relative to a, halves that turn, and goes back. Half of almost a whole turn is almost half a turn.
    const T cos = a.cos * b.cos + a.sin * b.sin, sin = static_cast<T>(sine_between(a, b));
    const T c = sqrt(hi(T(0), T(0.5) * (T(1) + cos))),
            s = cos > T(0) ? T(0.5) * abs(sin) / c : sqrt(hi(T(0), T(0.5) * (T(1) - cos)));
    const T half_cos = sin >= T(0) ? c : -c;
    return {a.cos * half_cos - a.sin * s, a.sin * half_cos + a.cos * s};
}

// Calls take(line) for each line whose zeros may end an allowed arc.
template <class T, class Take>
void for_each_edge(const Limits<T>& limits, const Take& take)
{
    Edge<T> edge[kMaxEdges<kMaxBoxes>];
    const int count = edges(limits, false, edge);
    for (int n = 0; n < count; ++n)
        if (edge[n].live()) take(edge[n].line());
}
template <class T, class Take>
void for_each_edge(const LimitsInRegion<T, kMaxBoxes>& both, const Take& take)
{
    for_each_edge(both.limits, take);
    const swivel_region& region = *both.region.region;
    for (std::uint32_t n = 0; n < region.first[region.part_count]; ++n)
        if (region.half_space[n].is_edge != 0) take(both.region.line(n));
}

// The arcs that a group's limits allow, with or without a region.
template <class T, template <class, int> class Bounds>
AllowedArcs<T> allowed_arcs(const Bounds<T, kMaxBoxes>& limits)
{
    Turned<T> end[kMaxArcEnds];
    int count = 0;
    for_each_edge(limits, [&](const OnCircle<T>& line) {
        for (const T slack : {T(kNoRoom), T(-kNoRoom)})  // where the room is just enough, on either side of an edge
            if (const Crossings<T> ends = crossings(line - constant(slack)); ends.exist)
                end[count++] = ends.first, end[count++] = ends.second;
    });
    std::sort(end, end + count, is_before<T>);

    AllowedArcs<T> arcs;
    const auto allowed = [&](const Turned<T>& swivel) { return room(limits, swivel) >= T(kNoRoom); };
    if (count == 0) {
        if (allowed({T(1), T(0)})) arcs.arc[arcs.count++] = {{T(-1), T(0)}, {T(-1), T(0)}};
        return arcs;
    }
    // From end to end: if the middle is allowed, the whole way is. Neighbours join.
    for (int n = 0; n < count; ++n) {
        const Turned<T>&from = end[n], &to = end[(n + 1) % count];
        const bool whole =
            count == 1 || (n + 1 == count && !is_before(end[0], from));  // one end, or all of them the same
        if (!whole && n + 1 < count && !is_before(from, to)) continue;
        if (!allowed(whole ? Turned<T>{-from.cos, -from.sin} : between(from, to))) continue;
        if (arcs.count > 0 && n > 0 && arcs.arc[arcs.count - 1].to.cos == from.cos &&
            arcs.arc[arcs.count - 1].to.sin == from.sin)
            arcs.arc[arcs.count - 1].to = to;
        else
            arcs.arc[arcs.count++] = {from, to};
    }
    // The last one may join the first.
    Arc<T>&first = arcs.arc[0], &last = arcs.arc[arcs.count > 0 ? arcs.count - 1 : 0];
    if (arcs.count > 1 && last.to.cos == first.from.cos && last.to.sin == first.from.sin) {
        first.from = last.from;
        --arcs.count;
    }
    return arcs;
}

}  // namespace swivel::inline SWIVEL_ISA
