// SPDX-License-Identifier: MIT
//
// The shapes of conformal geometric algebra as multivectors, how to make them and how to read them.
//
// Conventions, fixed here and nowhere else: a point is P = x + x^2/2 einf + e0, a sphere P - r^2/2 einf, a plane n + d
// einf. A quaternion w + xi + yj + zk is the rotor with i = e3^e2, j = e1^e3, k = e2^e1. It turns o into Q o ~Q, by the
// right hand, and a*b applies b first. So it is the ordinary Hamilton quaternion. Source: D. Hildenbrand, Inverse
// Kinematics of a Virtual Character (TU Darmstadt, 2019), eqs. 3.9-3.23.
#pragma once

#include "core/algebra.h"

namespace swivel::inline SWIVEL_ISA {

template <class T>
using Vector = Mv<T, blades(kE1, kE2, kE3)>;
template <class T>
using Plane = Mv<T, blades(kE1, kE2, kE3, kEinf)>;
template <class T>
using Point = Mv<T, blades(kE1, kE2, kE3, kEinf, kE0)>;
template <class T>
using Sphere = Point<T>;
template <class T>
using Rotor = Mv<T, blades(kScalar, kI, kJ, kK)>;
// A rotor about e1, the elbow's hinge in the arm frame.
template <class T>
using Hinge = Mv<T, blades(kScalar, kI)>;
// A line through the origin: v1 i + v2 j + v3 k along the direction (v1, v2, v3).
template <class T>
using CentralLine = Mv<T, blades(kI, kJ, kK)>;

template <class T>
SWIVEL_ALWAYS_INLINE constexpr Vector<T> vector(const T& x, const T& y, const T& z)
{
    return {x, y, z};
}
// The quaternion w + xi + yj + zk.
template <class T>
SWIVEL_ALWAYS_INLINE constexpr Rotor<T> rotor(const T& x, const T& y, const T& z, const T& w)
{
    Rotor<T> q;
    q.template at<kI>() = x;
    q.template at<kJ>() = y;
    q.template at<kK>() = z;
    q.template at<kScalar>() = w;
    return q;
}
// The same quaternion from the vector x e1 + y e2 + z e3.
template <class T>
SWIVEL_ALWAYS_INLINE constexpr Rotor<T> rotor(const Vector<T>& v, const T& w)
{
    return rotor(v.template at<kE1>(), v.template at<kE2>(), v.template at<kE3>(), w);
}
// The vector x e1 + y e2 + z e3 of the quaternion w + xi + yj + zk.
template <class T>
SWIVEL_ALWAYS_INLINE constexpr Vector<T> vector_part(const Rotor<T>& q)
{
    return {q.template at<kI>(), q.template at<kJ>(), q.template at<kK>()};
}

// cos + sin i.
template <class T>
SWIVEL_ALWAYS_INLINE constexpr Hinge<T> hinge(const T& cos, const T& sin)
{
    return cos * unit<T, kScalar>() + sin * unit<T, kI>();
}

template <class T>
SWIVEL_ALWAYS_INLINE constexpr Point<T> point(const Vector<T>& x)
{
    return x + (T(0.5) * dot(x, x)).c[0] * unit<T, kEinf>() + unit<T, kE0>();
}
template <class T>
SWIVEL_ALWAYS_INLINE constexpr Sphere<T> sphere(const Point<T>& centre, const T& radius)
{
    return centre - (T(0.5) * radius * radius) * unit<T, kEinf>();
}

// Squared length.
template <class T, BladeSet S>
SWIVEL_ALWAYS_INLINE constexpr T len2(const Mv<T, S>& m)
{
    return scalar_product(m, ~m);
}
// A multivector of Euclidean blades, divided by its length.
template <class T, BladeSet S>
SWIVEL_ALWAYS_INLINE constexpr Mv<T, S> normalise(const Mv<T, S>& m)
{
    return (T(1) / sqrt(len2(m))) * m;
}

// The sum of the sizes of the components: 1 to 1.74 times a vector's length, 1 to 2 times a rotor's, and cheaper.
template <class T, BladeSet S>
SWIVEL_ALWAYS_INLINE constexpr T length1(const Mv<T, S>& m)
{
    T sum = abs(m.c[0]);
    for (std::size_t n = 1; n < m.count; ++n) sum = sum + abs(m.c[n]);
    return sum;
}

// The normal of the plane through the origin, a and b. It is as long as a x b. It is the dual of e0 ^ b ^ a ^ einf,
// which is the Euclidean dual of b ^ a.
template <class T, BladeSet A, BladeSet B>
SWIVEL_ALWAYS_INLINE constexpr auto cross(const Mv<T, A>& a, const Mv<T, B>& b)
{
    return times_blade<kEuclid>(b ^ a);
}

// The line through the origin along v: the dual of e0 ^ v ^ einf (eqs. 3.10-3.12). As a unit vector's rotor it turns by
// pi about that line (eq. 3.23).
template <class T>
SWIVEL_ALWAYS_INLINE constexpr CentralLine<T> central_line(const Vector<T>& v)
{
    return dual(unit<T, kE0>() ^ v ^ unit<T, kEinf>());
}

// Q v ~Q for a rotor of any length, divided by nothing: the result is |Q|^2 times as long as v (eq. 3.21).
template <class T, BladeSet Q, BladeSet V>
SWIVEL_ALWAYS_INLINE constexpr auto sandwich(const Mv<T, Q>& q, const Mv<T, V>& v)
{
    return grade_part<1>(q * v * ~q);
}

// The same sandwich for several vectors, from the rotor's images of e1, e2 and e3.
template <class T>
struct Turn {
    Vector<T> e1, e2, e3;
    T length2;  // of the rotor

    SWIVEL_ALWAYS_INLINE constexpr Vector<T> operator()(const Vector<T>& v) const
    {
        return v.template at<kE1>() * e1 + v.template at<kE2>() * e2 + v.template at<kE3>() * e3;
    }
};
// With Q = w + x i + y j + z k, from Q e1 ~Q = (ww + xx - yy - zz) e1 + 2 (xy + wz) e2 + 2 (xz - wy) e3 and its like.
template <class T>
SWIVEL_ALWAYS_INLINE constexpr Turn<T> turn_by(const Rotor<T>& q)
{
    const T w = q.template at<kScalar>(), x = q.template at<kI>(), y = q.template at<kJ>(), z = q.template at<kK>();
    const T twice_x = x + x, twice_y = y + y, twice_z = z + z;
    const T xx = x * x, yy = y * y, zz = z * z, ww = w * w;
    const T xy = twice_x * y, xz = twice_x * z, yz = twice_y * z, wx = w * twice_x, wy = w * twice_y, wz = w * twice_z;
    const T even = ww - zz, odd = ww + zz, across = xx - yy, along = xx + yy;
    return {vector(even + across, xy + wz, xz - wy), vector(xy - wz, even - across, yz + wx),
            vector(xz + wy, yz - wx, odd - along), odd + along};
}

// The one of a rotation's two quaternions, q and -q, that has w >= 0. At w = 0, its first component of x, y, z that is
// not zero is positive.
template <class T>
SWIVEL_ALWAYS_INLINE constexpr Rotor<T> hemisphere(const Rotor<T>& q)
{
    const T zero = T(0), x = q.template at<kI>(), y = q.template at<kJ>(), w = q.template at<kScalar>();
    const T among_xyz = select(x == zero, select(y == zero, q.template at<kK>(), y), x);
    return flip_sign(q, select(w == zero, among_xyz, w));
}

// No rotation.
template <class T>
SWIVEL_ALWAYS_INLINE constexpr Rotor<T> one()
{
    return rotor(T(0), T(0), T(0), T(1));
}

}  // namespace swivel::inline SWIVEL_ISA
