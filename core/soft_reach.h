// SPDX-License-Identifier: MIT
//
// How far the wrist goes for a wanted distance. The bones, the elbow's flexion and a min distance bound it. Parabolas
// of our own choice ease it into both bounds. Stretching the bones makes up for the rest. Bones of no length reach
// nothing.
#pragma once

#include "core/num.h"

namespace swivel::inline SWIVEL_ISA {

template <class T>
struct ReachRange {
    T near, far;            // the distances that elbow and min distance allow, 0 <= near <= far
    T soft_near, soft_far;  // widths of the eased zones about these; 0: none
    T max_stretch;          // of the bones, 1: none
};

template <class T>
struct SoftReach {
    T distance;                           // from shoulder to wrist before stretching, near to far
    T stretch;                            // of the bones, 1 to max_stretch; the wrist is at stretch * distance
    Mask<T> too_far, too_near, softened;  // at most one of them; softened: not at the target, in an eased zone
};

// Neither eased nor stretched.
template <class T>
SWIVEL_INLINE constexpr SoftReach<T> hard_reach(const T& wanted, const T& near, const T& far)
{
    return {lo(hi(wanted, near), far), T(1), wanted > far, wanted < near, no_lanes<T>()};
}

// At the far end, the zone is d = far - w .. far + w. There the distance becomes d - (d - far + w)^2 / (4 w), a
// parabola with slope 1 where it starts and 0 where it ends. The near end is the mirror image. The zones do not
// overlap: each is at most half of the range.
template <class T>
SWIVEL_INLINE constexpr SoftReach<T> soft_reach(const T& wanted, const ReachRange<T>& range)
{
    const T half = T(0.5) * (range.far - range.near);
    const T far_width = lo(range.soft_far, half), near_width = lo(range.soft_near, half);
    const T beyond = lo(hi(wanted - range.far + far_width, T(0)), far_width + far_width);
    const T before = lo(hi(range.near + near_width - wanted, T(0)), near_width + near_width);
    const T give_far = select(far_width > T(0), beyond * beyond / (T(4) * far_width), T(0));
    const T give_near = select(near_width > T(0), before * before / (T(4) * near_width), T(0));
    const T eased = lo(hi(wanted - give_far + give_near, range.near), range.far);
    const T stretch =
        select(eased > T(0), lo(hi(wanted / select(eased > T(0), eased, T(1)), T(1)), range.max_stretch), T(1));
    const Mask<T> made_up = (stretch < range.max_stretch) & (eased > T(0));
    const Mask<T> too_far = (wanted > range.far + far_width) & !made_up;
    const Mask<T> too_near = wanted < range.near - near_width;
    const Mask<T> eased_far = (beyond > T(0)) & !made_up, eased_near = before > T(0);
    const Mask<T> softened = (eased_far & !too_far) | (eased_near & !too_near);
    return {eased, stretch, too_far, too_near, softened};
}

}  // namespace swivel::inline SWIVEL_ISA
