// SPDX-License-Identifier: MIT
//
// Joint limits on the swivel's circle. For a given target, every limit says that some a cos phi + b sin phi + c is not
// negative. This is a line in (cos phi, sin phi), in units of a cosine. A box of Euler angles is a list of
// alternatives, each of several lines. The room that a limit leaves at a swivel is the least over its lines, and the
// most over its alternatives. The swivel is allowed if the room is not negative. Nothing here forms an angle.
//
// Sources: swivel-angle intervals, D. Tolani, A. Goswami, N. Badler, Real-time inverse kinematics techniques for
// anthropomorphic limbs (2000); swing and twist, the rotor's own components.
#pragma once

#include "core/swivel_circle.h"

namespace swivel::inline SWIVEL_ISA {

// Less room than this is a violation. At the end of an allowed arc, rounding leaves about half of it in
// random limbs; docs/howto/limits.md has the worst.
inline constexpr double kNoRoom = -5e-7;

// A range of angles: its middle and half its width, which is 0 to pi.
template <class T>
struct Range {
    Turned<T> middle, half;
};

// An axis carried by the arm stays within a cone about a fixed axis; or a fixed axis stays within a carried cone. The
// cosine of the angle between the two axes must be at least the opening's.
template <class T>
SWIVEL_INLINE constexpr OnCircle<T> cone_limit(const OnCircle<T>& cosine, const T& cos_opening)
{
    return cosine - constant(cos_opening);
}

// The twist of a rotor about an axis stays within a range. w and s are the rotor's scalar part and its part along the
// axis. With tau the twist and beta the swing, w^2 - s^2 = cos^2(beta/2) cos tau, and 2 w s = cos^2(beta/2) sin tau. So
// the room is cos^2(beta/2) (cos(tau - middle) - cos half).
template <class T>
SWIVEL_INLINE constexpr OnCircle<T> twist_limit(const OnHalfCircle<T>& w, const OnHalfCircle<T>& s,
                                                const Range<T>& range)
{
    const OnCircle<T> ww = w * w, ss = s * s, ws = w * s;
    return range.middle.cos * (ww - ss) + (range.middle.sin + range.middle.sin) * ws - range.half.cos * (ww + ss);
}

// Turns (x, y) back by `turn`. past() is then its sine and along() its cosine, both times the length of (x, y).
template <class N, class T>
SWIVEL_INLINE constexpr N past(const Turned<T>& turn, const N& x, const N& y)
{
    return turn.cos * y - turn.sin * x;
}
template <class N, class T>
SWIVEL_INLINE constexpr N along(const Turned<T>& turn, const N& x, const N& y)
{
    return turn.cos * x + turn.sin * y;
}

// The ends of a range. A direction is in a range wider than pi if it is on the inner side of one of them.
template <class T>
struct Ends {
    Turned<T> low, high, middle;
    Mask<T> wide;
};
template <class T>
SWIVEL_INLINE constexpr Ends<T> ends(const Range<T>& range)
{
    const Turned<T> m = range.middle, h = range.half;
    return {{along(h, m.cos, m.sin), past(h, m.cos, m.sin)},
            {along(m, h.cos, -h.sin), m.sin * h.cos + m.cos * h.sin},
            m,
            h.cos < T(0)};
}
// How much room there is if the middle angle's cosine is taken as positive (front) or as negative (back).
template <class T>
struct Rooms {
    T front, back;
};
// How much room a direction (x, y) of any length has between the ends, and how much the opposite direction has.
template <class T>
SWIVEL_INLINE constexpr Rooms<T> room_between(const Ends<T>& ends, const T& x, const T& y)
{
    const T past_low = past(ends.low, x, y), before_high = -past(ends.high, x, y), ahead = along(ends.middle, x, y);
    const T less = lo(past_low, before_high), more = hi(past_low, before_high);
    return {select(ends.wide, more, lo(less, ahead)), -select(ends.wide, less, hi(more, ahead))};
}

// The sines of the angles in a range whose cosine has one given sign. They lie between low and high. With `beyond`,
// they lie outside of high and low instead.
template <class T>
struct Sines {
    T low, high;
    Mask<T> beyond;
};
template <class T>
SWIVEL_INLINE constexpr T room_between(const Sines<T>& sines, const T& sine)
{
    const T past_low = sine - sines.low, before_high = sines.high - sine;
    return select(sines.beyond, hi(past_low, before_high), lo(past_low, before_high));
}
// entry, leave: the ends of the range, in the order in which the sine grows. entry_inside, leave_inside: whether their
// cosine has the given sign. If neither has it, a wide range allows every sine and a narrow one none.
template <class T>
SWIVEL_INLINE constexpr Sines<T> sines(const Turned<T>& entry, const Mask<T>& entry_inside, const Turned<T>& leave,
                                       const Mask<T>& leave_inside, const Mask<T>& wide)
{
    const T outside_low = select(leave_inside | wide, T(-2), T(4));  // -3 and less: no other room is below -2
    const Mask<T> beyond = wide & entry_inside & leave_inside;
    return {select(entry_inside, entry.sin, outside_low), select(leave_inside, leave.sin, T(2)), beyond};
}

// The ranges of three Euler angles. A rotation turns by a first angle about one axis, by a middle one about the next,
// and by a last one about the third. Each axis is as the rotations before have left it. The middle angle's cosine may
// have either sign. With the other sign, the first and the last angle are half a turn off.
template <class T>
struct EulerCurves {
    OnCircle<T> sine;                                      // of the middle angle
    OnCircle<T> first_cos, first_sin, last_cos, last_sin;  // times the middle angle's cosine
};
template <class T>
struct EulerRanges {
    Ends<T> first, last;
    Sines<T> front, back;  // of the middle angle, for either sign of its cosine
};
template <class T>
struct EulerBox {
    EulerCurves<T> curves;
    EulerRanges<T> ranges;
};

template <class T>
SWIVEL_INLINE constexpr T room(const EulerBox<T>& box, const Turned<T>& swivel)
{
    const auto& [curves, ranges] = box;
    const T sine = curves.sine.at(swivel);
    const T first_cos = curves.first_cos.at(swivel), first_sin = curves.first_sin.at(swivel);
    const T last_cos = curves.last_cos.at(swivel), last_sin = curves.last_sin.at(swivel);
    const Rooms<T> first = room_between(ranges.first, first_cos, first_sin),
                   last = room_between(ranges.last, last_cos, last_sin);
    return hi(lo(room_between(ranges.front, sine), lo(first.front, last.front)),
              lo(room_between(ranges.back, sine), lo(first.back, last.back)));
}

template <class T>
SWIVEL_INLINE constexpr EulerRanges<T> euler_ranges(const Range<T>& first, const Range<T>& middle, const Range<T>& last)
{
    const Ends<T> m = ends(middle);
    const Mask<T> low_front = m.low.cos >= T(0), high_front = m.high.cos >= T(0);
    return {ends(first), ends(last), sines(m.low, low_front, m.high, high_front, m.wide),
            sines(m.high, !high_front, m.low, !low_front, m.wide)};
}

// Orders of axes: which the first, middle and last are, 0 to 2, and whether they are in cyclic order.
struct EulerOrder {
    int first, middle, last;
    bool cyclic;
};
inline constexpr EulerOrder kEulerOrders[] = {{0, 1, 2, true},  {0, 2, 1, false}, {1, 2, 0, true},
                                              {1, 0, 2, false}, {2, 0, 1, true},  {2, 1, 0, false}};

// entry(row, column): that entry of the rotation's matrix, R = R_first R_middle R_last. With the axes p, q, r in cyclic
// order, R_pr = sin middle. (R_rr, -R_qr) is cos middle (cos, sin) of the first angle, and (R_pp, -R_pq) that of the
// last. In the other order the sines change sign.
template <class T, class Entry>
SWIVEL_INLINE constexpr EulerCurves<T> euler_curves(const EulerOrder& order, const Entry& entry)
{
    const T sign = T(order.cyclic ? 1 : -1);
    return {sign * entry(order.first, order.last), entry(order.last, order.last),
            -sign * entry(order.middle, order.last), entry(order.first, order.first),
            -sign * entry(order.first, order.middle)};
}

// All limits of an arm whose swivel is free: at most kMaxLines single lines, and one box for each joint.
inline constexpr int kMaxLines = 5, kMaxBoxes = 2;
template <int Boxes>
inline constexpr int kMaxEdges = kMaxLines + 10 * Boxes;
template <class T, int Boxes = kMaxBoxes>
struct Limits {
    OnCircle<T> line[kMaxLines];
    int line_count = 0;
    EulerBox<T> box[Boxes];
    int box_count = 0;
};
// Without boxes, which are nearly all of its size.
template <class T>
struct Limits<T, 0> {
    OnCircle<T> line[kMaxLines];
    int line_count = 0;
    static constexpr EulerBox<T>* box = nullptr;
    static constexpr int box_count = 0;
};

template <class T, int Boxes>
SWIVEL_INLINE constexpr T inlined_room(const Limits<T, Boxes>& limits, const Turned<T>& swivel)
{
    T min = T(2);
    for (int n = 0; n < limits.line_count; ++n) min = lo(limits.line[n].at(swivel), min);
    SWIVEL_KEEP_LOOP
    for (int n = 0; n < limits.box_count; ++n) min = lo(room(limits.box[n], swivel), min);
    return min;
}
// With boxes it is long, and a function of its own.
template <class T>
SWIVEL_INLINE constexpr T room(const Limits<T, 0>& limits, const Turned<T>& swivel)
{
    return inlined_room(limits, swivel);
}
template <class T>
SWIVEL_FLATTEN [[gnu::noinline]] constexpr T room(const Limits<T, kMaxBoxes>& limits, const Turned<T>& swivel)
{
    return inlined_room(limits, swivel);
}

// An edge of the limits: where the allowed arcs can begin and end, as there a line crosses zero. It says which line
// that is, instead of having it, because all lines of two boxes take eight kilobytes with the widest registers. A box
// has two rooms, front and back, for either sign of the middle angle's cosine. Lines without a box are part of both.
template <class T>
struct Edge {
    enum Kind { whole, sine, past_turn, along_turn } kind;
    const OnCircle<T>*x, *y;  // the line itself; the sine; or cosine and sine of an angle
    const Turned<T>* turn;    // an end or the middle of that angle's range
    const T* bound;           // of the sine
    int box;                  // -1: none
    int front, back;          // the sign with which it is part of that room; 0: it is no part

    SWIVEL_INLINE constexpr OnCircle<T> line() const
    {
        if (kind == whole) return *x;
        if (kind == sine) return *x - constant(*bound);
        return kind == past_turn ? past(*turn, *x, *y) : along(*turn, *x, *y);
    }
    // The lanes in which it is an edge at all.
    SWIVEL_INLINE constexpr Mask<T> live() const { return kind == sine ? abs(*bound) <= T(1) : all_lanes<T>(); }
};

// The edges of all limits, which must outlive them. middles: also gives those that matter only where nothing is
// allowed. Edges that are live in no lane are left out.
template <class T, int Boxes>
SWIVEL_INLINE constexpr int edges(const Limits<T, Boxes>& limits, bool middles, Edge<T> (&edge)[kMaxEdges<Boxes>])
{
    using E = Edge<T>;
    int count = 0;
    for (int n = 0; n < limits.line_count; ++n)
        edge[count++] = {E::whole, &limits.line[n], nullptr, nullptr, nullptr, -1, 1, 1};
    SWIVEL_KEEP_LOOP
    for (int n = 0; n < limits.box_count; ++n) {
        const EulerBox<T>& box = limits.box[n];
        const auto add_sine = [&](const T& bound, int front, int back) SWIVEL_INLINE_LAMBDA {
            const E sine = {E::sine, &box.curves.sine, nullptr, nullptr, &bound, n, front, back};
            if (any(sine.live())) edge[count++] = sine;
        };
        add_sine(box.ranges.front.low, 1, 0);
        add_sine(box.ranges.front.high, -1, 0);
        add_sine(box.ranges.back.low, 0, 1);
        add_sine(box.ranges.back.high, 0, -1);
        const auto add_angle = [&](const Ends<T>& ends, const OnCircle<T>& cos, const OnCircle<T>& sin)
                                   SWIVEL_INLINE_LAMBDA {
                                       edge[count++] = {E::past_turn, &cos, &sin, &ends.low, nullptr, n, 1, -1};
                                       edge[count++] = {E::past_turn, &cos, &sin, &ends.high, nullptr, n, -1, 1};
                                       if (!middles) return;
                                       edge[count++] = {E::along_turn, &cos, &sin, &ends.middle, nullptr, n, 1, -1};
                                   };
        add_angle(box.ranges.first, box.curves.first_cos, box.curves.first_sin);
        add_angle(box.ranges.last, box.curves.last_cos, box.curves.last_sin);
    }
    return count;
}

}  // namespace swivel::inline SWIVEL_ISA
