// SPDX-License-Identifier: MIT
//
// The promise: the corpus is what it says. Whole limbs have every flag of theirs, and so have bodies; those that stand
// have the others. Names and seeds are unique, and golden.h has each crowd once.
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
                for (const std::uint32_t word : read_field(crowd, recipe, Field::flags, group)) flags |= word;
            }
        };
        if (part == Part::standing)
            standing_digest(recipe, look, own_limb_count(part), share_of(recipe, kStandingStart));
        else
            digest_of(recipe, look);
    }
    return flags;
}

}  // namespace

TEST_CASE("ordinary arms are reached, too far and too near; limbs, bodies and those that stand have every flag")
{
    constexpr std::uint32_t reach = kReached | kClampedFar | kClampedNear;
    CHECK(flags_of(Part::ordinary) == reach);
    CHECK(flags_of(Part::hard) == (reach | kSwivelUndefined | kBadInput));
    CHECK(flags_of(Part::limbs) == (kEveryFlag & ~kPlantFlags & ~kLookFlags));
    CHECK(flags_of(Part::bodies) == (kEveryFlag & ~kPlantFlags & ~kLookFlags));
    constexpr std::uint32_t stand =
        reach | kPlantFlags | kLookFlags | kLimitedStep | kSoftened | kStretched | kBadInput;
    CHECK(flags_of(Part::standing) == stand);
}

TEST_CASE("limbs have the same numbers in crowds of any size")
{
    for (const Part part : kParts) {
        const Recipe& recipe = recipes_of(part).back();
        const Crowd small = make_crowd(recipe, 70), large = make_crowd(recipe, 200);
        for (const Field field : inputs_of(recipe)) {
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
        std::uint64_t hash = kDigestStart;
        for (const Recipe& recipe : recipes_of(part)) {
            names.insert(full_name(recipe));
            seeds.insert(recipe.seed);
            ++count;
            const auto is_it = [&](const GoldenCrowd& g) {
                return g.part == part && g.name == std::string(recipe.name);
            };
            INFO(full_name(recipe));
            CHECK(std::ranges::count_if(kGoldenCrowds, is_it) == 1);
            hash = fold(hash, std::ranges::find_if(kGoldenCrowds, is_it)->digest);
        }
        INFO(name_of(part));
        CHECK(hash == kGoldenDigests[static_cast<std::size_t>(part)]);
    }
    CHECK(names.size() == count);
    CHECK(seeds.size() == count);
    CHECK(std::size(kGoldenCrowds) == count);
}

TEST_CASE("a digest that is not golden is told by its crowd's name")
{
    std::vector<std::uint64_t> digests =
        digests_of(Part::ordinary, [](Crowd& crowd, const Job& job) { crowd.solve(job); });
    CHECK(wrong_crowds(Part::ordinary, digests).empty());
    digests[2] ^= 1;
    CHECK(wrong_crowds(Part::ordinary, digests) == std::vector{full_name(recipes_of(Part::ordinary)[2])});
}
