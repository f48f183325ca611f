// SPDX-License-Identifier: MIT
//
// How far the wrist is from the shoulder, and the triangle that this distance and the two bones form. All angles come
// as cosines and sines of their halves, built from products that cannot cancel.
//
// If one bone is too short for the digits of the other, there is no triangle (limb_bones.h).
#pragma once

#include "core/arm.h"

namespace swivel::inline SWIVEL_ISA {

template <class T>
struct Reach {
    T distance;  // from shoulder to wrist, within the reachable shell |L1-L2| ... L1+L2
    Mask<T> too_far, too_near;
};

// near = |L1-L2|, far = L1+L2.
template <class T>
SWIVEL_INLINE constexpr Reach<T> clamp_reach(const T& wanted, const T& near, const T& far)
{
    return {lo(hi(wanted, near), far), wanted > far, wanted < near};
}

template <class T>
struct ArmTriangle {
    T cos_half, sin_half;  // of the flexion
    // The lift is the angle between the target's line and the upper arm. These are the larger and the smaller of the
    // cosine and sine of its half, both times the same number, and the sum of their squares.
    T larger, smaller, lift2;
    T cos_lift;  // only its sign counts: not negative where the larger is the cosine
};

// distance: within the shell and not 0; far = L1+L2, diff = L1-L2. These products of sums and differences are >= 0: a =
// (d-(L1-L2)) (d+(L1-L2)), b = (L1+L2-d) (L1+L2+d), p = (d+(L1-L2)) (L1+L2+d), m = (d-(L1-L2)) (L1+L2-d). With a + b =
// 4 L1 L2,
//   cos^2(flexion/2) = a / (a+b),   sin^2(flexion/2) = b / (a+b),
//   cos^2(lift/2)    = p / (p+m),   sin^2(lift/2)    = m / (p+m),   so they are as p to sqrt(pm) = sqrt(ab) to m.
template <class T>
SWIVEL_INLINE constexpr ArmTriangle<T> arm_triangle(const T& distance, const T& far, const T& diff)
{
    const T longer = far + distance, shorter = far - distance, ahead = distance + diff, behind = distance - diff;
    const T a = behind * ahead, b = shorter * longer, p = ahead * longer, m = behind * shorter;
    const T per_sum = T(1) / (a + b);
    const T cos_half = sqrt(a * per_sum), sin_half = sqrt(b * per_sum);
    const T larger = hi(p, m) * per_sum;
    return {cos_half, sin_half, larger, cos_half * sin_half, larger * ((p + m) * per_sum), p - m};
}

}  // namespace swivel::inline SWIVEL_ISA
