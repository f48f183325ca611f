// SPDX-License-Identifier: MIT
//
// The promise: groups and fields lie in rows as swivel.h's table says, and data goes in and out whole.
#include <bit>
#include <map>
#include <random>

#include "tests/test_arm.h"
#include "tests/test_crowd.h"
#include "tests/test_random.h"

using namespace swivel;
using namespace swivel::test;

TEST_CASE("groups start blocks, fields are rows in the order of the table")
{
    const swivel_group_def groups[] = {group_of(1), group_of(16), group_of(17), group_of(40)};
    const std::uint32_t first_limbs[] = {0, 16, 32, 64};
    for (swivel_features features = 0; features < 16; ++features) {
        if ((features & SWIVEL_POLE_DIRECTION) && !(features & SWIVEL_WORLD)) continue;
        const Crowd crowd = crowd_with(features, groups);
        INFO("features " << features);
        CHECK(swivel_block_count(crowd.get()) == 7);
        for (std::uint32_t g = 0; g < 4; ++g) {
            CHECK(swivel_group_first_limb(crowd.get(), g) == first_limbs[g]);
            CHECK(swivel_group_limb_count(crowd.get(), g) == groups[g].limb_count);
        }
        const bool world = features & SWIVEL_WORLD, joints = features & SWIVEL_JOINTS,
                   hand = features & SWIVEL_WITH_HAND;
        std::map<swivel_field, std::uint32_t> sizes = {{SWIVEL_TARGET, 3},
                                                       {SWIVEL_POLE, 3},
                                                       {SWIVEL_LENGTHS, 2},
                                                       {SWIVEL_SHOULDER_POSITION, world ? 3u : 0u},
                                                       {SWIVEL_PARENT_ROTATION, world ? 4u : 0u},
                                                       {SWIVEL_PARENT_SCALE, world ? 1u : 0u},
                                                       {SWIVEL_HAND, hand ? 4u : 0u},
                                                       {SWIVEL_SHOULDER, 4},
                                                       {SWIVEL_ELBOW, joints ? 4u : 2u},
                                                       {SWIVEL_WRIST, hand ? 4u : 0u},
                                                       {SWIVEL_FLAGS, 1}};
        std::uint32_t row = 0;
        for (const swivel_field field : every_field()) {
            if (field == SWIVEL_SHOULDER) {
                CHECK(swivel_input_rows(crowd.get(), 0).row_count == row);
                row = 0;
            }
            CHECK(swivel_field_row_count(crowd.get(), 0, field) == sizes[field]);
            if (sizes[field]) CHECK(swivel_field_first_row(crowd.get(), 0, field) == row);
            row += sizes[field];
        }
        CHECK(swivel_result_rows(crowd.get(), 0).row_count == row);
        CHECK(swivel_result_rows(crowd.get(), 3).block_count == (groups[3].limb_count + 15) / 16);
        for (const swivel_rows rows : {swivel_input_rows(crowd.get(), 0), swivel_result_rows(crowd.get(), 0)})
            CHECK(reinterpret_cast<std::uintptr_t>(rows.base) % 64 == 0);
    }
}

TEST_CASE("a new crowd's inputs are what anybody would guess, and else bad")
{
    swivel_group_def groups[] = {group_of(20), group_of(5)};
    std::ranges::copy(Float2{0.3f, 0}, groups[1].binding.lengths);
    for (const bool joints : {false, true}) {
        const swivel_features features = SWIVEL_WORLD | SWIVEL_WITH_HAND | (joints ? SWIVEL_JOINTS : 0);
        const Crowd crowd = crowd_with(features, groups);
        for (const swivel_field field : {SWIVEL_TARGET, SWIVEL_SHOULDER_POSITION})
            for (const Float3& value : read<Float3>(crowd, field, 0))
                for (const float x : value) CHECK(std::isnan(x));
        CHECK(read<Float4>(crowd, SWIVEL_PARENT_ROTATION)[19] == Float4{0, 0, 0, 1});
        CHECK(read<Float1>(crowd, SWIVEL_PARENT_SCALE)[19] == Float1{1});
        CHECK(read<Float4>(crowd, SWIVEL_HAND)[19] == Float4{0, 0, 0, 1});
        for (const Float2& lengths : read<Float2>(crowd, SWIVEL_LENGTHS, 1)) {
            if (joints)
                CHECK(lengths == Float2{0.3f, 0});
            else
                CHECK((std::isnan(lengths[0]) && std::isnan(lengths[1])));
        }
    }
}

TEST_CASE("a limb that lacks its target, its shoulder's place or its lengths has bad input, and no other")
{
    const auto flags_without = [](swivel_field missing) {
        Crowd crowd = crowd_with(SWIVEL_WORLD, {group_of(20)});
        const auto give = [&](swivel_field field, auto value) {
            const std::vector values(field == missing ? 19 : 20, value);
            crowd.write(field, 0, values, 0);
        };
        give(SWIVEL_TARGET, Float3{0, 0.5f, 1});
        give(SWIVEL_SHOULDER_POSITION, Float3{0, 0, 0.2f});
        give(SWIVEL_LENGTHS, Float2{1, 1});
        crowd.solve();
        return read<std::uint32_t>(crowd, SWIVEL_FLAGS);
    };
    for (const swivel_field missing : {SWIVEL_TARGET, SWIVEL_SHOULDER_POSITION, SWIVEL_LENGTHS}) {
        const std::vector<std::uint32_t> flags = flags_without(missing);
        for (std::size_t n = 0; n < 19; ++n) CHECK(flags[n] == SWIVEL_REACHED);
        CHECK(flags[19] == SWIVEL_BAD_INPUT);
    }
    CHECK(flags_without(SWIVEL_HAND)[19] == SWIVEL_REACHED);
}

TEST_CASE("limbs that were never solved have the bits of bad input, but for its flag")
{
    const auto slant = [](float sign) {
        swivel_chain chain = swivel_default_chain();
        for (float(&q)[4] : {std::ref(chain.shoulder_rotation), std::ref(chain.elbow_rotation)})
            std::ranges::copy(Float4{0.2f * sign, 0.4f, -0.4f * sign, 0.8f}, q);
        std::ranges::copy(Float4{0.6f, 0, 0, -0.8f * sign}, chain.wrist_rotation);
        chain.elbow_offset[0] = chain.wrist_offset[0] = 0.3f * sign;
        chain.bend[2] = 1;
        return bind(chain);
    };
    const swivel_group_def groups[] = {swivel::group(33, slant(1), 0), swivel::group(7, slant(-1), 0)};
    constexpr swivel_features plain = SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND,
                              limb = SWIVEL_WITH_REACH | SWIVEL_WITH_MOST_SWIVEL | 3 * SWIVEL_WITH_TWIST_BONES |
                                     SWIVEL_WITH_CLAVICLE | SWIVEL_WITH_INCOMING;
    std::vector<swivel_features> sets = {plain | limb, SWIVEL_WORLD | SWIVEL_WITH_HAND | limb};
    for (swivel_features n = 0; n < 8; ++n) sets.push_back(n);
    for (const swivel_features features : sets) {
        INFO("features " << features);
        Crowd crowd = crowd_with(features, groups);
        std::vector<std::vector<float>> fresh;
        for (const bool solved : {false, true}) {
            if (solved) crowd.solve();
            for (std::uint32_t g = 0; g < 2; ++g)
                for (const swivel_field field : every_field()) {
                    if (field < SWIVEL_SHOULDER || field == SWIVEL_FLAGS) continue;
                    if (swivel_field_row_count(crowd.get(), 0, field) == 0) continue;
                    std::vector<float> values(groups[g].limb_count * 12);  // the longest has 3 twist bones
                    REQUIRE(swivel_read(crowd.get(), field, g, 0, groups[g].limb_count, {values.data(), 48}) ==
                            SWIVEL_OK);
                    fresh.push_back(values);
                }
            for (const std::uint32_t flags : read<std::uint32_t>(crowd, SWIVEL_FLAGS, 0))
                CHECK(flags == (solved ? std::uint32_t{SWIVEL_BAD_INPUT} : 0u));
        }
        for (std::size_t n = 0; n < fresh.size() / 2; ++n) CHECK(fresh[n] == fresh[n + fresh.size() / 2]);
        const Float4 shoulder = read<Float4>(crowd, SWIVEL_SHOULDER, 1)[6];
        const bool joints = features & SWIVEL_JOINTS;
        const Float4 rest = joints ? Float4{-0.2f, 0.4f, 0.4f, 0.8f} : Float4{0, 0, 0, 1};
        CHECK(distance(quat(shoulder), quat(rest)) <= 1e-6);
        if (features & SWIVEL_WITH_REACH) CHECK(read<Float1>(crowd, SWIVEL_STRETCH, 0)[32] == Float1{1});
        if (features & SWIVEL_WITH_MOST_SWIVEL) CHECK(read<Float3>(crowd, SWIVEL_NORMAL, 0)[32] == Float3{});
    }
}

TEST_CASE("streams of any stride and alignment land in the documented place, bit for bit")
{
    const swivel_group_def groups[] = {group_of(5), group_of(37)};
    // Every field there is: all features that go together.
    constexpr swivel_features others =
        SWIVEL_POLE_DIRECTION | SWIVEL_POLE_NORMAL | SWIVEL_POLE_INCOMING | SWIVEL_WITH_AIM;
    swivel_features every = 0;
    swivel_feature_info info;
    for (std::uint32_t n = 0; swivel_describe_feature(n, &info); ++n) every |= info.feature & ~others;
    Crowd most = crowd_with(every, groups), aiming = crowd_with(SWIVEL_WITH_AIM, groups);
    Random random{1};
    for (const swivel_field field : every_field()) {
        Crowd& crowd = field == SWIVEL_AIM ? aiming : most;
        const std::uint32_t rows_of_field = swivel_field_row_count(crowd.get(), 0, field), count = 30, first = 3;
        REQUIRE(rows_of_field > 0);
        const bool input = field < SWIVEL_SHOULDER;
        const std::size_t bytes = rows_of_field * sizeof(float);
        for (const std::size_t stride : {bytes, bytes + 1, bytes + 3, bytes + 4, bytes + 81}) {
            for (const std::size_t misaligned : {0u, 1u, 2u, 3u}) {
                INFO("field " << field << ", stride " << stride << ", from byte " << misaligned);
                const swivel_rows rows = input ? swivel_input_rows(crowd.get(), 1) : swivel_result_rows(crowd.get(), 1);
                const std::uint32_t row0 = swivel_field_first_row(crowd.get(), 1, field);
                const auto place = [&](std::uint32_t n, std::uint32_t c) {
                    const std::uint32_t limb = first + n;
                    return rows.base + (std::size_t{limb / 16} * rows.row_count + row0 + c) * 16 + limb % 16;
                };
                std::vector<unsigned char> data(misaligned + stride * count), got(data.size(), 0xee);
                for (unsigned char& byte : data) byte = static_cast<unsigned char>(random.word());
                if (input) {
                    const auto before = all_words(crowd);
                    REQUIRE(swivel_write(crowd.get(), field, 1, first, count, {data.data() + misaligned, stride}) ==
                            SWIVEL_OK);
                    for (std::uint32_t n = 0; n < count; ++n)
                        for (std::uint32_t c = 0; c < rows_of_field; ++c)
                            CHECK(std::memcmp(place(n, c), data.data() + misaligned + n * stride + c * 4, 4) == 0);
                    const auto after = all_words(crowd);
                    std::size_t changed = 0;
                    for (std::size_t n = 0; n < after.size(); ++n) changed += after[n] != before[n];
                    CHECK(changed <= std::size_t{count} * rows_of_field);
                } else {
                    for (std::uint32_t n = 0; n < count; ++n)
                        for (std::uint32_t c = 0; c < rows_of_field; ++c)
                            std::memcpy(place(n, c), data.data() + misaligned + n * stride + c * 4, 4);
                }
                REQUIRE(swivel_read(crowd.get(), field, 1, first, count, {got.data() + misaligned, stride}) ==
                        SWIVEL_OK);
                for (std::size_t n = 0; n < got.size(); ++n) {
                    const bool value = n >= misaligned && (n - misaligned) % stride < bytes;
                    REQUIRE(got[n] == (value ? data[n] : 0xee));
                }
            }
        }
        if (!input) continue;
        const float one[4] = {1.5f, -0.0f, kNan, 4};
        REQUIRE(swivel_write(crowd.get(), field, 1, first, count, {one, 0}) == SWIVEL_OK);
        std::vector<float> all(count * rows_of_field);
        REQUIRE(swivel_read(crowd.get(), field, 1, first, count, {all.data(), bytes}) == SWIVEL_OK);
        for (std::uint32_t n = 0; n < count; ++n) CHECK(std::memcmp(all.data() + n * rows_of_field, one, bytes) == 0);
    }
}

namespace {

// swivel_digest() as the header describes it, by limbs and their values: floats and words of rows by swivel.h's layout.
std::uint64_t described_digest(const Crowd& crowd)
{
    std::uint64_t hashes[SWIVEL_LANES] = {}, whole = 0;
    const auto step = [](std::uint64_t& hash, std::uint64_t number) {
        const std::uint64_t product = (hash ^ number) * 0x9e3779b97f4a7c15u;
        hash = product ^ product >> 32;
    };
    for (std::uint32_t g = 0; g < swivel_group_count(crowd.get()); ++g) {
        const swivel_rows floats = swivel_result_rows(crowd.get(), g);
        const std::uint32_t row_count = floats.row_count;
        for (std::uint32_t n = 0; n < swivel_group_limb_count(crowd.get(), g); ++n)
            for (std::uint32_t row = 0; row < row_count; ++row) {
                const std::size_t at = (std::size_t{n / 16} * row_count + row) * 16 + n % 16;
                step(hashes[n % 16], std::bit_cast<std::uint32_t>(floats.base[at]));
            }
    }
    for (const std::uint64_t hash : hashes) step(whole, hash);
    return whole;
}

}  // namespace

TEST_CASE("the digest is that of the results, and of nothing else")
{
    const std::uint32_t counts[] = {1, 16, 37};
    for (const swivel_features features : {swivel_features{0}, SWIVEL_JOINTS | SWIVEL_WITH_HAND}) {
        INFO("features " << features);
        std::vector<swivel_group_def> groups;
        for (const std::uint32_t count : counts) groups.push_back(group_of(count));
        Crowd crowd = crowd_with(features, groups);
        Random random{7};
        for (std::uint32_t g = 0; g < 3; ++g) {
            std::vector<Float3> targets(counts[g]);
            for (Float3& target : targets)
                for (float& x : target) x = static_cast<float>(random.between(-1, 1));
            crowd.write(SWIVEL_TARGET, g, targets);
            crowd.write_all(SWIVEL_LENGTHS, g, Float2{1, 0.75f});
        }
        const std::uint64_t at_rest = crowd.digest();
        CHECK(at_rest == described_digest(crowd));
        crowd.solve();
        const std::uint64_t solved = crowd.digest();
        CHECK(solved == described_digest(crowd));
        CHECK(solved != at_rest);

        // Inputs do not count, padding does not, every limb does.
        crowd.write_all(SWIVEL_TARGET, 0, Float3{0.5f, 0.5f, 0.5f});
        CHECK(crowd.digest() == solved);
        const auto change = [&](std::uint32_t g, std::uint32_t limb, std::uint32_t row) {
            const swivel_rows floats = swivel_result_rows(crowd.get(), g);
            const std::uint32_t row_count = floats.row_count;
            const std::size_t at = (std::size_t{limb / 16} * row_count + row) * 16 + limb % 16;
            floats.base[at] = -floats.base[at];
        };
        change(0, 1, 0);   // padding of the first group
        change(2, 37, 0);  // and of the last
        CHECK(crowd.digest() == solved);
        for (std::uint32_t g = 0; g < 3; ++g)
            for (std::uint32_t n = 0; n < counts[g]; ++n)
                for (const std::uint32_t row : {0u, 3u}) {
                    change(g, n, row);
                    CHECK(crowd.digest() != solved);
                    change(g, n, row);
                }
        CHECK(crowd.digest() == solved);
    }
    CHECK(swivel_digest(nullptr) == 0);
}

namespace {

// Bits of a crowd's results, all limbs' and no padding's: of float n, counted in memory, bit b has the number 32 n + b.
struct ResultBits {
    explicit ResultBits(const Crowd& crowd) : floats(swivel_result_rows(crowd.get(), 0).base)
    {
        const std::uint32_t row_count = swivel_result_rows(crowd.get(), 0).row_count;
        for (std::uint32_t limb = 0; limb < swivel_group_limb_count(crowd.get(), 0); ++limb)
            for (std::uint32_t row = 0; row < row_count; ++row)
                for (std::uint32_t bit = 0; bit < 32; ++bit)
                    bits.push_back(((limb / 16 * row_count + row) * 16 + limb % 16) * 32 + bit);
    }
    void flip(std::size_t which) const
    {
        float& number = floats[bits[which] / 32];
        number = std::bit_cast<float>(std::bit_cast<std::uint32_t>(number) ^ 1u << bits[which] % 32);
    }
    std::size_t size() const { return bits.size(); }

    float* floats;
    std::vector<std::uint32_t> bits;
};

}  // namespace

TEST_CASE("the digest notices every flip of one, two or three bits")
{
    Crowd crowd = crowd_with(0, {group(17)});  // two limbs share a lane, the others have lanes of their own
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0.3f, 0.9f, 0.8f});
    crowd.write_all(SWIVEL_LENGTHS, 0, Float2{1, 0.75f});
    crowd.solve();
    const std::uint64_t solved = crowd.digest();
    const ResultBits bits(crowd);
    std::uint64_t unnoticed = 0, tried = 0;
    const auto look = [&] {
        unnoticed += crowd.digest() == solved;
        ++tried;
    };
    for (std::size_t a = 0; a < bits.size(); ++a) {
        bits.flip(a);
        look();
        CHECK(static_cast<std::uint32_t>(crowd.digest()) != static_cast<std::uint32_t>(solved));
        for (std::size_t b = 0; b < a; ++b) {
            bits.flip(b);
            look();
            bits.flip(b);
        }
        bits.flip(a);
    }
    std::mt19937_64 random(7);
    while (tried < 10'000'000) {
        const std::size_t three[] = {random() % bits.size(), random() % bits.size(), random() % bits.size()};
        if (three[0] == three[1] || three[0] == three[2] || three[1] == three[2]) continue;
        for (const std::size_t bit : three) bits.flip(bit);
        look();
        for (const std::size_t bit : three) bits.flip(bit);
    }
    CHECK(unnoticed == 0);
    CHECK(crowd.digest() == solved);
}

TEST_CASE("each half of the digest notices that quaternions are negated")
{
    Crowd crowd = crowd_with(SWIVEL_JOINTS | SWIVEL_WITH_HAND, {group_of(40)});
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0.3f, 0.9f, 0.8f});
    crowd.solve();
    const std::uint64_t solved = crowd.digest();
    const swivel_rows rows = swivel_result_rows(crowd.get(), 0);
    for (std::uint32_t limb = 0; limb < 40; ++limb)
        for (const swivel_field field : {SWIVEL_SHOULDER, SWIVEL_ELBOW, SWIVEL_WRIST}) {
            const std::uint32_t first = swivel_field_first_row(crowd.get(), 0, field);
            for (std::uint32_t row = first; row < first + 4; ++row) {
                float& number = rows.base[(limb / 16 * rows.row_count + row) * 16 + limb % 16];
                number = -number;
            }
            const std::uint64_t changed = crowd.digest() ^ solved;
            CHECK((changed & 0xffffffffu) != 0);
            CHECK((changed >> 32) != 0);
        }
}
