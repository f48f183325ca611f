// SPDX-License-Identifier: MIT
//
// The promise: swivel_pack() gives the words that swivel.h documents, of every result of every group, to the bit, on
// every instruction set and block range. They are no further from the results than stated. Packing and unpacking are
// compared with a second implementation, in long double, made from the documentation.
#include "core/pack.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "tests/test_arm.h"
#include "tests/test_crowd.h"
#include "tests/test_random.h"
#include "tests/test_scopes.h"
#include "tools/corpus/corpus.h"
#include "tools/corpus/interface.h"

using namespace swivel;
using namespace swivel::test;
using swivel::corpus::Recipe;

namespace {

using Words = std::vector<std::uint16_t>;
using Words3 = std::array<std::uint16_t, 3>;

const long double kSteps = 16383 * std::sqrt(2.0L);

std::uint32_t row_count_of(const Crowd& crowd, std::uint32_t group)
{
    return swivel_packed_row(crowd.get(), group, SWIVEL_RESULT_END);
}
// The words of a value of a limb.
Words words_of(const Words& words, std::uint32_t row_count, std::uint32_t limb, std::uint32_t row, std::uint32_t count)
{
    Words value(count);
    for (std::uint32_t n = 0; n < count; ++n)
        value[n] = words[(std::size_t{limb / 16} * row_count + row + n) * 16 + limb % 16];
    return value;
}

// ---- the documentation in long double

// Whether these are the words of q. Where a component lies in the middle of two integers, within what its product
// rounds by in float (2^-11 of a step: products are below 2^14), either will do.
bool are_words_of(const Words3& words, const Float4& q)
{
    std::size_t left_out = 0;
    for (std::size_t n = 1; n < 4; ++n)
        if (std::fabs(q[n]) > std::fabs(q[left_out])) left_out = n;
    const long double sign = std::signbit(q[left_out]) ? -1 : 1;
    bool right = words[0] >> 15 == (left_out & 1) && words[1] >> 15 == left_out >> 1 && words[2] >> 15 == 0;
    for (std::size_t n = 0, word = 0; n < 4; ++n) {
        if (n == left_out) continue;
        const long double exact = sign * q[n] * kSteps + 16384;
        right = right && std::fabs((words[word++] & 32767) - exact) <= 0.5L + 0.001L;
    }
    return right;
}
std::array<long double, 4> from_words(const Words3& words)
{
    std::array<long double, 4> q{};
    const std::size_t left_out = std::size_t{words[0]} >> 15 | std::size_t{words[1]} >> 15 << 1;
    long double rest = 1;
    for (std::size_t n = 0, word = 0; n < 4; ++n) {
        if (n == left_out) continue;
        q[n] = ((words[word++] & 32767) - 16384) / kSteps;
        rest -= q[n] * q[n];
    }
    q[left_out] = std::sqrt(rest);
    long double leading = 0;
    for (const std::size_t n : {3u, 0u, 1u, 2u})
        if (leading == 0) leading = q[n];
    for (long double& c : q) c = leading < 0 ? -c : c;
    return q;
}

// The value of a half float that is not negative and finite.
long double half_value(std::uint32_t half)
{
    const int exponent = static_cast<int>(half >> 10);
    return exponent == 0 ? std::ldexp(static_cast<long double>(half), -24)
                         : std::ldexp(1024.0L + (half & 1023), exponent - 25);
}

Words3 pack(const Float4& q)
{
    const PackedRotation<float> words = packed_rotation(rotor(q[0], q[1], q[2], q[3]));
    const auto low = [](float word) { return static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(word) & 0xffff); };
    return {low(words.first), low(words.second), low(words.third)};
}
Float4 unpack(const Words3& words)
{
    Float4 q;
    swivel_unpack_rotation(words.data(), 1, q.data());
    return q;
}
std::uint32_t pack_half(float v) { return std::bit_cast<std::uint32_t>(packed_half(v)) >> kHalfBit & 0xffff; }

double angle_between(const Float4& a, const Float4& b)
{
    return 4 * std::asin(distance(quat(a).normalized(), quat(b).normalized()) / 2);
}

// A quaternion's bound, in radians. A component that is kept is off by half a step h = 1/(2 * 16383 * sqrt 2). The
// three together, s, are off by at most sqrt 3 h. The one left out is c = sqrt(1 - |s|^2) >= 1/2. It is off by |s|/c <=
// sqrt 3 times the error of s. Both together: sqrt 3 h * sqrt(1 + 3). A rotation turns by twice that. 1.002: the
// product is rounded in float, by 2^-11 of a step, and so is the result. 3.5e-6: the effect of a length that is off by
// 1e-6, by the same chain.
const double kAngle = 1.002 * 4 * std::sqrt(3) / (2 * 16383 * std::sqrt(2)) + 3.5e-6;
// A half float is off by 2^-11 of its value, so half a flexion by 2 cos sin * 2^-11, and a flexion by at most 2^-10.
constexpr double kFlexion = 0x1p-10;

// Calls check(crowd) for each crowd of hard arms and of whole limbs, solved.
template <class Check>
void for_each_crowd(const Check& check)
{
    for (const corpus::Part part : {corpus::Part::hard, corpus::Part::limbs})
        for (const Recipe& recipe : corpus::recipes_of(part)) {
            INFO(full_name(recipe));
            Crowd crowd = make_crowd(recipe, 100);
            crowd.solve();
            check(crowd);
        }
}
const Recipe& hard(const char* name) { return corpus::recipe_of(corpus::Part::hard, name); }

}  // namespace

TEST_CASE("any unit quaternion: its words are the documentation's, and lead back to it")
{
    Random random{7};
    double worst = 0;
    for (int n = 0; n < 300000; ++n) {
        // Any, and those of nearly equal components, which lose most.
        const Quaterniond equal(n & 2 ? 0.5 : -0.5, 0.5, n & 4 ? 0.5 : -0.5, 0.5);
        Quaterniond any = random.rotation();
        any.coeffs() *= n % 2 ? 1 : 1e-3;
        const Float4 q = floats(n % 2 ? any : Quaterniond(any.coeffs() + equal.coeffs()).normalized());
        const Words3 words = pack(q);
        const Float4 back = unpack(words);
        REQUIRE(are_words_of(words, q));
        REQUIRE(is_unit(back));
        REQUIRE(is_in_hemisphere(back));
        const std::array<long double, 4> exact = from_words(words);
        for (std::size_t c = 0; c < 4; ++c) REQUIRE(std::fabs(back[c] - exact[c]) <= 0x1p-24L);
        worst = std::max(worst, angle_between(back, q));
    }
    CHECK(worst <= kAngle);
    CHECK(worst > 0.9 * kAngle);  // the bound is near what happens
    CHECK(kAngle <= 1.54e-4);     // as docs/howto/limbs.md says
}

TEST_CASE("of components of equal size the first is left out; q and -q have the same words")
{
    const float r = std::sqrt(0.5f), h = 0.5f, t = std::sqrt(1 / 3.0f);
    const auto left_out = [](const Words3& words) { return words[0] >> 15 | (words[1] >> 15) << 1; };
    const struct {
        Float4 q;
        int first;
    } cases[] = {{{h, h, h, h}, 0}, {{0, t, t, t}, 1}, {{0, 0, r, r}, 2}, {{0, 0, 0, 1}, 3},
                 {{r, 0, 0, r}, 0}, {{r, r, 0, 0}, 0}, {{0, r, 0, r}, 1}, {{t, 0, t, t}, 0},
                 {{0, r, r, 0}, 1}, {{1, 0, 0, 0}, 0}, {{0, 1, 0, 0}, 1}, {{0, 0, 1, 0}, 2}};
    for (const auto& [size, first] : cases)
        for (unsigned signs = 0; signs < 16; ++signs) {
            Float4 q = size, negative;
            for (unsigned c = 0; c < 4; ++c) q[c] = signs >> c & 1 ? -q[c] : q[c];
            for (unsigned c = 0; c < 4; ++c) negative[c] = -q[c];
            INFO(q[0] << " " << q[1] << " " << q[2] << " " << q[3]);
            CHECK(left_out(pack(q)) == first);
            CHECK(are_words_of(pack(q), q));
            CHECK(pack(q) == pack(negative));
            CHECK(is_in_hemisphere(unpack(pack(q))));
            CHECK(is_unit(unpack(pack(q))));
            CHECK(angle_between(unpack(pack(q)), q) <= kAngle);
        }
    CHECK(unpack(pack({0, 0, 0, 1})) == Float4{0, 0, 0, 1});
    CHECK(unpack(pack({-1, 0, 0, -0.0f})) == Float4{1, 0, 0, 0});
    for (const int any : {0x0000, 0x0001, 0x7fff, 0x8000, 0xffff}) {  // words that no call packed give numbers, too
        const auto word = static_cast<std::uint16_t>(any);
        for (const float c : unpack({word, 1, word})) CHECK(std::isfinite(c));
    }
}

TEST_CASE("every finite half float, its neighbours and the ties between two")
{
    constexpr std::uint32_t max = 0x7bff;
    for (std::uint32_t half = 0; half <= max; ++half) {
        const float value = static_cast<float>(half_value(half));
        INFO("half " << half << ", " << value);
        REQUIRE(swivel_unpack_half(static_cast<std::uint16_t>(half)) == value);
        REQUIRE(pack_half(value) == half);
        if (half == max) break;
        const float tie = static_cast<float>((half_value(half) + half_value(half + 1)) / 2);
        REQUIRE(pack_half(tie) == half + (half & 1));
        REQUIRE(pack_half(std::nextafterf(tie, 0)) == half);
        REQUIRE(pack_half(std::nextafterf(tie, 1e9f)) == half + 1);
    }
    CHECK(pack_half(-0.0f) == 0);
    CHECK(pack_half(1e-45f) == 0);
    CHECK(pack_half(1.0000002f) == 0x3c00);  // sizes of unit vectors are so much above 1
    for (std::uint32_t half = 0; half < 0x8000; ++half) {
        const float value = swivel_unpack_half(static_cast<std::uint16_t>(half)),
                    negative = swivel_unpack_half(static_cast<std::uint16_t>(half | 0x8000));
        REQUIRE(std::bit_cast<std::uint32_t>(negative) == (std::bit_cast<std::uint32_t>(value) | 0x80000000u));
        if (half < 0x7c00)
            REQUIRE(value == half_value(half));
        else
            REQUIRE((half == 0x7c00 ? std::isinf(value) : std::isnan(value)));
    }
}

TEST_CASE("a group's words are those of its results, for every set of features")
{
    std::size_t rotations = 0, halves = 0;
    for_each_crowd([&](const Crowd& crowd) {
        for (std::uint32_t group = 0; group < swivel_group_count(crowd.get()); ++group) {
            const std::uint32_t limbs = swivel_group_limb_count(crowd.get(), group), rows = row_count_of(crowd, group);
            const Words all = crowd.pack(group);
            REQUIRE(all.size() == std::size_t{(limbs + 15) / 16} * rows * SWIVEL_LANES);
            std::uint32_t row = 0;
            for (int n = SWIVEL_SHOULDER; n < SWIVEL_RESULT_END; ++n) {
                const auto field = static_cast<swivel_field>(n);
                const std::uint32_t count = swivel_field_row_count(crowd.get(), group, field);
                std::vector<float> values(std::size_t{limbs} * count);
                if (count > 0)
                    swivel::check(swivel_read(crowd.get(), field, group, 0, limbs, {values.data(), 4 * count}));
                REQUIRE(swivel_packed_row(crowd.get(), group, field) == row);
                std::uint32_t words = 0;  // of a value
                for (std::uint32_t limb = 0; limb < limbs; ++limb) {
                    const float* const value = values.data() + std::size_t{limb} * count;
                    words = 0;
                    const auto next = [&](std::uint32_t taken) {
                        words += taken;
                        return words_of(all, rows, limb, row + words - taken, taken);
                    };
                    if (field == SWIVEL_FLAGS) {
                        const Words half = next(2);
                        REQUIRE((half[0] | std::uint32_t{half[1]} << 16) == std::bit_cast<std::uint32_t>(value[0]));
                    } else if (count % 4 == 0) {
                        for (std::uint32_t c = 0; c < count; c += 4, ++rotations) {
                            const Float4 q = {value[c], value[c + 1], value[c + 2], value[c + 3]};
                            const Words three = next(3);
                            const Words3 packed = {three[0], three[1], three[2]};
                            REQUIRE(are_words_of(packed, q));
                            REQUIRE(packed == pack(q));
                            REQUIRE(angle_between(unpack(packed), q) <= kAngle);
                        }
                    } else if (field != SWIVEL_NORMAL) {
                        for (std::uint32_t c = 0; c < count; ++c, ++halves) {
                            const float half = swivel_unpack_half(next(1)[0]);
                            REQUIRE(half == half_value(pack_half(value[c])));
                            REQUIRE(std::fabs(half - value[c]) <= std::max(0x1p-11f * value[c], 0x1p-25f));
                        }
                    }
                }
                row += words;
            }
            REQUIRE(rows == row);
            REQUIRE(swivel_packed_row(crowd.get(), group, SWIVEL_TARGET) == 0);
        }
        REQUIRE(swivel_packed_row(crowd.get(), swivel_group_count(crowd.get()), SWIVEL_RESULT_END) == 0);
    });
    CHECK(rotations > 10000);
    CHECK(halves > 1000);
}

TEST_CASE("every instruction set gives the words, in every block range, and writes no others")
{
    const IsaScope scope;
    for_each_crowd([&](const Crowd& crowd) {
        REQUIRE(swivel_use_isa("scalar") == SWIVEL_OK);
        const Words expected = crowd.pack(0);
        REQUIRE(swivel_use_isa(scope.before.c_str()) == SWIVEL_OK);
        const std::size_t block_words = std::size_t{row_count_of(crowd, 0)} * SWIVEL_LANES;
        for (const swivel_blocks blocks : {swivel_blocks{0, 7}, {0, 1}, {1, 3}, {2, 5}, {6, 1}, {5, 0}, {7, 0}}) {
            INFO("blocks " << blocks.first << " + " << blocks.count);
            Words words(blocks.count * block_words + 2, 0xa5c3);
            REQUIRE(swivel_pack(crowd.get(), 0, blocks, words.data() + 1) == SWIVEL_OK);
            CHECK(words.front() == 0xa5c3);
            CHECK(words.back() == 0xa5c3);
            CHECK(std::equal(words.begin() + 1, words.end() - 1,
                             expected.begin() + static_cast<std::ptrdiff_t>(blocks.first * block_words)));
        }
    });
}

TEST_CASE("wrists of random arms stay within the stated distance of the results'")
{
    // A shoulder off by kAngle moves the wrist by that times its distance, an elbow by that times the forearm.
    const struct {
        const char* name;
        double bound;
    } cases[] = {{"arms", kAngle + kFlexion}, {"joints", 2 * kAngle}, {"joints-hand", 2 * kAngle}};
    CHECK(kAngle + kFlexion <= 1.13e-3);  // as docs/howto/limbs.md says
    CHECK(2 * kAngle <= 3.1e-4);
    constexpr std::uint32_t limbs = 60000;
    std::uint64_t seed = 0;
    for (const auto& [name, bound] : cases) {
        Crowd crowd = make_crowd(hard(name), limbs);
        Random random{++seed};
        std::vector<double> lengths(limbs);
        for (std::uint32_t n = 0; n < limbs; ++n) {
            const double upper = n % 2 ? 1 : random.spread(1e-3, 1), fore = n % 2 ? random.spread(1e-3, 1) : 1;
            const double reach = random.between(0.9 * std::fabs(upper - fore), 1.1 * (upper + fore));
            const Vector3d line = random.direction();
            write_arm(crowd, n, {reach * line, line + random.across(line), upper, fore});
            lengths[n] = upper + fore;
        }
        crowd.solve();
        std::vector<std::array<double, 3>> wrists(limbs), packed(limbs);
        crowd.wrists(0, wrists);

        // The words as floats, in place of the results.
        const Words words = crowd.pack(0);
        const swivel_rows rows = swivel_result_rows(crowd.get(), 0);
        for (const swivel_field field : {SWIVEL_SHOULDER, SWIVEL_ELBOW, SWIVEL_WRIST})
            for (std::uint32_t n = 0; n < limbs; ++n) {
                const std::uint32_t count = swivel_field_row_count(crowd.get(), 0, field),
                                    words_each = count == 4 ? 3 : count;
                const Words value =
                    words_of(words, row_count_of(crowd, 0), n, swivel_packed_row(crowd.get(), 0, field), words_each);
                Float4 back{};
                if (count == 4) swivel_unpack_rotation(value.data(), 1, back.data());
                if (count == 2) back = {swivel_unpack_half(value[0]), swivel_unpack_half(value[1]), 0, 0};
                const std::uint32_t row = swivel_field_first_row(crowd.get(), 0, field);
                for (std::uint32_t c = 0; c < count; ++c)
                    rows.base[(std::size_t{n / 16} * rows.row_count + row + c) * 16 + n % 16] = back[c];
            }
        crowd.wrists(0, packed);
        double worst = 0;
        for (std::size_t n = 0; n < wrists.size(); ++n) {
            const Vector3d a(wrists[n].data()), b(packed[n].data());
            worst = std::max(worst, (a - b).norm() / lengths[n]);
        }
        INFO(name);
        CHECK(worst <= bound);
        CHECK(worst > 0.3 * bound);
    }
}
