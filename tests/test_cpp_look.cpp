// SPDX-License-Identifier: MIT
//
// The promise: look_group() makes looks as C has them, and all calls of C++ take their fields.
#include <catch2/catch.hpp>

#include "tests/upright_bodies.h"

using namespace swivel;
using namespace swivel::test;

namespace {

constexpr std::uint32_t kCount = 20;

struct Case {
    Crowd crowd;
    std::vector<std::array<Float4, 4>> rotations{kCount, {{{0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}}}};

    explicit Case(const swivel_group_def& look) : crowd(Upright().skeleton.view(), kCount, std::span(&look, 1)) {}
    std::uint64_t digest()
    {
        std::vector<Float3> targets;
        for (std::uint32_t n = 0; n < kCount; ++n) targets.push_back({static_cast<float>(n) - 10, 1.6f, 3});
        crowd.write(SWIVEL_LOOK_TARGET, 0, targets);
        swivel_pose pose = swivel_default_pose();
        pose.rotations = {rotations.data(), sizeof rotations[0], sizeof(Float4), nullptr};
        CHECK(crowd.solve({.pose = &pose}) == kCount);
        return crowd.digest();
    }
};

}  // namespace

TEST_CASE("a crowd of look_group() has the bits of one of C's")
{
    const Upright of;
    const std::uint32_t joints[] = {0, 1, 2, 3};
    const std::uint64_t digest = Case(of.look).digest();
    CHECK(Case(look_group({0, 1, 2, 3}, of.look.look)).digest() == digest);
    CHECK(Case(look_group(joints, of.look.look)).digest() == digest);
    CHECK(Case(look_group({0, 2, 3}, of.look.look)).digest() != digest);
}

TEST_CASE("look_group() alone has the constants of C's defaults, and too many joints are refused")
{
    swivel_group_def in_c = swivel_default_look_group_def();
    in_c.look.joint_count = 1, in_c.look.joints[0] = 3, in_c.look.rate = 0;
    swivel_group_def def = look_group({3});
    CHECK(def.on_bad_input == SWIVEL_KEEP_POSE);
    CHECK(def.look.rate == 6);
    def.look.rate = 0;
    CHECK(Case(def).digest() == Case(in_c).digest());
    CHECK_THROWS_WITH(Case(look_group({0, 1, 2, 3, 4, 5, 6, 7, 8})),
                      Catch::Contains("look.joint_count is 9; it is 1 to 8"));
}

TEST_CASE("results of a look are read as values of any type, and so are fields of every other kind of group")
{
    const Upright of;
    Case looking(of.look);
    looking.digest();
    std::vector<Float6> sights(kCount);
    looking.crowd.read(SWIVEL_SIGHT, 0, std::span(sights));
    for (const Float6& sight : sights) CHECK(std::fabs(Vector3d(sight[3], sight[4], sight[5]).norm() - 1) <= 1e-6);
    CHECK(component_count(SWIVEL_SIGHT) == 6);
    CHECK(component_count(SWIVEL_SHOULDER_BOX) == 12);
    CHECK(component_count(SWIVEL_PROP_FRAME) == 7);
    CHECK(component_count(SWIVEL_SHIFT) == 3);
}
