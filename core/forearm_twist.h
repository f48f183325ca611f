// SPDX-License-Identifier: MIT
//
// The wrist's twist about the forearm, shared out over twist bones between elbow and wrist. Halving a turn is exact and
// takes one root. Between the quarters a straight line is close enough. Its error is under 0.12 degrees for a twist of
// 180, and an eighth of that for a twist of 90.
#pragma once

#include "core/swivel_circle.h"

namespace swivel::inline SWIVEL_ISA {

// The twist of a rotor about e3, the short way, as a unit rotor. It is the identity where the rotor swings by pi,
// because its twist is then undefined.
template <class T>
SWIVEL_INLINE constexpr Turned<T> twist_rotor(const Rotor<T>& q)
{
    const T w = q.template at<kScalar>(), z = q.template at<kK>();
    const T length2 = w * w + z * z;
    const Mask<T> none = !(length2 > T(1e-12));
    const T per_length = T(1) / sqrt(select(none, T(1), length2));
    return {select(none, T(1), per_length * abs(w)), select(none, T(0), per_length * flip_sign(z, w))};
}

// The unit rotor on the straight line from a to b.
template <class T>
SWIVEL_INLINE constexpr Turned<T> on_the_way(const Turned<T>& a, const Turned<T>& b, const T& share)
{
    const T c = a.cos + share * (b.cos - a.cos), s = a.sin + share * (b.sin - a.sin);
    const T per_length = T(1) / sqrt(c * c + s * s);
    return {per_length * c, per_length * s};
}

// A share, 0 to 1 and the same for all lanes, of a twist rotor with cos >= 0.
template <class T>
SWIVEL_INLINE constexpr Turned<T> shared_twist(const Turned<T>& twist, double share)
{
    const Turned<T> none{T(1), T(0)};
    const Turned<T> half = on_the_way(none, twist, T(0.5));
    const Turned<T>&from = share < 0.5 ? none : half, &to = share < 0.5 ? half : twist;
    const double within = share < 0.5 ? 2 * share : 2 * share - 1;
    const Turned<T> middle = on_the_way(from, to, T(0.5));
    return within < 0.5 ? on_the_way(from, middle, T(2 * within)) : on_the_way(middle, to, T(2 * within - 1));
}

}  // namespace swivel::inline SWIVEL_ISA
