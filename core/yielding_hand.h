// SPDX-License-Identifier: MIT
//
// A hand that yields: if the wrist misses its place, the hand turns about the wrist to bring the effector nearest to
// its target. So a heel lifts where the leg is too short for the toe. Our own.
#pragma once

#include "core/clavicle.h"

namespace swivel::inline SWIVEL_ISA {

// The distance from shoulder to wrist with a bent elbow: d^2 = (L1-L2)^2 + 4 L1 L2 cos^2(theta/2).
template <class T>
SWIVEL_INLINE constexpr T bent_reach(const T& upper, const T& fore, const T& cos_half)
{
    const T difference = upper - fore;
    return sqrt(difference * difference + T(4) * (upper * fore) * (cos_half * cos_half));
}

// In limb lengths: a wrist this near to its place is at its place (SWIVEL_REACHED).
inline constexpr double kAtItsPlace = 1e-6;

// Whether the wrist misses its place. missing: from the wrist to its place. length: of the limb.
template <class T>
SWIVEL_INLINE constexpr Mask<T> misses_its_place(const Vector<T>& missing, const T& length)
{
    const T min = T(kAtItsPlace) * length;
    return len2(missing) > min * min;
}
// The hand after the least turn that carries the effector onto the line from the wrist to its target. A target straight
// behind has no shorter way round, and nothing turns. hand: of unit length.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> yielding_hand(const Rotor<T>& hand, const Vector<T>& effector,
                                               const Vector<T>& missing, const T& length)
{
    const Mask<T> misses = misses_its_place(missing, length);
    if (!any(misses)) return hand;
    const Vector<T> from_wrist = sandwich(hand, effector);
    return select(misses, clavicle_rotation(from_wrist, from_wrist + missing, T(1)) * hand, hand);
}

}  // namespace swivel::inline SWIVEL_ISA
