// SPDX-License-Identifier: MIT
//
// The promise: groups and fields lie in rows as swivel.h's table says. The test `interface` has streams into and out of
// them.
#include <bit>

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
        std::uint32_t row = 0;
        for (const swivel_field field : every_field()) {
            if (field == SWIVEL_SHOULDER) {
                CHECK(swivel_input_rows(crowd.get(), 0).row_count == row);
                row = 0;
            }
            const std::uint32_t size = swivel_component_count(field, features);
            CHECK(swivel_field_row_count(crowd.get(), 0, field) == size);
            if (size) CHECK(swivel_field_first_row(crowd.get(), 0, field) == row);
            row += size;
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

namespace {

// swivel_digest() as the header describes it, by limbs and their values: floats of rows by swivel.h's layout.
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
        CHECK(crowd.digest() == described_digest(crowd));
        for (int n = 0; n < 20; ++n) {
            for (std::uint32_t g = 0; g < 3; ++g) {
                std::vector<Float3> targets(counts[g]);
                for (Float3& target : targets) target = floats(random.vector(0, 2));
                crowd.write(SWIVEL_TARGET, g, targets);
                crowd.write_all(SWIVEL_LENGTHS, g, Float2{1, 0.75f});
            }
            const std::uint64_t before = crowd.digest();
            crowd.solve();
            CHECK(crowd.digest() == described_digest(crowd));
            CHECK(crowd.digest() != before);
        }
    }
    CHECK(swivel_digest(nullptr) == 0);
}
