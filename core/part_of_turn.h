// SPDX-License-Identifier: MIT
//
// A share of a turn, without its angle.
#pragma once

#include "core/joint_frame.h"

namespace swivel::inline SWIVEL_ISA {

// The blend weight with which a normalised blend from the identity to a rotation covers a share of its angle. Using
// `share` itself would be up to 8 degrees off. The cubic below is exact at 0, 1/2 and 1, and off by at most 0.06
// degrees. cos_half: of half the angle, >= 0. Its coefficients are our own fit.
template <class T>
SWIVEL_INLINE constexpr T bent_share(const T& share, const T& cos_half)
{
    const T half = share - T(0.5);
    const T bend = (T(0.858644) + cos_half * (T(-1.191827) + cos_half * T(0.394120))) +
                   half * half * (T(0.972072) - cos_half * T(1.485737));
    return share + share * half * (share - T(1)) * bend;
}

// The rotation at a share of 0 to 1 of the short way to another. Both are of unit length. Share 1 gives the other, to
// the bit.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> part_of_turn(const Rotor<T>& from, const Rotor<T>& to, const T& share)
{
    const Rotor<T> turn = hemisphere(to * ~from);
    const T cos_half = lo(turn.template at<kScalar>(), T(1)), part = bent_share(share, cos_half);
    const Rotor<T> between = normalise(rotor(part * turn.template at<kI>(), part * turn.template at<kJ>(),
                                             part * turn.template at<kK>(), T(1) - part + part * cos_half)) *
                             from;
    return select(share == T(1), to, between);
}

}  // namespace swivel::inline SWIVEL_ISA
