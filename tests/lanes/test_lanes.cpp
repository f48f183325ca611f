// SPDX-License-Identifier: MIT
//
// The promise: every operation that formulas may use gives the same bits on lanes, of one register and of two, as on
// float. Every pair of awkward numbers, and random bit patterns. The one freedom: which NaN arithmetic gives.
#include "tests/lanes_ops.h"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "swivel/swivel.h"
#include "tests/test_random.h"

// One table for each instruction set built, each in its own namespace.
namespace swivel::test {
#define ISA(name)                      \
    inline namespace name {            \
    extern const LaneTests lane_tests; \
    }
#include "isas.inc"
#undef ISA
}  // namespace swivel::test

namespace {

using namespace swivel;
using namespace swivel::test;

struct Isa {
    const char* name;
    const LaneTests* tests;
};
const Isa isas[] = {
#define ISA(name) {#name, &swivel::test::name::lane_tests},
#include "isas.inc"
#undef ISA
};

struct alignas(64) Row {
    float lane[64];
};
struct Inputs {
    std::vector<Row> a, b, c;
    std::size_t filled = 0;

    void add(std::uint32_t x, std::uint32_t y, std::uint32_t z)
    {
        if (filled == a.size() * 64)
            for (std::vector<Row>* rows : {&a, &b, &c}) rows->emplace_back();
        const std::size_t row = filled / 64, lane = filled % 64;
        a[row].lane[lane] = std::bit_cast<float>(x);
        b[row].lane[lane] = std::bit_cast<float>(y);
        c[row].lane[lane] = std::bit_cast<float>(z);
        ++filled;
    }
};

// Zeros, denormals, normal limits, powers and their neighbours, infinities, NaNs quiet and signalling: both signs of
// each.
std::vector<std::uint32_t> awkward()
{
    std::vector<std::uint32_t> words;
    for (const std::uint32_t word :
         {0x00000000u, 0x00000001u, 0x00000002u, 0x00400000u, 0x007fffffu, 0x00800000u, 0x00800001u, 0x1f800000u,
          0x26901d7du,  // 1e-15
          0x33800000u, 0x34000000u, 0x3effffffu, 0x3f000000u, 0x3f7fffffu, 0x3f800000u, 0x3f800001u, 0x3fb504f3u,
          0x40000000u, 0x40400000u, 0x40490fdbu, 0x4b000000u, 0x4b000001u, 0x58635fa9u,  // 1e15
          0x5f7fffffu, 0x7e800000u, 0x7f7ffffeu, 0x7f7fffffu, 0x7f800000u, 0x7f800001u, 0x7fa5a5a5u, 0x7fc00000u,
          0x7fffffffu}) {
        words.push_back(word);
        words.push_back(word | 0x80000000u);
    }
    return words;
}

Inputs inputs()
{
    Inputs in;
    constexpr std::uint32_t zero = 0, one = 0x3f800000u;
    for (std::uint32_t odd = 0; odd <= 64; ++odd)  // for any and all: one lane of a step other than the rest, or none
        for (const bool less : {true, false})
            for (std::uint32_t lane = 0; lane < 64; ++lane)
                in.add((lane == odd) == less ? zero : one, (lane == odd) == less ? one : zero, 0);
    const std::vector<std::uint32_t> words = awkward();
    std::size_t turn = 0;
    for (const std::uint32_t x : words)
        for (const std::uint32_t y : words) in.add(x, y, words[turn++ % 63]);
    Random random{7};
    for (int n = 0; n < 200000; ++n) in.add(random.word(), random.word(), random.word());
    for (int n = 0; n < 200000; ++n) {  // numbers of everyday size, where rounding shows
        const auto everyday = [&] { return (random.word() & 0x87ffffffu) + 0x3c000000u; };
        in.add(everyday(), everyday(), everyday());
    }
    while (in.filled % 64 != 0) in.add(0, 0, 0);
    return in;
}

bool is_nan(std::uint32_t word) { return (word & 0x7fffffffu) > 0x7f800000u; }

std::uint32_t expected(Op op, float a, float b, float c)
{
    std::uint32_t word = 0;
    struct Store {
        std::uint32_t& word;
        void operator()(float x) const { word = std::bit_cast<std::uint32_t>(x); }
        void operator()(std::uint32_t bits) const { word = bits; }
    };
    apply<float>(op, a, b, c, Store{word});
    return word;
}

// any and all, over the lanes of the step that lane n belongs to.
std::uint32_t expected_of_step(Op op, const Inputs& in, std::size_t n, std::size_t width)
{
    std::size_t less = 0;
    for (std::size_t lane = n / width * width; lane < n / width * width + width; ++lane)
        less += in.a[lane / 64].lane[lane % 64] < in.b[lane / 64].lane[lane % 64];
    return std::bit_cast<std::uint32_t>((op == Op::any_less ? less > 0 : less == width) ? 1.0f : 0.0f);
}

std::size_t count_differences(Op op, const LaneTest& test, const Inputs& in)
{
    std::vector<Row> out(in.a.size());
    test.run(op, in.a[0].lane, in.b[0].lane, in.c[0].lane, out[0].lane, in.filled);
    std::size_t differences = 0;
    for (std::size_t n = 0; n < in.filled; ++n) {
        const float a = in.a[n / 64].lane[n % 64], b = in.b[n / 64].lane[n % 64], c = in.c[n / 64].lane[n % 64];
        const bool of_step = op == Op::any_less || op == Op::all_less;
        const std::uint32_t want = of_step ? expected_of_step(op, in, n, test.width) : expected(op, a, b, c);
        std::uint32_t got;
        std::memcpy(&got, &out[n / 64].lane[n % 64], sizeof got);
        const bool same = got == want || (is_arithmetic(op) && is_nan(got) && is_nan(want));
        if (!same && differences++ == 0)
            UNSCOPED_INFO("first difference: a " << std::hexfloat << a << ", b " << b << ", c " << c << ": " << std::hex
                                                 << got << " instead of " << want);
    }
    return differences;
}

const Inputs& all_inputs()
{
    static const Inputs in = inputs();
    return in;
}

}  // namespace

TEST_CASE("float's own operations are what their names say")
{
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const auto word = [](float x) { return std::bit_cast<std::uint32_t>(x); };
    for (const std::uint32_t w : awkward()) {
        const float x = std::bit_cast<float>(w);
        INFO(std::hex << w);
        CHECK(expected(Op::minus, x, 0, 0) == (w ^ 0x80000000u));
        CHECK(expected(Op::absolute, x, 0, 0) == (w & 0x7fffffffu));
        CHECK(expected(Op::power_below, x, 0, 0) == (w & 0x7f800000u));
        CHECK(expected(Op::per_power_below, x, 0, 0) == 0x7e800000u - (w & 0x7f800000u));
        CHECK(expected(Op::is_number, x, 0, 0) == (is_nan(w) ? 0 : kWord));
        for (const std::uint32_t v : awkward()) {
            const float y = std::bit_cast<float>(v);
            CHECK(expected(Op::copy_sign, x, y, 0) == ((w & 0x7fffffffu) | (v & 0x80000000u)));
            CHECK(expected(Op::flip_the_sign, x, y, 0) == (w ^ (v & 0x80000000u)));
            CHECK(expected(Op::lower, x, y, 0) == (x < y ? w : v));
            CHECK(expected(Op::higher, x, y, 0) == (x > y ? w : v));
        }
    }
    CHECK(expected(Op::lower, nan, 1, 0) == word(1));
    CHECK(expected(Op::higher, nan, 1, 0) == word(1));
    CHECK(is_nan(expected(Op::lower, 1, nan, 0)));
    CHECK(is_nan(expected(Op::higher, 1, nan, 0)));
    CHECK(expected(Op::lower, -0.0f, 0.0f, 0) == word(0.0f));
    CHECK(expected(Op::lower, 0.0f, -0.0f, 0) == word(-0.0f));
    CHECK(expected(Op::choose, 1, 2, -1) == word(1));
    CHECK(expected(Op::choose, 1, 2, nan) == word(2));
    CHECK(expected(Op::power_below, 13.7f, 0, 0) == word(8));
    CHECK(expected(Op::per_power_below, 13.7f, 0, 0) == word(0.0625f));
    CHECK(expected(Op::per_power_below, 0.3f, 0, 0) == word(2));
    CHECK(expected(Op::choose_words, 1, 2, 0) == kWord);
    CHECK(expected(Op::choose_words, 1, nan, 0) == kOther);
    CHECK(expected(Op::constant, 0, 0, 0) == word(0.1f));
    CHECK(swivel::any(true));
    CHECK_FALSE(swivel::any(false));
    CHECK(swivel::all(true));
    CHECK_FALSE(swivel::all(false));
}

TEST_CASE("every operation on lanes gives float's bits")
{
    std::size_t ran = 0;
    for (const Isa& isa : isas) {
        if (!swivel_isa_runs(isa.name)) {
            WARN("skipped: this CPU does not run " << isa.name);
            continue;
        }
        ++ran;
        for (const LaneTest& test : {isa.tests->one_register, isa.tests->two_registers})
            for (int op = 0; op < static_cast<int>(Op::count); ++op) {
                INFO(isa.name << ", " << test.width << " lanes, operation " << op);
                CHECK(count_differences(static_cast<Op>(op), test, all_inputs()) == 0);
            }
    }
    CHECK(ran >= 1);
}

TEST_CASE("a register holds what its instruction set can hold")
{
    for (const Isa& isa : isas) {
        const std::string name = isa.name;
        const std::size_t width = name == "scalar" ? 1 : name == "avx2" ? 8 : name == "avx512" ? 16 : 4;
        CHECK(isa.tests->one_register.width == width);
        CHECK(isa.tests->two_registers.width == (width == 1 ? 1 : 2 * width));
    }
    std::size_t built = 0;
    while (swivel_isa_at(static_cast<std::uint32_t>(built))) ++built;
    CHECK(built == std::size(isas));
}
