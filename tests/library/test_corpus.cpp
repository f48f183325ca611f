// SPDX-License-Identifier: MIT
//
// The promise: the corpus is what it says. Whole limbs have every flag of theirs, and so have bodies; those that stand
// have the others. Every feature is in a crowd, and alone in one if free limbs may have it. Names and seeds are unique,
// and golden.h has each crowd once.
#include "tools/corpus/corpus.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "tools/corpus/golden.h"
#include "tools/corpus/interface.h"

namespace {

using namespace swivel;
using namespace swivel::corpus;

// All flags that a part's limbs get; of those that stand, in the first frames.
std::uint32_t flags_of(Part part)
{
    std::uint32_t flags = 0;
    for (const Recipe& recipe : recipes_of(part)) {
        const auto look = [&](Crowd& crowd, const Job& job) {
            crowd.solve(job);
            for (std::uint32_t group = 0; group < swivel_group_count(crowd.get()); ++group) {
                std::vector<std::uint32_t> words(swivel_group_limb_count(crowd.get(), group));
                const swivel_out out{words.data(), sizeof words[0]};
                check(swivel_read(crowd.get(), SWIVEL_FLAGS, group, 0, static_cast<std::uint32_t>(words.size()), out));
                for (const std::uint32_t word : words) flags |= word;
            }
        };
        if (part == Part::standing)
            standing_digest(recipe, look, own_limb_count(part), share_of(recipe, kStandingStart));
        else
            digest_of(recipe, look);
    }
    return flags;
}

std::uint32_t every_flag()
{
    std::uint32_t flags = 0;
    for (std::uint32_t flag = 1; flag != 0; flag <<= 1)
        if (swivel_flag_name(flag)) flags |= flag;
    return flags;
}

}  // namespace

TEST_CASE("ordinary arms are reached, too far and too near; limbs, bodies and those that stand have every flag")
{
    constexpr std::uint32_t reach = SWIVEL_REACHED | SWIVEL_CLAMPED_FAR | SWIVEL_CLAMPED_NEAR,
                            plants = SWIVEL_PLANTED | SWIVEL_RELEASED | SWIVEL_BROKE_AWAY | SWIVEL_CUT,
                            looks = SWIVEL_LIMITED_LOOK | SWIVEL_FADED;
    CHECK(flags_of(Part::ordinary) == reach);
    CHECK(flags_of(Part::hard) == (reach | SWIVEL_SWIVEL_UNDEFINED | SWIVEL_BAD_INPUT));
    CHECK(flags_of(Part::limbs) == (every_flag() & ~plants & ~looks));
    CHECK(flags_of(Part::bodies) == (every_flag() & ~plants & ~looks));
    constexpr std::uint32_t stand = reach | plants | looks | SWIVEL_LIMITED_STEP | SWIVEL_LIMITED_FLEXION |
                                    SWIVEL_SOFTENED | SWIVEL_STRETCHED | SWIVEL_BAD_INPUT;
    CHECK(flags_of(Part::standing) == stand);
}

TEST_CASE("every feature is in a crowd, and if free limbs may have it, in one of only what it needs")
{
    const auto needs_of = [](swivel_features features) {
        swivel_features needs = 0;
        swivel_feature_info info;
        for (std::uint32_t n = 0; swivel_describe_feature(n, &info); ++n)
            if (features & info.feature) needs |= info.needs;
        return needs;
    };
    swivel_feature_info info;
    for (std::uint32_t n = 0; swivel_describe_feature(n, &info); ++n) {
        bool is_somewhere = false, is_alone = false;
        for (const Part part : kParts)
            for (const Recipe& recipe : recipes_of(part)) {
                if (!((recipe.features | recipe.holding) & info.feature)) continue;
                is_somewhere = true;
                const bool has_more = recipe.features != (needs_of(recipe.features) | info.feature);
                if (part == Part::limbs && !has_more) is_alone = true;
            }
        INFO(info.name);
        CHECK(is_somewhere);
        CHECK(is_alone == ((info.kinds >> SWIVEL_KIND_LIMB & 1) != 0));
    }
}

TEST_CASE("limbs have the same numbers in crowds of any size")
{
    for (const Part part : kParts) {
        const Recipe& recipe = recipes_of(part).back();
        const Crowd small = make_crowd(recipe, 70), large = make_crowd(recipe, 200);
        for (const swivel_field field : inputs_of(small)) {
            const std::vector<std::uint32_t> few = read_field(small, recipe, field, 0),
                                             many = read_field(large, recipe, field, 0);
            CHECK(std::equal(few.begin(), few.end(), many.begin()));
        }
    }
}

TEST_CASE("names and seeds are unique, and golden.h has each crowd once and their digests folded")
{
    std::set<std::string> names;
    std::set<std::uint64_t> seeds;
    std::size_t count = 0;
    for (const Part part : kParts) {
        const auto place = static_cast<std::size_t>(part);
        INFO(name_of(part));
        CHECK(kGoldenCrowds[place].size() == recipes_of(part).size());
        CHECK(fold({kGoldenCrowds[place].begin(), kGoldenCrowds[place].end()}) == kGoldenDigests[place]);
        for (const Recipe& recipe : recipes_of(part)) {
            names.insert(full_name(recipe));
            seeds.insert(recipe.seed);
            ++count;
        }
    }
    CHECK(names.size() == count);
    CHECK(seeds.size() == count);
}

TEST_CASE("a digest that is not golden is told by its crowd's name")
{
    std::vector<std::uint64_t> digests =
        digests_of(Part::ordinary, [](Crowd& crowd, const Job& job) { crowd.solve(job); });
    CHECK(wrong_crowds(Part::ordinary, digests).empty());
    digests[2] ^= 1;
    CHECK(wrong_crowds(Part::ordinary, digests) == std::vector{full_name(recipes_of(Part::ordinary)[2])});
}
