// SPDX-License-Identifier: MIT
//
// The promise: the words of a compact crowd are its results as swivel.h documents them, to the bit, on every
// instruction set and block range. They are no further from the float results than stated. Nothing else of the crowd
// changes. Packing and unpacking are compared with a second implementation, in long double, made from the
// documentation.
#include "core/compact.h"

#include <rapidcheck/catch.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "tests/solve_jobs.h"
#include "tests/test_arm.h"
#include "tests/test_crowd.h"
#include "tests/test_isa_scope.h"
#include "tests/test_random.h"
#include "tools/corpus/corpus.h"
#include "tools/corpus/interface.h"

#ifdef __x86_64__
#include <xmmintrin.h>
#endif

using namespace swivel;
using namespace swivel::test;
using swivel::corpus::Recipe;

namespace {

using Words = std::vector<std::uint16_t>;
using Words3 = std::array<std::uint16_t, 3>;

const long double kSteps = 16383 * std::sqrt(2.0L);

std::size_t word_count(const swivel_words& rows)
{
    return std::size_t{rows.block_count} * rows.row_count * SWIVEL_LANES;
}
Words words_of(const Crowd& crowd)
{
    Words words;
    for (std::uint32_t group = 0; group < swivel_group_count(crowd.get()); ++group) {
        const swivel_words rows = swivel_compact_rows(crowd.get(), group);
        words.insert(words.end(), rows.base, rows.base + word_count(rows));
    }
    return words;
}
std::uint16_t word_of(const Crowd& crowd, swivel_field field, std::uint32_t limb, std::uint32_t word)
{
    std::uint32_t group = swivel_group_count(crowd.get()) - 1;
    while (limb < swivel_group_first_limb(crowd.get(), group)) --group;
    const swivel_words rows = swivel_compact_rows(crowd.get(), group);
    const std::uint32_t row = swivel_field_first_row(crowd.get(), group, field) + word,
                        n = limb - swivel_group_first_limb(crowd.get(), group);
    return rows.base[(std::size_t{n / 16} * rows.row_count + row) * 16 + n % 16];
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
    const CompactRotation<float> words = compact_rotation(rotor(q[0], q[1], q[2], q[3]));
    const auto low = [](float word) { return static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(word) & 0xffff); };
    return {low(words.first), low(words.second), low(words.third)};
}
Float4 unpack(const Words3& words)
{
    Float4 q;
    swivel_unpack_rotation(words.data(), 1, q.data());
    return q;
}
std::uint32_t pack_half(float v) { return std::bit_cast<std::uint32_t>(compact_half(v)) >> kHalfBit & 0xffff; }

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

Recipe compacted(Recipe recipe)
{
    recipe.features |= corpus::kCompact;
    return recipe;
}
const Recipe& hard(const char* name) { return corpus::recipe_of(corpus::Part::hard, name); }

// The same inputs in a crowd with and one without SWIVEL_COMPACT, neither solved.
struct Twins {
    Crowd floats, compact;

    Twins(const Recipe& recipe, std::uint32_t limb_count)
        : floats(make_crowd(recipe, limb_count)), compact(make_crowd(compacted(recipe), limb_count))
    {
        const swivel_rows from = swivel_input_rows(floats.get(), 0), to = swivel_input_rows(compact.get(), 0);
        REQUIRE(from.row_count == to.row_count);
        REQUIRE(from.block_count == to.block_count);
    }
    void solve()
    {
        floats.solve();
        compact.solve();
    }
};

// Calls check(recipe) for each crowd of hard arms: every set of features, without SWIVEL_COMPACT.
template <class Check>
void for_each_feature_set(const Check& check)
{
    for (const Recipe& recipe : corpus::recipes_of(corpus::Part::hard)) {
        INFO(full_name(recipe));
        if (!(recipe.features & corpus::kCompact)) check(recipe);
    }
}

std::vector<swivel_field> rotations_of(const Recipe& recipe)
{
    std::vector<swivel_field> fields{SWIVEL_SHOULDER};
    if (recipe.features & corpus::kJoints) fields.push_back(SWIVEL_ELBOW);
    if (recipe.features & corpus::kHand) fields.push_back(SWIVEL_WRIST);
    return fields;
}

}  // namespace

TEST_CASE("any unit quaternion: its words are the documentation's, and lead back to it")
{
    rc::prop("random quaternions", [] {
        Float4 q{};
        double len2 = 0;
        for (float& c : q) {
            c = static_cast<float>(*rc::gen::inRange(-1000, 1001));
            len2 += double{c} * c;
        }
        RC_PRE(len2 > 0);
        for (float& c : q) c = static_cast<float>(c / std::sqrt(len2));
        const Words3 words = pack(q);
        RC_ASSERT(are_words_of(words, q));
        RC_ASSERT(angle_between(unpack(words), q) <= kAngle);
    });
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
    CHECK(kAngle <= 1.54e-4);     // as swivel.h says
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
    CHECK(unpack({0, 0, 0}) == Float4{0, 0, 0, 0});
    for (const int any : {0x0000, 0x0001, 0x7fff, 0x8000, 0xffff}) {  // words that no solve wrote give numbers, too
        const auto word = static_cast<std::uint16_t>(any);
        for (const float c : unpack({word, 1, word})) CHECK(std::isfinite(c));
    }
}

TEST_CASE("every half float in 0..1, its neighbours and the ties between two")
{
    for (std::uint32_t half = 0; half <= 0x3c00; ++half) {
        const float value = static_cast<float>(half_value(half));
        INFO("half " << half << ", " << value);
        REQUIRE(swivel_unpack_half(static_cast<std::uint16_t>(half)) == value);
        REQUIRE(pack_half(value) == half);
        if (half == 0x3c00) break;
        const float tie = static_cast<float>((half_value(half) + half_value(half + 1)) / 2);
        REQUIRE(pack_half(tie) == half + (half & 1));
        REQUIRE(pack_half(std::nextafterf(tie, 0)) == half);
        REQUIRE(pack_half(std::nextafterf(tie, 1)) == half + 1);
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

TEST_CASE("a compact crowd's words are those of the float results, for every set of features")
{
    for_each_feature_set([&](const Recipe& recipe) {
        Twins twins(recipe, 200);
        twins.solve();
        for (std::uint32_t group = 0; group < corpus::kGroupCount; ++group) {
            const std::uint32_t first = swivel_group_first_limb(twins.compact.get(), group);
            const auto flags = read<std::uint32_t>(twins.floats, SWIVEL_FLAGS, group);
            CHECK(read<std::uint32_t>(twins.compact, SWIVEL_FLAGS, group) == flags);
            for (std::uint32_t n = 0; n < flags.size(); ++n) {
                REQUIRE(word_of(twins.compact, SWIVEL_FLAGS, first + n, 0) == (flags[n] & 0xffff));
                REQUIRE(word_of(twins.compact, SWIVEL_FLAGS, first + n, 1) == flags[n] >> 16);
            }
            for (const swivel_field field : rotations_of(recipe)) {
                const auto values = read<Float4>(twins.floats, field, group),
                           unpacked = read<Float4>(twins.compact, field, group);
                for (std::uint32_t n = 0; n < values.size(); ++n) {
                    Words3 words;
                    for (std::uint32_t w = 0; w < 3; ++w) words[w] = word_of(twins.compact, field, first + n, w);
                    REQUIRE(are_words_of(words, values[n]));
                    REQUIRE(words == pack(values[n]));
                    REQUIRE(unpacked[n] == unpack(words));
                    REQUIRE(is_unit(unpacked[n]));
                    REQUIRE(is_in_hemisphere(unpacked[n]));
                    REQUIRE(angle_between(unpacked[n], values[n]) <= kAngle);
                }
            }
            if (recipe.features & corpus::kJoints) continue;
            const auto values = read<Float2>(twins.floats, SWIVEL_ELBOW, group),
                       unpacked = read<Float2>(twins.compact, SWIVEL_ELBOW, group);
            for (std::uint32_t n = 0; n < values.size(); ++n)
                for (std::uint32_t c = 0; c < 2; ++c) {
                    const std::uint16_t half = word_of(twins.compact, SWIVEL_ELBOW, first + n, c);
                    REQUIRE(half == pack_half(values[n][c]));
                    REQUIRE(unpacked[n][c] == swivel_unpack_half(half));
                    REQUIRE(std::fabs(unpacked[n][c] - values[n][c]) <= std::max(0x1p-11f * values[n][c], 0x1p-25f));
                }
        }
    });
}

TEST_CASE("the words are the scalar build's, in every block range, and no other block is touched")
{
    const IsaScope scope;
    for_each_feature_set([&](const Recipe& recipe) {
        REQUIRE(swivel_use_isa("scalar") == SWIVEL_OK);
        Crowd whole = make_crowd(compacted(recipe), 200);
        whole.solve();
        REQUIRE(swivel_use_isa(scope.before.c_str()) == SWIVEL_OK);
        const Words expected = words_of(whole);
        const std::uint32_t blocks = swivel_block_count(whole.get());
        const std::size_t block_words = expected.size() / blocks;
        Crowd crowd = make_crowd(compacted(recipe), 200);
        for (const auto& [first, count] :
             {std::pair{0u, 1u}, {1u, 3u}, {2u, 8u}, {3u, 9u}, {12u, 2u}, {4u, 17u}, {5u, 0u}, {0u, blocks}}) {
            INFO("blocks " << first << " + " << count);
            for (std::uint32_t group = 0; group < swivel_group_count(crowd.get()); ++group) {
                const swivel_words rows = swivel_compact_rows(crowd.get(), group);
                std::fill_n(rows.base, word_count(rows), std::uint16_t{0xa5c3});
            }
            crowd.solve({.blocks = swivel_blocks{first, count}, .on_this_thread = true});
            const Words words = words_of(crowd);
            std::size_t wrong = 0;
            for (std::size_t n = 0; n < words.size(); ++n) {
                const bool inside = n / block_words >= first && n / block_words < first + count;
                wrong += words[n] != (inside ? expected[n] : 0xa5c3);
            }
            CHECK(wrong == 0);
        }
    });
    for (const std::uint32_t limb_count : {20000u, 500000u}) {  // ten chunks and more, and rows that come from memory
        Crowd crowd = make_crowd(compacted(hard("arms")), limb_count),
              by_blocks = make_crowd(compacted(hard("arms")), limb_count);
        crowd.solve();
        for (std::uint32_t block = 0, end = swivel_block_count(crowd.get()); block < end; block += 777)
            by_blocks.solve({.blocks = swivel_blocks{block, std::min(777u, end - block)}, .on_this_thread = true});
        CHECK(words_of(crowd) == words_of(by_blocks));
    }
}

#ifdef __x86_64__
TEST_CASE("words and what is read from them do not depend on the caller's floating-point environment")
{
    Crowd crowd = make_crowd(hard("hand-compact"), 300);  // here, as its numbers do depend on it
    const auto solve_and_read = [&] {
        crowd.solve();
        return std::tuple{words_of(crowd), read<Float4>(crowd, SWIVEL_SHOULDER), read<Float2>(crowd, SWIVEL_ELBOW),
                          unpack({12345, 23456, 3456}), swivel_unpack_half(1)};
    };
    const auto expected = solve_and_read();
    const unsigned before = _mm_getcsr();
    _mm_setcsr(before | 0xe040);  // towards zero, denormals flushed and taken for zeros
    const auto got = solve_and_read();
    _mm_setcsr(before);
    CHECK(got == expected);
}
#endif

TEST_CASE("wrists of random arms stay within the stated distance of the float crowd's")
{
    // A shoulder off by kAngle moves the wrist by that times its distance, an elbow by that times the forearm.
    const struct {
        const char* name;
        double bound;
    } cases[] = {{"arms", kAngle + kFlexion}, {"joints", 2 * kAngle}, {"joints-hand", 2 * kAngle}};
    CHECK(kAngle + kFlexion <= 1.13e-3);  // as swivel.h says
    CHECK(2 * kAngle <= 3.1e-4);
    std::uint64_t seed = 0;
    for (const auto& [name, bound] : cases) {
        Twins twins(hard(name), 60000);
        Random random{++seed};
        std::vector<Float3> targets(60000), poles(60000);
        std::vector<Float2> lengths(60000);
        for (std::size_t n = 0; n < targets.size(); ++n) {
            const double upper = n % 2 ? 1 : random.spread(1e-3, 1), fore = n % 2 ? random.spread(1e-3, 1) : 1;
            const double reach = random.between(0.9 * std::fabs(upper - fore), 1.1 * (upper + fore));
            const Vector3d to = random.direction();
            targets[n] = floats(Vector3d(reach * to));
            poles[n] = floats(Vector3d(to + random.across(to)));
            lengths[n] = {static_cast<float>(upper), static_cast<float>(fore)};
        }
        for (Crowd* crowd : {&twins.floats, &twins.compact}) {
            crowd->write(SWIVEL_TARGET, 0, targets);
            crowd->write(SWIVEL_POLE, 0, poles);
            crowd->write(SWIVEL_LENGTHS, 0, lengths);
        }
        twins.solve();
        std::vector<std::array<double, 3>> wrists(60000), packed(60000);
        std::vector<double> off(60000), packed_off(60000);
        twins.floats.wrists(0, wrists);
        twins.compact.wrists(0, packed);
        twins.floats.residuals(0, off);
        twins.compact.residuals(0, packed_off);
        const auto shoulders = read<Float4>(twins.floats, SWIVEL_SHOULDER),
                   packed_shoulders = read<Float4>(twins.compact, SWIVEL_SHOULDER);
        double worst = 0, worst_angle = 0, worst_residual = 0;
        for (std::size_t n = 0; n < wrists.size(); ++n) {
            const Vector3d a(wrists[n].data()), b(packed[n].data());
            worst = std::max(worst, (a - b).norm() / (double{lengths[n][0]} + lengths[n][1]));
            worst_residual = std::max(worst_residual, std::fabs(packed_off[n] - off[n]));
            worst_angle = std::max(worst_angle, angle_between(shoulders[n], packed_shoulders[n]));
        }
        INFO(name);
        CHECK(worst_angle <= kAngle);
        CHECK(worst <= bound);
        CHECK(worst > 0.3 * bound);
        CHECK(worst_residual <= bound);
        CHECK(worst_residual > 0.1 * bound);
    }
}

TEST_CASE("forward kinematics are those of the unpacked values")
{
    Twins twins(hard("arms"), 500);
    twins.solve();
    const auto shoulders = read<Float4>(twins.compact, SWIVEL_SHOULDER);
    const auto elbows = read<Float2>(twins.compact, SWIVEL_ELBOW),
               lengths = read<Float2>(twins.compact, SWIVEL_LENGTHS);
    const auto flags = read<std::uint32_t>(twins.compact, SWIVEL_FLAGS);
    std::vector<std::array<double, 3>> wrists(500), joints(500);
    twins.compact.wrists(0, wrists);
    twins.compact.elbows(0, joints);
    std::size_t seen = 0;
    for (std::size_t n = 0; n < 500; ++n) {
        if (flags[n] & SWIVEL_BAD_INPUT) continue;
        const Arm arm{{}, {}, lengths[n]};
        const Pose pose{shoulders[n], elbows[n], flags[n]};
        REQUIRE((pose.wrist_point(arm) - Vector3d(wrists[n].data())).norm() <= 1e-12 * arm.length());
        REQUIRE((pose.elbow_point(arm) - Vector3d(joints[n].data())).norm() <= 1e-12 * arm.length());
        ++seen;
    }
    CHECK(seen > 300);
}

TEST_CASE("rows of a compact crowd: words for results, floats for inputs, half the memory")
{
    const swivel_group_def groups[] = {group_of(1), group_of(16), group_of(17), group_of(40)};
    for_each_feature_set([&](const Recipe& recipe) {
        const swivel_features features = library_features(recipe);
        const Crowd crowd = crowd_with(features | SWIVEL_COMPACT, groups), floats = crowd_with(features, groups);
        const bool joints = features & SWIVEL_JOINTS, hand = features & SWIVEL_WITH_HAND;
        const std::uint32_t sizes[] = {3, joints ? 3u : 2u, hand ? 3u : 0u, 2};
        std::uint32_t row = 0;
        for (const swivel_field field : every_field()) {
            if (field < SWIVEL_SHOULDER) {
                CHECK(swivel_field_row_count(crowd.get(), 0, field) == swivel_field_row_count(floats.get(), 0, field));
                continue;
            }
            const std::uint32_t size = field <= SWIVEL_FLAGS ? sizes[field - SWIVEL_SHOULDER] : 0;
            CHECK(swivel_field_row_count(crowd.get(), 0, field) == size);
            if (size) CHECK(swivel_field_first_row(crowd.get(), 0, field) == row);
            row += size;
        }
        const swivel_words rows = swivel_compact_rows(crowd.get(), 0);
        CHECK(rows.row_count == row);
        CHECK(rows.block_count == 1);
        CHECK(reinterpret_cast<std::uintptr_t>(rows.base) % 64 == 0);
        CHECK(swivel_result_rows(crowd.get(), 0).base == nullptr);
        CHECK(swivel_result_rows(crowd.get(), 0).row_count == 0);
        CHECK(swivel_compact_rows(floats.get(), 0).base == nullptr);
        CHECK(swivel_compact_rows(floats.get(), 0).row_count == 0);

        swivel_group_def own[] = {groups[0], groups[1], groups[2], groups[3]};
        swivel_crowd_def def = def_of(own[0]);
        def.group_count = 4;
        for (swivel_group_def& group : own) group.features = features;
        const std::size_t float_bytes = swivel_crowd_bytes(&def);
        for (swivel_group_def& group : own) group.features |= SWIVEL_COMPACT;
        const std::size_t bytes = swivel_crowd_bytes(&def);
        CHECK(bytes % 64 == 0);
        std::size_t saved = 0;  // a group's rows take whole lines
        for (std::uint32_t g = 0; g < 4; ++g) {
            const swivel_rows of_floats = swivel_result_rows(floats.get(), g);
            saved += of_floats.block_count * SWIVEL_LANES * (of_floats.row_count * 4 - row * 2) / 64 * 64;
        }
        CHECK(float_bytes - bytes == saved);

        // The caller's memory: not a byte outside it is touched.
        std::vector<unsigned char> room(bytes + 192, 0xa5);
        const std::size_t start = 128 - reinterpret_cast<std::uintptr_t>(room.data()) % 64;
        def.memory = room.data() + start;
        def.memory_bytes = bytes;
        {
            Crowd in_place(def);
            in_place.solve();
        }
        for (std::size_t n = 0; n < room.size(); ++n)
            if (n < start || n >= start + bytes) REQUIRE(room[n] == 0xa5);
    });
}

TEST_CASE("padding lanes of inputs may hold anything and reach no one's words")
{
    for_each_feature_set([&](const Recipe& recipe) {
        Crowd crowd = make_crowd(compacted(recipe), 21), poisoned = make_crowd(compacted(recipe), 21);
        const swivel_rows in = swivel_input_rows(poisoned.get(), 0);
        for (std::uint32_t row = 0; row < 2 * in.row_count; ++row)
            if (row >= in.row_count) std::fill_n(in.base + row * SWIVEL_LANES + 5, 11, kNan);
        crowd.solve();
        poisoned.solve();
        for (const swivel_field field : {SWIVEL_SHOULDER, SWIVEL_ELBOW, SWIVEL_WRIST, SWIVEL_FLAGS})
            for (std::uint32_t word = 0; word < swivel_field_row_count(crowd.get(), 0, field); ++word)
                for (std::uint32_t limb = 0; limb < 21; ++limb)
                    REQUIRE(word_of(crowd, field, limb, word) == word_of(poisoned, field, limb, word));
    });
}

TEST_CASE("values are read into any stride and alignment, and nothing beside them")
{
    Crowd crowd = make_crowd(hard("hand-compact"), 100);
    crowd.solve();
    for (const swivel_field field : {SWIVEL_SHOULDER, SWIVEL_ELBOW, SWIVEL_WRIST, SWIVEL_FLAGS, SWIVEL_TARGET}) {
        const std::size_t bytes = field == SWIVEL_ELBOW    ? 8
                                  : field == SWIVEL_FLAGS  ? 4
                                  : field == SWIVEL_TARGET ? 12
                                                           : 16;
        std::vector<unsigned char> plain(bytes * 40), spread(3 + 41 * 40, 0xee);
        REQUIRE(swivel_read(crowd.get(), field, 1, 3, 40, {plain.data(), bytes}) == SWIVEL_OK);
        REQUIRE(swivel_read(crowd.get(), field, 1, 3, 40, {spread.data() + 3, 41}) == SWIVEL_OK);
        for (std::size_t n = 0; n < spread.size(); ++n) {
            const bool value = n >= 3 && (n - 3) % 41 < bytes;
            REQUIRE(spread[n] == (value ? plain[(n - 3) / 41 * bytes + (n - 3) % 41] : 0xee));
        }
        CHECK_REFUSED(swivel_read(crowd.get(), field, 1, 3, 40, {plain.data(), bytes - 1}), SWIVEL_INVALID_ARGUMENT);
    }
    Float4 value;
    CHECK_REFUSED(swivel_write(crowd.get(), SWIVEL_SHOULDER, 0, 0, 1, {&value, 16}), SWIVEL_INVALID_ARGUMENT);
    const Crowd no_hand = crowd_of(SWIVEL_COMPACT, 3);
    CHECK_REFUSED(swivel_read(no_hand.get(), SWIVEL_WRIST, 0, 0, 1, {&value, 16}), SWIVEL_INVALID_ARGUMENT);
}

TEST_CASE("frames take inputs, and refuse to take results out")
{
    Crowd crowd = crowd_of(SWIVEL_COMPACT, 50), expected = crowd_of(SWIVEL_COMPACT, 50);
    std::vector<Float3> targets(50);
    Random random{3};
    for (Float3& target : targets) target = floats(random.direction());
    Frame own;
    const swivel_frame frame = own.in(SWIVEL_TARGET, {targets.data(), sizeof targets[0]});
    expected.write(SWIVEL_TARGET, 0, targets);
    expected.solve();

    std::vector<Float4> values(50, Float4{9, 9, 9, 9});
    const Words fresh = words_of(crowd);
    for (const swivel_field output : {SWIVEL_SHOULDER, SWIVEL_ELBOW, SWIVEL_WRIST, SWIVEL_FLAGS}) {
        Frame with_output = own;
        const swivel_frame refused = with_output.out(output, {values.data(), sizeof values[0]});
        const auto before = all_words(crowd);
        CHECK_REFUSED(solve_frame(crowd.get(), &refused), SWIVEL_INVALID_ARGUMENT);
        CHECK_REFUSED(solve_frame_blocks(crowd.get(), &refused, 0, 1), SWIVEL_INVALID_ARGUMENT);
        CHECK(std::string(swivel_last_error()).find("SWIVEL_COMPACT") != std::string::npos);
        CHECK(all_words(crowd) == before);
        CHECK(words_of(crowd) == fresh);
    }
    CHECK(values == std::vector<Float4>(50, Float4{9, 9, 9, 9}));
    crowd.solve({.frames = {&frame, 1}});
    CHECK(words_of(crowd) == words_of(expected));
    Crowd by_blocks = crowd_of(SWIVEL_COMPACT, 50);
    for (const std::uint32_t block : {1u, 0u, 3u, 2u})
        by_blocks.solve({.blocks = swivel_blocks{block, 1}, .frames = {&frame, 1}, .on_this_thread = true});
    CHECK(words_of(by_blocks) == words_of(expected));
}
