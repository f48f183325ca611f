// SPDX-License-Identifier: MIT
//
// The stages of the joint limits: one for each limit. A stage writes what its limit says of the swivel: a line, or a
// box's curves.
#pragma once

#include "core/joint_limits.h"
#include "core/region.h"
#include "simd/limbs/goal_stages.h"

namespace swivel::inline SWIVEL_ISA {

// How far the upper arm is off the line to the wrist: about the hinge, or any rotation where a line of the hand aims.
template <class S>
SWIVEL_INLINE auto lift_of(const S& s)
{
    if constexpr (S::template is<SWIVEL_WITH_AIM>())
        return s.rows.rotor(kLiftRow);
    else
        return hinge(s.rows.get(kLiftRow), s.rows.get(kLiftRow + 1));
}
// The arm that is limited.
template <class S>
SWIVEL_INLINE auto arm_of(const S& s)
{
    using T = typename S::T;
    using Lift = decltype(lift_of(s));
    return SwivellingArm<T, Lift>{s.rows.vector(kLineRow), s.rows.vector(kNormalRow), lift_of(s), s.elbow(),
                                  s.rows.rotor(kHandRow)};
}

template <class S>
SWIVEL_INLINE void set_line(const S& s, std::uint32_t row, const OnCircle<typename S::T>& line)
{
    s.rows.set(row, line.a);
    s.rows.set(row + 1, line.b);
    s.rows.set(row + 2, line.c);
}

// The value of a limit that is a line, as its parts say.
template <swivel_field limit, class S>
SWIVEL_INLINE auto load_limit(const S& s)
{
    constexpr const ValueLayout& value = row_of(limit).value;
    if constexpr (value.parts[0] == ValuePart::range) {
        return s.io.load_range(limit);
    } else if constexpr (value.parts[1] == ValuePart::cosine) {
        return s.io.load_cone(limit);
    } else {
        static_assert(value.parts[0] == ValuePart::axis && value.parts[1] == ValuePart::range &&
                      value.parts[2] == ValuePart::none);
        return Twist<typename S::T>{s.io.load_vector(limit), s.io.load_range(limit, 3)};
    }
}
// Its line comes after those of the features before its own.
template <Stage stage, class S>
requires(is_line(stage)) SWIVEL_INLINE void advance(AtStage<stage>, const S& s)
{
    constexpr swivel_field limit = line_limit_of(stage);
    constexpr swivel_features before = row_of(limit).needs - 1;
    const auto value = load_limit<limit>(s);
    const OnCircle<typename S::T> line = limit_line<limit>(arm_of(s), value);
    s.require(is_valid(value));
    set_line(s, kLimitRow + 3 * line_count(s.strip.run.features & before), line);
}

// Stores the curves of the nth box. Its ranges stay among the inputs.
template <class S>
SWIVEL_INLINE void set_box(const S& s, std::uint32_t n, swivel_field field, const EulerCurves<typename S::T>& curves)
{
    using T = typename S::T;
    const Range<T> ranges[3] = {s.io.load_range(field), s.io.load_range(field, 4), s.io.load_range(field, 8)};
    s.require(is_valid(ranges));
    const std::uint32_t row = kBoxRow + 15 * n;
    set_line(s, row, curves.sine);
    set_line(s, row + 3, curves.first_cos);
    set_line(s, row + 6, curves.first_sin);
    set_line(s, row + 9, curves.last_cos);
    set_line(s, row + 12, curves.last_sin);
}
template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::shoulder_box>, const S& s)
{
    const EulerOrder& order = kEulerOrders[s.strip.run.shoulder_order];
    set_box(s, 0, SWIVEL_SHOULDER_BOX, shoulder_box_curves(arm_of(s), order));
}
template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::wrist_box>, const S& s)
{
    const EulerOrder& order = kEulerOrders[s.strip.run.wrist_order];
    set_box(s, s.has(SWIVEL_WITH_SHOULDER_BOX), SWIVEL_WRIST_BOX, wrist_box_curves(arm_of(s), order));
}
template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::region>, const S& s)
{
    const auto on = region_limit(arm_of(s), s.strip.run.region);
    set_line(s, kRegionRows[0], on.x);
    set_line(s, kRegionRows[1], on.y);
    set_line(s, kRegionRows[2], on.z);
}

}  // namespace swivel::inline SWIVEL_ISA
