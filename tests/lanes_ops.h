// SPDX-License-Identifier: MIT
//
// Every operation of core/num.h's list, over any number type of floats. lanes_isa.cpp compiles this for lanes, once for
// each instruction set, and test_lanes.cpp for plain float. There are no standard containers here, because their
// functions would be shared between instruction sets.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/num.h"

namespace swivel::test {

// One test: a and b and c go in, one word for each lane comes out.
enum class Op {
    add,
    subtract,
    multiply,
    divide,
    square_root,  // arithmetic: any NaN equals any NaN
    minus,
    absolute,
    copy_sign,
    flip_the_sign,
    lower,
    higher,
    power_below,
    per_power_below,
    choose,  // bits
    less,
    less_equal,
    greater,
    greater_equal,
    equal,
    both,
    either,
    not_less,
    is_number,  // masks, as words
    words_or,
    choose_words,
    constant,
    any_less,  // over all lanes of a step, the same word in each
    all_less,
    store_some,  // over c, where a is less
    count
};

constexpr bool is_arithmetic(Op op) { return op <= Op::square_root; }

// Runs an operation over `count` lanes, a multiple of 64, arrays aligned to 64 bytes.
struct LaneTest {
    std::size_t width;  // lanes of a step
    void (*run)(Op op, const float* a, const float* b, const float* c, float* out, std::size_t count);
};
struct LaneTests {
    LaneTest one_register, two_registers;
};

inline namespace SWIVEL_ISA {

inline constexpr std::uint32_t kWord = 0xffa5c301u, kOther = 0x5a5a5a5au;
inline constexpr double kConstant = 0.1;  // no float

// store: takes a T or Word<T>.
template <class T, class Store>
SWIVEL_INLINE void apply(Op op, const T& a, const T& b, const T& c, Store store)
{
    switch (op) {
        case Op::add:
            return store(a + b);
        case Op::subtract:
            return store(a - b);
        case Op::multiply:
            return store(a * b);
        case Op::divide:
            return store(a / b);
        case Op::square_root:
            return store(sqrt(a));
        case Op::minus:
            return store(-a);
        case Op::absolute:
            return store(abs(a));
        case Op::copy_sign:
            return store(copysign(a, b));
        case Op::flip_the_sign:
            return store(flip_sign(a, b));
        case Op::lower:
            return store(lo(a, b));
        case Op::higher:
            return store(hi(a, b));
        case Op::power_below:
            return store(power_of_two(a));
        case Op::per_power_below:
            return store(per_power_of_two(a));
        case Op::choose:
            return store(select(c < T(0), a, b));
        case Op::less:
            return store(word_where(a < b, kWord));
        case Op::less_equal:
            return store(word_where(a <= b, kWord));
        case Op::greater:
            return store(word_where(a > b, kWord));
        case Op::greater_equal:
            return store(word_where(a >= b, kWord));
        case Op::equal:
            return store(word_where(a == b, kWord));
        case Op::both:
            return store(word_where((a < b) & (a < c), kWord));
        case Op::either:
            return store(word_where((a < b) | (a < c), kWord));
        case Op::not_less:
            return store(word_where(!(a < b), kWord));
        case Op::is_number:
            return store(word_where(a == a, kWord));
        case Op::words_or:
            return store(word_where(a < b, kWord) | word_where(a < c, kOther));
        case Op::choose_words:
            return store(select(a < b, word<T>(kWord), word<T>(kOther)));
        case Op::constant:
            return store(T(kConstant));
        case Op::any_less:
            return store(T(any(a < b) ? 1.0 : 0.0));
        case Op::all_less:
            return store(T(all(a < b) ? 1.0 : 0.0));
        case Op::store_some:
            return store(select(a < b, a, c));
        case Op::count:
            return;
    }
}

}  // namespace SWIVEL_ISA
}  // namespace swivel::test
