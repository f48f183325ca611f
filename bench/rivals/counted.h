// SPDX-License-Identifier: MIT
//
// A number that counts what is done with it: a float with the list of operations that core/num.h asks for. Each root,
// division, product and sum is one more in a tally. Formulas run on it unchanged.
#pragma once

#include <cmath>
#include <cstdint>

#include "bench/rivals/op_counts.h"
#include "core/num.h"

namespace bench {

// Of the calling thread.
inline thread_local OpCounts tally;

struct Counted {
    float value = 0;
    bool is_unit = false;  // the constant 1: products with it are left out by every compiler

    Counted() = default;
    explicit Counted(double x) : value(static_cast<float>(x)), is_unit(x == 1) {}
};
struct CountedMask {
    bool value;
};
struct CountedWord {
    std::uint32_t value;
};

inline Counted uncounted(float result)
{
    Counted x;
    x.value = result;
    return x;
}
inline Counted counted(int& count, float result)
{
    ++count;
    return uncounted(result);
}

inline Counted operator+(Counted a, Counted b) { return counted(tally.additions, a.value + b.value); }
inline Counted operator-(Counted a, Counted b) { return counted(tally.additions, a.value - b.value); }
inline Counted operator*(Counted a, Counted b)
{
    if (a.is_unit || b.is_unit) return a.is_unit ? b : a;
    return counted(tally.multiplications, a.value * b.value);
}
inline Counted operator/(Counted a, Counted b) { return counted(tally.divisions, a.value / b.value); }
inline Counted sqrt(Counted x) { return counted(tally.roots, std::sqrt(x.value)); }

inline Counted operator-(Counted a) { return uncounted(-a.value); }
inline Counted abs(Counted x) { return uncounted(std::fabs(x.value)); }
inline Counted copysign(Counted x, Counted sign) { return uncounted(std::copysign(x.value, sign.value)); }
inline Counted flip_sign(Counted x, Counted sign) { return uncounted(std::signbit(sign.value) ? -x.value : x.value); }
inline Counted power_of_two(Counted x) { return uncounted(swivel::power_of_two(x.value)); }
inline Counted per_power_of_two(Counted x) { return uncounted(swivel::per_power_of_two(x.value)); }

inline CountedMask operator<(Counted a, Counted b) { return {a.value < b.value}; }
inline CountedMask operator<=(Counted a, Counted b) { return {a.value <= b.value}; }
inline CountedMask operator>(Counted a, Counted b) { return {a.value > b.value}; }
inline CountedMask operator>=(Counted a, Counted b) { return {a.value >= b.value}; }
inline CountedMask operator==(Counted a, Counted b) { return {a.value == b.value}; }

inline CountedMask operator&(CountedMask a, CountedMask b) { return {a.value && b.value}; }
inline CountedMask operator|(CountedMask a, CountedMask b) { return {a.value || b.value}; }
inline CountedMask operator!(CountedMask a) { return {!a.value}; }
inline bool any(CountedMask mask) { return mask.value; }
inline bool all(CountedMask mask) { return mask.value; }

inline Counted select(CountedMask mask, Counted a, Counted b) { return uncounted(mask.value ? a.value : b.value); }
inline CountedWord select(CountedMask mask, CountedWord a, CountedWord b) { return mask.value ? a : b; }
inline CountedWord word_where(CountedMask mask, std::uint32_t word) { return {mask.value ? word : 0u}; }
inline CountedWord operator|(CountedWord a, CountedWord b) { return {a.value | b.value}; }

}  // namespace bench

namespace swivel::inline SWIVEL_ISA {

template <>
struct NumberTraits<bench::Counted> {
    using Mask = bench::CountedMask;
    using Word = bench::CountedWord;
};

}  // namespace swivel::inline SWIVEL_ISA
