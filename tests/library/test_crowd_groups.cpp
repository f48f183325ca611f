// SPDX-License-Identifier: MIT
//
// The promise: a group is of the kind of its definition, under the number that it has among them. Its features are
// those that were asked for, without what the library adds for itself.
#include <catch2/catch.hpp>

#include "tests/posed_bodies.h"
#include "tests/test_crowd.h"

using namespace swivel;
using namespace swivel::test;

namespace {

using H = HoldingBodies;

// Groups of every kind that bodies have; the look is the last.
struct EveryKind : HoldingBodies {
    const std::uint32_t head = add(look({0}));

    explicit EveryKind(Random& random) : HoldingBodies(random, 3, PoseLayout{}) {}
};

}  // namespace

TEST_CASE("a group is of the kind of its definition")
{
    Random random{2};
    const EveryKind bodies(random);
    const Crowd crowd = bodies.crowd(), free({limbs(20), limbs(3, SWIVEL_WITH_HAND)});
    REQUIRE(swivel_group_count(crowd.get()) == bodies.groups.size());
    for (std::uint32_t g = 0; g < bodies.groups.size(); ++g) {
        INFO("group " << g);
        const swivel_kind wanted = g == H::prop || g == H::handle ? SWIVEL_KIND_PROP
                                   : g == H::shift                ? SWIVEL_KIND_SHIFT
                                   : g == bodies.head             ? SWIVEL_KIND_LOOK
                                                                  : SWIVEL_KIND_BODY_LIMB;
        CHECK(swivel_group_kind(crowd.get(), g) == wanted);
        CHECK(swivel_group_limb_count(crowd.get(), g) == 3);
    }
    REQUIRE(swivel_group_count(free.get()) == 2);
    for (const std::uint32_t g : {0u, 1u}) CHECK(swivel_group_kind(free.get(), g) == SWIVEL_KIND_LIMB);
}

TEST_CASE("a group's features are those that were asked for, whatever the library adds")
{
    Random random{3};
    const EveryKind bodies(random);
    const Crowd crowd = bodies.crowd();
    for (std::uint32_t g = 0; g < bodies.groups.size(); ++g) {
        INFO("group " << g);
        CHECK(swivel_group_features(crowd.get(), g) == (bodies.is_limb(g) ? bodies.limb_def(g).features : 0));
    }
    // A limb that another holds has its transform, which nobody asked for.
    CHECK(!(swivel_group_features(crowd.get(), H::free) & SWIVEL_WITH_HAND_TRANSFORM));
    CHECK(swivel_field_row_count(crowd.get(), H::free, SWIVEL_HAND_TRANSFORM) == 7);

    for (const swivel_features features : every_plain_set()) {
        const Crowd free = crowd_of(features, 20, group_of(1).binding, features & SWIVEL_WITH_HAND ? 7 : 0);
        CHECK(swivel_group_features(free.get(), 0) == features);
        CHECK(swivel_field_row_count(free.get(), 0, SWIVEL_TWIST_BONES) == (features & SWIVEL_WITH_HAND ? 28 : 0));
    }
}

TEST_CASE("where there is no group, it is of no kind but the first and has no features")
{
    Random random{4};
    const Crowd crowd = EveryKind(random).crowd();
    for (const std::uint32_t past : {swivel_group_count(crowd.get()), ~0u}) {
        CHECK(swivel_group_kind(crowd.get(), past) == 0);
        CHECK(swivel_group_features(crowd.get(), past) == 0);
    }
    CHECK(swivel_group_count(nullptr) == 0);
    CHECK(swivel_group_kind(nullptr, 0) == 0);
    CHECK(swivel_group_features(nullptr, 0) == 0);
}
