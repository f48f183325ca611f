// SPDX-License-Identifier: MIT
//
// All limits of an arm, on the circle of its swivel: the room that they leave, and the edges of the allowed arcs.
// joint_limits.h makes their lines.
#pragma once

#include "core/joint_limits.h"

namespace swivel::inline SWIVEL_ISA {

// Less room than this is a violation. At the end of an allowed arc, rounding leaves about half of it in
// random limbs; docs/howto/limits.md has the worst.
inline constexpr double kNoRoom = -5e-7;
// Room is the margin by which a swivel keeps a limit, as a difference of cosines, or for boxes of sines. No
// limit leaves more than this.
inline constexpr double kMaxRoom = 2;

template <int Boxes>
inline constexpr int kMaxEdges = kMaxLines + 10 * Boxes;
// An arm's single lines and its boxes.
template <class T, int Boxes = kMaxBoxes>
struct Limits {
    OnCircle<T> line[kMaxLines];
    int line_count = 0;
    EulerBox<T> box[Boxes];
    int box_count = 0;
};
// Without boxes, which take nearly all of the memory.
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
    T min = T(kMaxRoom);
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

// An edge of the limits: a line whose zeros may begin or end an allowed arc. It refers to the line, because copies of
// all lines of two boxes would take eight kilobytes with the widest registers. A box has two rooms, front and back, for
// either sign of the middle angle's cosine. Lines without a box are part of both.
template <class T>
struct Edge {
    enum Kind { whole, sine, past_turn, along_turn } kind;
    const OnCircle<T>*x, *y;  // the line itself; the sine; or cosine and sine of an angle
    const Turned<T>* turn;    // an end or the middle of that angle's range
    const T* bound;           // of the sine
    int box;                  // -1: none
    int front, back;          // its sign in that room; 0: it is no part of it

    SWIVEL_INLINE constexpr OnCircle<T> line() const
    {
        if (kind == whole) return *x;
        if (kind == sine) return *x - constant(*bound);
        return kind == past_turn ? past(*turn, *x, *y) : along(*turn, *x, *y);
    }
    // The lanes in which this edge exists.
    SWIVEL_INLINE constexpr Mask<T> live() const { return kind == sine ? abs(*bound) <= T(1) : all_lanes<T>(); }
};

// The edges of all limits, which must outlive them. middles: also the edges that matter only where nothing is allowed.
// Edges that are live in no lane are left out.
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
