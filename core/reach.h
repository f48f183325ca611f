// SPDX-License-Identifier: MIT
//
// How far the wrist is from the shoulder, and the triangle that this distance and the two bones form. All angles come
// as cosines and sines built from products that cannot cancel, unit by construction.
//
// Degenerate arms: with the distance clamped to the reachable shell, zero upper arm or both bones zero give a straight
// arm, a zero forearm puts the upper arm on the target's line.
#pragma once

#include "core/arm.h"

namespace swivel::inline SWIVEL_ISA {

template <class T>
struct Reach {
    T distance;  // from shoulder to wrist, within the reachable shell |L1-L2| ... L1+L2
    Mask<T> too_far, too_near;
};

template <class T>
SWIVEL_INLINE constexpr Reach<T> clamp_reach(const T& wanted, const T& upper, const T& fore)
{
    const T far = upper + fore;
    const T near = abs(upper - fore);
    // kTiny: bones of equal length may fold up, but the triangle keeps a base to measure by.
    const T base = hi(T(kTiny), T(1e-9) * far);
    return {lo(hi(wanted, hi(near, base)), far), wanted > far, wanted < near};
}

template <class T>
struct ArmTriangle {
    T cos_half, sin_half;  // of the flexion
    T cos_lift, sin_lift;  // of the angle between the target's line and the upper arm
};

// distance: within the shell. From a + b = 4 L1 L2 and P + M = 4 d L1:
//   cos^2(flexion/2) = a / (a+b),   sin^2(flexion/2) = b / (a+b),   cos(lift) = (P-M) / (P+M),   sin(lift) = 2 sqrt(ab)
//   / (P+M).
template <class T>
SWIVEL_INLINE constexpr ArmTriangle<T> arm_triangle(const T& distance, const T& upper, const T& fore)
{
    const T far = upper + fore, diff = upper - fore, near = abs(diff);
    const T shorter = far - distance, longer = far + distance;
    const T a = (distance - near) * (distance + near);
    const T b = shorter * longer;
    const T a_or_1 = select(a + b > T(0), a, T(1));  // a bone of no length: straight
    const T sum = a_or_1 + b;
    const T per_sum = T(1) / sum;
    const T cos_half = sqrt(a_or_1 * per_sum);
    const T sin_half = sqrt(b * per_sum);

    const T p = (distance + diff) * longer;
    const T m = (distance - diff) * shorter;
    const T p_or_1 = select(p + m > T(0), p, T(1));  // an upper arm of no length: along the target's line
    const T per_spread = T(1) / (p_or_1 + m);
    return {cos_half, sin_half, (p_or_1 - m) * per_spread, (cos_half * sin_half) * (sum + sum) * per_spread};
}

}  // namespace swivel::inline SWIVEL_ISA
