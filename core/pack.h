// SPDX-License-Identifier: MIT
//
// Rotations and numbers in 16-bit words, rounded to nearest, ties to even. Float arithmetic does the rounding: adding a
// large number leaves an integer, or a half float's digits, in the low bits of the sum. The words stay in the bits of a
// T until they are stored. docs/howto/limbs.md says how to read them.
#pragma once

#include "core/conformal.h"

namespace swivel::inline SWIVEL_ISA {

// Steps of a component in -1/sqrt 2 to 1/sqrt 2: 15 bits, 0 in the middle.
inline constexpr double kPackedSteps = 16383 * 1.41421356237309505;
inline constexpr int kPackedZero = 16384, kPackedTopBit = 32768;

// A rotation's three words, in the low 16 bits of each.
template <class T>
struct PackedRotation {
    T first, second, third;
};

// A number in the middle of [2^23, 2^24): there floats are the integers, and the low 16 bits of s + it are s rounded.
inline constexpr double kIntegers = 12582912;

// The smallest three components of a unit quaternion. The component of largest size is left out (the first, if equal).
// The others are those of q or -q, whichever has the left-out component positive.
template <class T>
SWIVEL_INLINE constexpr PackedRotation<T> packed_rotation(const Rotor<T>& q)
{
    const T x = q.template at<kI>(), y = q.template at<kJ>(), z = q.template at<kK>(), w = q.template at<kScalar>();
    const T size_x = abs(x), size_y = abs(y), size_z = abs(z), size_w = abs(w);
    const Mask<T> y_of_xy = size_y > size_x, w_of_zw = size_w > size_z;
    const Mask<T> of_zw = hi(size_z, size_w) > hi(size_x, size_y), of_xy = !of_zw;
    const T largest = select(of_zw, select(w_of_zw, w, z), select(y_of_xy, y, x));

    // In the order x, y, z, w, without the largest, whose index is y_of_xy or 2 + w_of_zw.
    const T first = select(of_zw | y_of_xy, x, y), second = select(of_zw, y, z), third = select(of_zw & w_of_zw, z, w);
    const Mask<T> odd = (of_zw & w_of_zw) | (of_xy & y_of_xy);
    const T plain = T(kIntegers + kPackedZero), marked = T(kIntegers + kPackedZero + kPackedTopBit);
    const T steps = flip_sign(T(kPackedSteps), largest);
    return {steps * first + select(odd, marked, plain), steps * second + select(of_zw, marked, plain),
            steps * third + plain};
}

// v in 0..65504, the largest half float, as one in bits kHalfBit to kHalfBit + 15. For v in [2^e, 2^(e+1)), the last
// digit of a half is worth 2^(e-10), but no less than 2^-24. The last digit of a float in [m, 2m) is worth as much. A
// float's exponent is biased by 127 and a half's by 15, and the word keeps the lowest six bits. So 2^-48 serves as well
// as 2^-112, and it avoids denormal floats, which are slow. A denormal half has exponent bits 0, and so has the float 2
// here.
inline constexpr int kHalfBit = 13;
template <class T>
SWIVEL_INLINE constexpr T packed_half(const T& v)
{
    const T m = hi(power_of_two(v) * T(8192), T(0.5));
    const T rounded = (v + m) - m;
    return select(rounded < T(0x1p-14), T(2) + rounded * T(0x1p15), rounded * T(0x1p-48));
}

}  // namespace swivel::inline SWIVEL_ISA
