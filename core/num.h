// SPDX-License-Identifier: MIT
//
// What a number type T owes the formulas: + - * /, unary minus, comparisons giving Mask<T>, and the functions below.
// Here for float and double; simd/lanes.h has the same list for lanes. Each is one correctly rounded IEEE 754 operation
// or a matter of bits, so every T of the same precision gives the same bits.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/isa.h"

namespace swivel::inline SWIVEL_ISA {

// Mask<T> holds the truth of a comparison, Bits<T> a 32-bit word, one for each lane of T.
template <class T>
struct NumberTraits {
    using Mask = bool;
    using Bits = std::uint32_t;
};
template <class T>
using Mask = typename NumberTraits<T>::Mask;
template <class T>
using Bits = typename NumberTraits<T>::Bits;

SWIVEL_INLINE float sqrt(float x) { return std::sqrt(x); }
SWIVEL_INLINE double sqrt(double x) { return std::sqrt(x); }
SWIVEL_INLINE float abs(float x) { return std::fabs(x); }
SWIVEL_INLINE double abs(double x) { return std::fabs(x); }
// The size of x with the sign bit of sign.
SWIVEL_INLINE float copysign(float x, float sign) { return std::copysign(x, sign); }
SWIVEL_INLINE double copysign(double x, double sign) { return std::copysign(x, sign); }

// x with its sign bit turned over where sign's is set.
SWIVEL_INLINE float flip_sign(float x, float sign) { return std::signbit(sign) ? -x : x; }
SWIVEL_INLINE double flip_sign(double x, double sign) { return std::signbit(sign) ? -x : x; }

SWIVEL_INLINE float select(bool mask, float a, float b) { return mask ? a : b; }
SWIVEL_INLINE double select(bool mask, double a, double b) { return mask ? a : b; }
SWIVEL_INLINE bool any(bool mask) { return mask; }
SWIVEL_INLINE bool all(bool mask) { return mask; }

// The smaller and the larger of two numbers; b where they do not compare.
template <class T>
SWIVEL_INLINE T lo(const T& a, const T& b)
{
    return select(a < b, a, b);
}
template <class T>
SWIVEL_INLINE T hi(const T& a, const T& b)
{
    return select(a > b, a, b);
}

// The bits where the mask holds, 0 elsewhere.
SWIVEL_INLINE std::uint32_t bits_where(bool mask, std::uint32_t bits) { return mask ? bits : 0u; }

}  // namespace swivel::inline SWIVEL_ISA
