// SPDX-License-Identifier: MIT
//
// The rotation and the uniform scale of a joint's matrix. Engines' matrices are rotations times scales. A matrix whose
// axes are not at right angles, differ in length or are mirrored is refused. The rotation is found from the largest of
// the quaternion's components, so no digits are lost: S. W. Shepperd, Quaternion from Rotation Matrix (Journal of
// Guidance and Control, 1978).
#pragma once

#include "core/arm.h"

namespace swivel::inline SWIVEL_ISA {

// How far a matrix may be off a rotation times a scale: lengths of axes as a part of their mean, and cosines between
// axes.
inline constexpr double kMaxShear = 1e-3;

// The mean of three sizes, exact if they are equal.
template <class T>
SWIVEL_INLINE constexpr T mean_of(const T& x, const T& y, const T& z)
{
    return x + T(1.0 / 3) * ((y - x) + (z - x));
}
// The largest of three sizes less the smallest.
template <class T>
SWIVEL_INLINE constexpr T spread_of(const T& x, const T& y, const T& z)
{
    return hi(hi(x, y), z) - lo(lo(x, y), z);
}
// The mean of three scales; NaN where they are too uneven.
template <class T>
SWIVEL_INLINE constexpr T uniform_scale(const T& x, const T& y, const T& z)
{
    const T mean = mean_of(x, y, z);
    return select(spread_of(x, y, z) <= T(kMaxShear) * mean, mean, T(__builtin_nan("")));
}

template <class T>
struct MatrixFrame {
    Rotor<T> rotation;  // unit
    T scale;
    Mask<T> valid;  // false: rotation and scale may be anything, NaN too
};
// The axes: where the matrix carries e1, e2 and e3.
template <class T>
SWIVEL_INLINE constexpr MatrixFrame<T> matrix_frame(const Vector<T>& x_axis, const Vector<T>& y_axis,
                                                    const Vector<T>& z_axis)
{
    const T shrink = per_power_of_two(lo(hi(length1(x_axis), T(kTiny)), T(2 * kHuge)));  // to about 1
    const Vector<T> x = shrink * x_axis, y = shrink * y_axis, z = shrink * z_axis;
    const T x_length = sqrt(len2(x)), y_length = sqrt(len2(y)), z_length = sqrt(len2(z));
    const T scale = mean_of(x_length, y_length, z_length), max = T(kMaxShear) * scale,
            uneven = spread_of(x_length, y_length, z_length);
    const T slanted = hi(hi(abs(scalar_product(x, y)), abs(scalar_product(y, z))), abs(scalar_product(z, x)));
    const Mask<T> valid = is_within(scale, 0.1, 10) & (uneven <= max) & (slanted <= max * scale) &
                          (scalar_product(cross(x, y), z) > T(0)) & is_within(length1(x_axis), kTiny, 2 * kHuge);

    // Four times the product of the largest component with each one, times the scale.
    const T xx = x.template at<kE1>(), yy = y.template at<kE2>(), zz = z.template at<kE3>();
    const T yz = y.template at<kE3>(), zy = z.template at<kE2>(), zx = z.template at<kE1>(), xz = x.template at<kE3>(),
            xy = x.template at<kE2>(), yx = y.template at<kE1>();
    const T i4 = scale + xx - yy - zz, j4 = scale - xx + yy - zz, k4 = scale - xx - yy + zz, w4 = scale + xx + yy + zz;
    const Rotor<T> of_i = rotor(i4, xy + yx, xz + zx, yz - zy), of_j = rotor(xy + yx, j4, yz + zy, zx - xz),
                   of_k = rotor(xz + zx, yz + zy, k4, xy - yx), of_w = rotor(yz - zy, zx - xz, xy - yx, w4);
    const Mask<T> i_over_j = i4 > j4, k_over_w = k4 > w4;
    const Rotor<T> of_ij = select(i_over_j, of_i, of_j), of_kw = select(k_over_w, of_k, of_w);
    return {normalise(select(hi(i4, j4) > hi(k4, w4), of_ij, of_kw)), scale / shrink, valid};
}

}  // namespace swivel::inline SWIVEL_ISA
