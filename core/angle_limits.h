// SPDX-License-Identifier: MIT
//
// Limits of one rotation on the swivel's circle: a range of twist, a box of Euler angles. For a given target, each
// limit requires a cos phi + b sin phi + c >= 0: a line in (cos phi, sin phi), in units of a cosine. A box of Euler
// angles is a list of alternatives, each of several lines. A limit's room at a swivel is the max over its alternatives
// of the min over their lines. A swivel with room >= 0 is allowed. Nothing here forms an angle.
//
// Sources: swivel-angle intervals, D. Tolani, A. Goswami, N. Badler, Real-time inverse kinematics techniques for
// anthropomorphic limbs (2000); swing and twist, the rotor's own components.
#pragma once

#include "core/swivel_circle.h"

namespace swivel::inline SWIVEL_ISA {

// A range of angles: its middle and half its width, which is 0 to pi.
template <class T>
struct Range {
    Turned<T> middle, half;
};

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
// The room with the middle angle's cosine positive (front) or negative (back).
template <class T>
struct Rooms {
    T front, back;
};
// The room between the ends for a direction (x, y) of any length, and for the opposite direction.
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
    const T outside_low = select(leave_inside | wide, T(-2), T(4));  // gives a room of -3 or less, below all others
    const Mask<T> beyond = wide & entry_inside & leave_inside;
    return {select(entry_inside, entry.sin, outside_low), select(leave_inside, leave.sin, T(2)), beyond};
}

// The ranges of three Euler angles. A rotation turns by a first angle about one axis, by a middle one about the next,
// and by a last one about the third. Each axis goes along with the rotations before it. The middle angle's cosine may
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

// The first, middle and last axis, 0 to 2, and whether they are in cyclic order.
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

}  // namespace swivel::inline SWIVEL_ISA
