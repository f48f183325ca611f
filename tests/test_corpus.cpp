// SPDX-License-Identifier: MIT
//
// The promise: the corpus is what it says. Every ordinary arm passes the plain formula's own test. Hard and whole limbs
// together have every flag. Names and seeds are unique, and golden.h has each crowd once.
#include "tools/corpus/corpus.h"

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <set>

#include "core/solve_arm.h"
#include "core/space.h"
#include "tools/corpus/bindings.h"
#include "tools/corpus/golden.h"
#include "tools/corpus/interface.h"

namespace {

using namespace swivel;
using namespace swivel::corpus;

template <std::size_t N>
std::vector<std::array<float, N>> values_of(const Crowd& crowd, const Recipe& recipe, Field field, std::uint32_t group)
{
    if (std::ranges::find(recipe.inputs, field) == recipe.inputs.end()) return {};
    const std::uint32_t count = swivel_group_limb_count(crowd.get(), group);
    const std::vector<std::uint32_t> words = read_field(crowd, recipe, field, group);
    std::vector<std::array<float, N>> values(count);
    for (std::size_t n = 0; n < words.size(); ++n) values[n / N][n % N] = std::bit_cast<float>(words[n]);
    return values;
}

Vector<float> vector_of(const std::array<float, 3>& v) { return swivel::vector(v[0], v[1], v[2]); }
Rotor<float> rotor_of(const std::array<float, 4>& q) { return rotor(q[0], q[1], q[2], q[3]); }
Rotor<float> rotor_of(const Quaternion& q) { return rotor(q.x, q.y, q.z, q.w); }

// The inputs of a group on which it depends whether the plain formula holds.
struct Inputs {
    std::vector<std::array<float, 3>> targets, poles, positions;
    std::vector<std::array<float, 2>> lengths;
    std::vector<std::array<float, 4>> rotations, hands;
    std::vector<std::array<float, 1>> scales;

    Inputs(const Crowd& crowd, const Recipe& recipe, std::uint32_t group)
        : targets(values_of<3>(crowd, recipe, Field::target, group)),
          poles(values_of<3>(crowd, recipe, Field::pole, group)),
          positions(values_of<3>(crowd, recipe, Field::parent_position, group)),
          lengths(values_of<2>(crowd, recipe, Field::lengths, group)),
          rotations(values_of<4>(crowd, recipe, Field::parent_rotation, group)),
          hands(values_of<4>(crowd, recipe, Field::hand, group)),
          scales(values_of<1>(crowd, recipe, Field::parent_scale, group))
    {
    }
};

// Whether the plain formula holds for the limb, by the tests of solve_step() (simd/arm_kernels.cpp).
bool is_plain(const Inputs& inputs, swivel_features features, std::uint32_t group, std::size_t n)
{
    ArmGoal<float> goal{vector_of(inputs.targets[n]), vector_of(inputs.poles[n]), inputs.lengths[n][0],
                        inputs.lengths[n][1]};
    Rotor<float> hand = rotor(0.0f, 0.0f, 0.0f, 1.0f);
    bool plain = true;
    if (features & kHand) {
        hand = rotor_of(inputs.hands[n]);
        plain = is_orientation(hand);
    }
    if (features & kWorld) {
        const ParentFrame<float> parent{vector_of(inputs.positions[n]), rotor_of(inputs.rotations[n]),
                                        inputs.scales[n][0]};
        const SeenGoal<float> seen = seen_by(parent, goal.wrist, goal.pole, features & kPoleDirection ? 0.0f : 1.0f);
        plain = plain && is_ordinary(parent, seen);
        goal = {seen.wrist, seen.pole, seen.size * goal.upper, seen.size * goal.fore};
        hand = ~parent.rotation * hand;
    }
    const PlainArm<float> arm = solve_plain(goal);
    const swivel::corpus::Binding& own = kBindings[group];
    Rotor<float> shoulder = arm.pose.shoulder, wrist = wrist_rotor(arm.pose, hand);
    if (features & kJoints) {
        shoulder = shoulder * ~rotor_of(own.upper_from_arm);
        if (!(features & kWorld)) shoulder = rotor_of(own.parent_from_arm) * shoulder;
        wrist = rotor_of(own.fore_from_arm) * wrist;
    }
    const auto has_side = [](const Rotor<float>& q) { return std::fabs(q.at<kScalar>()) > 0; };
    return arm.holds && plain && has_side(shoulder) && (!(features & kHand) || has_side(wrist));
}

// All flags that a part's limbs get.
std::uint32_t flags_of(Part part)
{
    std::uint32_t flags = 0;
    for (const Recipe& recipe : recipes_of(part))
        digest_of(recipe, [&](Crowd& crowd) {
            crowd.solve();
            for (std::uint32_t group = 0; group < kGroupCount; ++group) {
                for (const std::uint32_t word : read_field(crowd, recipe, Field::flags, group)) flags |= word;
            }
        });
    return flags;
}

}  // namespace

TEST_CASE("every ordinary arm passes the plain formula's own test")
{
    for (const Recipe& recipe : recipes_of(Part::ordinary)) {
        const Crowd crowd = make_crowd(recipe, own_limb_count(recipe.part));
        for (std::uint32_t group = 0; group < kGroupCount; ++group) {
            const Inputs inputs(crowd, recipe, group);
            std::size_t plain = 0;
            for (std::size_t n = 0; n < inputs.targets.size(); ++n)
                plain += is_plain(inputs, recipe.features, group, n);
            INFO(recipe.name << ", group " << group);
            CHECK(plain == inputs.targets.size());
        }
    }
}

TEST_CASE(
    "in hard crowds the middle one of three runs is of arms that pass that test, and the others have arms that do not")
{
    for (const Recipe& recipe : recipes_of(Part::hard)) {
        const Crowd crowd = make_crowd(recipe, own_limb_count(recipe.part));
        const Inputs inputs(crowd, recipe, 0);
        for (std::size_t run = 0; run + 64 <= inputs.targets.size(); run += 64) {
            std::size_t plain = 0;
            for (std::size_t n = run; n < run + 64; ++n) plain += is_plain(inputs, recipe.features, 0, n);
            INFO(recipe.name << ", limbs from " << run << " on");
            if (run / 64 % 3 == 1)
                CHECK(plain == 64);
            else
                CHECK(plain < 60);
        }
    }
}

TEST_CASE("ordinary arms are reached, too far and too near; hard ones and whole limbs have every flag")
{
    constexpr std::uint32_t reach = kReached | kClampedFar | kClampedNear;
    CHECK(flags_of(Part::ordinary) == reach);
    CHECK(flags_of(Part::hard) == (reach | kSwivelUndefined | kBadInput));
    CHECK(flags_of(Part::limbs) == kEveryFlag);
}

TEST_CASE("limbs have the same numbers in crowds of any size")
{
    for (const Part part : kParts) {
        const Recipe& recipe = recipes_of(part).back();
        const Crowd small = make_crowd(recipe, 70), large = make_crowd(recipe, 200);
        for (const Field field : recipe.inputs) {
            if (field == Field::none) continue;
            const std::vector<std::uint32_t> few = read_field(small, recipe, field, 0),
                                             many = read_field(large, recipe, field, 0);
            CHECK(std::equal(few.begin(), few.end(), many.begin()));
        }
    }
}

TEST_CASE("goals change from frame to frame, and nothing else does")
{
    const Recipe& recipe = recipe_of(Part::limbs, "set-all-limits");
    Crowd crowd = make_crowd(recipe, 100);
    const Crowd before = make_crowd(recipe, 100);
    write_goals(crowd, recipe, 1);
    for (const Field field : recipe.inputs) {
        if (field == Field::none) continue;
        const bool changes = read_field(crowd, recipe, field, 0) != read_field(before, recipe, field, 0);
        CHECK(changes == (field == Field::target || field == Field::pole));
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

TEST_CASE("a crowd whose lists leave out an input or a result is refused")
{
    Recipe recipe = recipe_of(Part::ordinary, "world-joints-hand");
    CHECK_NOTHROW(make_crowd(recipe, 3));
    Recipe fewer = recipe;
    std::ranges::replace(fewer.inputs, Field::parent_scale, Field::none);
    CHECK_THROWS_AS(make_crowd(fewer, 3), std::logic_error);
    fewer = recipe;
    std::ranges::replace(fewer.results, Field::wrist, Field::none);
    CHECK_THROWS_AS(make_crowd(fewer, 3), std::logic_error);
}

TEST_CASE("a digest that is not golden is told by its crowd's name")
{
    std::vector<std::uint64_t> digests = digests_of(Part::ordinary, [](Crowd& crowd) { crowd.solve(); });
    CHECK(wrong_crowds(Part::ordinary, digests).empty());
    digests[2] ^= 1;
    CHECK(wrong_crowds(Part::ordinary, digests) == std::vector{full_name(recipes_of(Part::ordinary)[2])});
}
