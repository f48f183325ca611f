// SPDX-License-Identifier: MIT
//
// Target and bones leave one angle free, the swivel phi: the arm's turn about the line from shoulder to target. In the
// line's own frame, with e3 along it, this turn is the rotor cos(phi/2) + sin(phi/2) k. So every coordinate of a vector
// that turns with the arm is a cos phi + b sin phi + c, and so is every product of two components of the arm's rotor.
// No angle is formed: a turn is the pair (cos, sin).
#pragma once

#include "core/conformal.h"

namespace swivel::inline SWIVEL_ISA {

// Numbers with less squared variation over the circle than this count as constant.
inline constexpr double kFlat2 = 1e-14;

// (cos, sin) of a turn.
template <class T>
struct Turned {
    T cos, sin;
};

template <class T>
SWIVEL_ALWAYS_INLINE constexpr Turned<T> select(const Mask<T>& mask, const Turned<T>& a, const Turned<T>& b)
{
    return {select(mask, a.cos, b.cos), select(mask, a.sin, b.sin)};
}

// The number a cos phi + b sin phi + c.
template <class T>
struct OnCircle {
    T a, b, c;

    SWIVEL_ALWAYS_INLINE constexpr T at(const Turned<T>& swivel) const { return a * swivel.cos + b * swivel.sin + c; }
};
template <class T>
SWIVEL_ALWAYS_INLINE constexpr OnCircle<T> operator+(const OnCircle<T>& x, const OnCircle<T>& y)
{
    return {x.a + y.a, x.b + y.b, x.c + y.c};
}
template <class T>
SWIVEL_ALWAYS_INLINE constexpr OnCircle<T> operator-(const OnCircle<T>& x, const OnCircle<T>& y)
{
    return {x.a - y.a, x.b - y.b, x.c - y.c};
}
template <class T>
SWIVEL_ALWAYS_INLINE constexpr OnCircle<T> operator*(const T& s, const OnCircle<T>& x)
{
    return {s * x.a, s * x.b, s * x.c};
}
template <class T>
SWIVEL_ALWAYS_INLINE constexpr OnCircle<T> constant(const T& c)
{
    return {T(0), T(0), c};
}

// fixed . moving, both in the line's frame at phi = 0; only `moving` turns. It may lack e1, or e2 and e3.
template <class T, BladeSet S>
SWIVEL_INLINE constexpr OnCircle<T> inner(const Vector<T>& fixed, const Mv<T, S>& moving)
{
    const T f1 = fixed.template at<kE1>(), f2 = fixed.template at<kE2>();
    if constexpr (S == blades(kE1)) {
        const T m1 = moving.template at<kE1>();
        return {f1 * m1, f2 * m1, T(0)};
    } else {
        const T m2 = moving.template at<kE2>(), c = fixed.template at<kE3>() * moving.template at<kE3>();
        if constexpr (S == blades(kE2, kE3))
            return {f2 * m2, -(f1 * m2), c};
        else {
            const T m1 = moving.template at<kE1>();
            return {f1 * m1 + f2 * m2, f2 * m1 - f1 * m2, c};
        }
    }
}

// The rotor component at_0 cos(phi/2) + at_pi sin(phi/2). A product of two is a number on the circle.
template <class T>
struct OnHalfCircle {
    T at_0, at_pi;
};
template <class T>
SWIVEL_INLINE constexpr OnCircle<T> operator*(const OnHalfCircle<T>& x, const OnHalfCircle<T>& y)
{
    const T both_0 = x.at_0 * y.at_0, both_pi = x.at_pi * y.at_pi;
    return {T(0.5) * (both_0 - both_pi), T(0.5) * (x.at_0 * y.at_pi + x.at_pi * y.at_0), T(0.5) * (both_0 + both_pi)};
}

// The two turns where x crosses zero, by one root. With r2 = x.a^2 + x.b^2, there are none where r2 < x.c^2.
template <class T>
struct Crossings {
    Turned<T> first, second;
    Mask<T> exist;
};
template <class T>
SWIVEL_INLINE constexpr Crossings<T> crossings(const OnCircle<T>& x)
{
    const T r2 = x.a * x.a + x.b * x.b, rest2 = r2 - x.c * x.c;
    const Mask<T> exist = (rest2 >= T(0)) & (r2 > T(kFlat2));
    const T root = sqrt(select(exist, rest2, T(0))), per_r2 = T(1) / select(exist, r2, T(1));
    const T ac = -(x.a * x.c), bc = -(x.b * x.c), ar = x.a * root, br = x.b * root;
    return {{per_r2 * (ac - br), per_r2 * (bc + ar)}, {per_r2 * (ac + br), per_r2 * (bc - ar)}, exist};
}

}  // namespace swivel::inline SWIVEL_ISA
