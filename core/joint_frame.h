// SPDX-License-Identifier: MIT
//
// Forward kinematics: a joint's frame from its parent's frame and its own rotation, translation and scale. All frames
// are in the first parent's space.
#pragma once

#include "core/arm.h"

namespace swivel::inline SWIVEL_ISA {

template <class T>
struct JointFrame {
    Rotor<T> rotation;  // unit
    Vector<T> place;
    T scale;  // uniform
};

// A value that is stored although its input may be bad. CPUs differ in the bits of a computed NaN, so every NaN is
// replaced by one.
template <class T>
SWIVEL_INLINE constexpr T with_one_nan(const T& x)
{
    return select(x == x, x, T(__builtin_nan("")));
}
template <class T, BladeSet S>
SWIVEL_INLINE constexpr Mv<T, S> with_one_nan(Mv<T, S> m)
{
    for (T& x : m.c) x = with_one_nan(x);
    return m;
}

// Whether a rotation is unit but for the rounding of kinematics.
template <class T>
SWIVEL_INLINE constexpr Mask<T> is_almost_unit(const Rotor<T>& q)
{
    return is_within(len2(q), 0.99, 1.01);
}

// A rotation made unit. Most are unit but for rounding. For these one step of Newton's method on
// 1 / sqrt(length^2) does: it leaves 3/8 of the squared error, less than rounding. Others take the root and the
// quotient. Zero and numbers that are not finite become NaN.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> unit_rotation(const Rotor<T>& q)
{
    const T length2 = len2(q);
    const Mask<T> off = !is_within(length2, 1 - 1e-4, 1 + 1e-4);
    const Rotor<T> unit = (T(1.5) - T(0.5) * length2) * q;
    return any(off) ? select(off, normalise(q), unit) : unit;
}

// A value where it is valid, else NaN.
template <class T>
SWIVEL_INLINE constexpr Vector<T> or_nan(const Mask<T>& valid, const Vector<T>& v)
{
    const T nan = T(__builtin_nan(""));
    return select(valid, v, vector(nan, nan, nan));
}

// A vector turned by a rotor of unit length: v + 2 w (u x v) + 2 u x (u x v), where w is the scalar and u the axis.
template <class T>
SWIVEL_INLINE constexpr Vector<T> turned(const Rotor<T>& q, const Vector<T>& v)
{
    const Vector<T> u = vector_part(q), once = cross(u, v), twice = once + once;
    return v + q.template at<kScalar>() * twice + cross(u, twice);
}

// A vector of unit length across one of unit length.
template <class T>
SWIVEL_INLINE constexpr Vector<T> any_across(const Vector<T>& v)
{
    const T x = v.template at<kE1>(), y = v.template at<kE2>(), z = v.template at<kE3>();
    return normalise(select(abs(x) > T(0.5), vector(-y, x, T(0)), vector(T(0), -z, y)));
}

// local: of any length but zero. Made unit in the product, what rounding leaves does not grow along a chain of joints.
// translation: in the parent's frame. scale: the joint's own.
template <class T>
SWIVEL_INLINE constexpr JointFrame<T> joint_frame(const JointFrame<T>& parent, const Rotor<T>& local,
                                                  const Vector<T>& translation, const T& scale)
{
    return {unit_rotation(parent.rotation * local), parent.place + turned(parent.rotation, parent.scale * translation),
            parent.scale * scale};
}

}  // namespace swivel::inline SWIVEL_ISA
