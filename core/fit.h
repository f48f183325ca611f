// SPDX-License-Identifier: MIT
//
// Shifts a body along an axis, such as its pelvis up or down, so that its limbs reach. Shifts are heights over the
// body's present place. Our own formulas.
#pragma once

#include "core/arm.h"

namespace swivel::inline SWIVEL_ISA {

inline constexpr double kAnyShift = 1e15;

// The shifts from which one limb, or all limbs of a body, reach.
template <class T>
struct ShiftSpan {
    T low, high;
    Mask<T> reaches;  // false: no shift lets some limb reach
};
template <class T>
SWIVEL_INLINE constexpr ShiftSpan<T> operator&(const ShiftSpan<T>& a, const ShiftSpan<T>& b)
{
    const Mask<T> reaches = a.reaches & b.reaches;
    return {hi(a.low, b.low), lo(a.high, b.high), reaches};
}

// away: from the limb's target to its root. With b the height of the root over the target and k their distance across,
// shifts from -b - r to -b + r bring the root into reach, r^2 = reach^2 - k^2. For a limb that no shift lets reach, r
// is 0: it comes closest there. up: unit.
template <class T>
SWIVEL_INLINE constexpr ShiftSpan<T> shift_span(const Vector<T>& away, const Vector<T>& up, const T& reach)
{
    const T height = scalar_product(up, away), across2 = len2(away - height * up), room2 = reach * reach - across2;
    const T room = sqrt(hi(room2, T(0)));
    return {-height - room, room - height, room2 >= T(0)};
}

// The span of a limb with this weight, 0 to 1. An end that asks for a shift asks for that share of it; an end that
// allows a shift allows more. Weight 0 asks for nothing and allows all.
template <class T>
SWIVEL_INLINE constexpr ShiftSpan<T> counted(const ShiftSpan<T>& span, const T& share)
{
    if (all(share == T(1))) return span;
    const T more = T(1) / hi(share, T(1e-15));
    const Mask<T> counts = share > T(0), reaches = span.reaches | !counts;
    return {select(counts, select(span.low > T(0), share, more) * span.low, T(-kAnyShift)),
            select(counts, select(span.high < T(0), share, more) * span.high, T(kAnyShift)), reaches};
}

template <class T>
struct FittedShift {
    T shift;
    Mask<T> all_reach;
};
// The shift nearest to the wish that all limbs reach from. If there is none, the middle between the conflicting ends,
// which minimises the largest distance to a limb's span. drop, rise: 0 or more.
template <class T>
SWIVEL_INLINE constexpr FittedShift<T> fitted_shift(const ShiftSpan<T>& span, const T& wish, const T& drop,
                                                    const T& rise)
{
    const Mask<T> agree = span.low <= span.high;
    const T free = select(agree, lo(hi(wish, span.low), span.high), T(0.5) * (span.low + span.high));
    const T shift = lo(hi(free, -drop), rise);
    const Mask<T> all_reach = agree & span.reaches & (shift >= span.low) & (shift <= span.high);
    return {shift, all_reach};
}

}  // namespace swivel::inline SWIVEL_ISA
