// SPDX-License-Identifier: MIT
//
// The clavicle's share of a reach: how far it turns the shoulder towards the target before the arm is solved. The curve
// is our own choice and needs no angle. It is smooth everywhere, except for a whole share and a target straight behind
// the bone.
#pragma once

#include "core/wish.h"

namespace swivel::inline SWIVEL_ISA {

// The unit rotor that turns the clavicle's bone towards the target, by about a share of 0 to 1 of the angle theta
// between them. tan(turn / 2) = share sin theta / (2 (1 - share) + share (1 + cos theta)). So a whole share is the
// whole turn. A small share grows with the angle up to about a right angle. It fades to none for a target behind, where
// neither way round is shorter. Both vectors start at the clavicle's joint. If one is shorter than kTiny, it has no
// direction, and nothing turns.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> clavicle_rotation(const Vector<T>& bone, const Vector<T>& target, const T& share)
{
    const Vector<T> a = scaled(bone), b = scaled(target), axis = share * cross(a, b);
    const T lengths = sqrt(len2(a) * len2(b)), cos = scalar_product(a, b);
    const T rest = T(1) - share;
    const Rotor<T> turn = rotor(axis, (rest + rest) * lengths + share * (lengths + cos));
    // 1e-12: a hundred times what rounding leaves of a whole share straight behind.
    const Mask<T> turns =
        (len2(turn) > T(1e-12) * (lengths * lengths)) & (len2(bone) >= T(kTiny2)) & (len2(target) >= T(kTiny2));
    return normalise(select(turns, turn, one<T>()));
}

}  // namespace swivel::inline SWIVEL_ISA
