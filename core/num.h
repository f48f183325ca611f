// SPDX-License-Identifier: MIT
//
// The operations that formulas use of a number type T: + - * /, unary minus, comparisons that give Mask<T>, and the
// functions below. This file has them for float and double; simd/lanes.h has the same list for lanes. Each is one
// correctly rounded IEEE 754 operation, or moves bits. So every T of the same precision gives the same bits.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/isa.h"

namespace swivel::inline SWIVEL_ISA {

// The same bits as a value of another type of the same size, as by std::bit_cast, which standard libraries older than
// C++20's lack, such as that of emscripten 3.1.
template <class To, class From>
SWIVEL_ALWAYS_INLINE constexpr To bit_cast(const From& from)
{
    return __builtin_bit_cast(To, from);
}

// Mask<T> holds the truth of a comparison, Word<T> a 32-bit word, one for each lane of T.
template <class T>
struct NumberTraits {
    using Mask = bool;
    using Word = std::uint32_t;
};
template <class T>
using Mask = typename NumberTraits<T>::Mask;
template <class T>
using Word = typename NumberTraits<T>::Word;

SWIVEL_ALWAYS_INLINE float sqrt(float x) { return std::sqrt(x); }
SWIVEL_ALWAYS_INLINE double sqrt(double x) { return std::sqrt(x); }
SWIVEL_ALWAYS_INLINE float abs(float x) { return std::fabs(x); }
SWIVEL_ALWAYS_INLINE double abs(double x) { return std::fabs(x); }
// The size of x with the sign bit of sign.
SWIVEL_ALWAYS_INLINE float copysign(float x, float sign) { return std::copysign(x, sign); }
SWIVEL_ALWAYS_INLINE double copysign(double x, double sign) { return std::copysign(x, sign); }

// x, negated where the sign bit of `sign` is set.
SWIVEL_ALWAYS_INLINE float flip_sign(float x, float sign) { return std::signbit(sign) ? -x : x; }
SWIVEL_ALWAYS_INLINE double flip_sign(double x, double sign) { return std::signbit(sign) ? -x : x; }

// For a normal number x > 0: the largest power of two that is not above it. per_power_of_two() is 1/2 divided by that
// power. Its product with x is at least 1/2 and under 1 (x up to 2^125). Products with either are not rounded.
SWIVEL_ALWAYS_INLINE float power_of_two(float x) { return bit_cast<float>(bit_cast<std::uint32_t>(x) & 0x7f800000u); }
SWIVEL_ALWAYS_INLINE double power_of_two(double x)
{
    return bit_cast<double>(bit_cast<std::uint64_t>(x) & 0x7ff0000000000000u);
}
SWIVEL_ALWAYS_INLINE float per_power_of_two(float x)
{
    return bit_cast<float>(0x7e800000u - (bit_cast<std::uint32_t>(x) & 0x7f800000u));
}
SWIVEL_ALWAYS_INLINE double per_power_of_two(double x)
{
    return bit_cast<double>(0x7fd0000000000000u - (bit_cast<std::uint64_t>(x) & 0x7ff0000000000000u));
}

SWIVEL_ALWAYS_INLINE float select(bool mask, float a, float b) { return mask ? a : b; }
SWIVEL_ALWAYS_INLINE double select(bool mask, double a, double b) { return mask ? a : b; }
SWIVEL_ALWAYS_INLINE bool any(bool mask) { return mask; }
SWIVEL_ALWAYS_INLINE bool all(bool mask) { return mask; }
// A mask that holds in no lane.
template <class T>
SWIVEL_ALWAYS_INLINE Mask<T> no_lanes()
{
    return T(1) < T(0);
}
// A mask that holds in all lanes.
template <class T>
SWIVEL_ALWAYS_INLINE Mask<T> all_lanes()
{
    return T(0) == T(0);
}

// The smaller of two numbers; b where they do not compare.
template <class T>
SWIVEL_ALWAYS_INLINE T lo(const T& a, const T& b)
{
    return select(a < b, a, b);
}
// The larger of two numbers; b where they do not compare.
template <class T>
SWIVEL_ALWAYS_INLINE T hi(const T& a, const T& b)
{
    return select(a > b, a, b);
}

// The same word in every lane.
template <class T>
SWIVEL_ALWAYS_INLINE Word<T> word(std::uint32_t same)
{
    return Word<T>{same};
}
// The word where the mask holds, 0 elsewhere.
SWIVEL_ALWAYS_INLINE std::uint32_t word_where(bool mask, std::uint32_t word) { return mask ? word : 0u; }
SWIVEL_ALWAYS_INLINE std::uint32_t select(bool mask, std::uint32_t a, std::uint32_t b) { return mask ? a : b; }

}  // namespace swivel::inline SWIVEL_ISA
