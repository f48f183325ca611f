// SPDX-License-Identifier: MIT
//
// The promise: bad input of a look touches nothing but its flags, and a look that cannot be is refused in one line.
#include <catch2/catch.hpp>

#include <string>

#include "tests/upright_bodies.h"

using namespace swivel;
using namespace swivel::test;

TEST_CASE("bad input of a look keeps its joints, and is that of no other body")
{
    const bool keeps = GENERATE(false, true);
    Upright of;
    of.look.look.rate = 2;
    of.look.on_bad_input = keeps ? SWIVEL_KEEP_POSE : SWIVEL_REST_POSE;
    UprightCrowd good(of, 20), bodies(of, 20);
    std::vector<Float3> targets(20, Float3{1, 1.6f, 2});
    for (UprightCrowd* each : {&good, &bodies}) each->solve(targets, 0.1f), each->reset();
    const Vector3d sight = bodies.line(7);
    std::array<float, 25> line{}, kept{};
    check(swivel_read(bodies.crowd.get(), SWIVEL_LOOK_TURNS, 0, 7, 1, {&line, sizeof line}));
    good.solve(targets, 0.1f);
    targets[7] = {0, 1e16f, 0};
    SECTION("a target")
    {
        bodies.solve(targets, 0.1f);
        CHECK((bodies.rotations[7][3] == Float4{0, 0, 0, 1}));
    }
    SECTION("a weight")
    {
        targets[7] = {1, 1.6f, 2};
        bodies.crowd.write(SWIVEL_LOOK_WEIGHT, 0, std::vector<float>{1.5f}, 7);
        bodies.solve(targets, 0.1f);
        CHECK((bodies.rotations[7][3] == Float4{0, 0, 0, 1}));
    }
    SECTION("a pose")
    {
        targets[7] = {1, 1.6f, 2};
        bodies.rotations[7][1][0] = kNan;
        bodies.solve(targets, 0.1f);
        CHECK((bodies.rotations[7][3] == Float4{0, 0, 0, 1}));
    }
    CHECK(bodies.flags(7) == SWIVEL_BAD_INPUT);
    CHECK((bodies.line(7) == sight));
    check(swivel_read(bodies.crowd.get(), SWIVEL_LOOK_TURNS, 0, 7, 1, {&kept, sizeof kept}));
    CHECK((kept == (keeps ? line : std::array<float, 25>{})));
    for (std::size_t n = 0; n < 20; ++n)
        if (n != 7) CHECK((bodies.rotations[n] == good.rotations[n]));
}

TEST_CASE("a look that cannot be is refused in one line")
{
    Upright of;
    const auto refused = [&](const std::string& words) {
        try {
            Crowd(of.skeleton.view(), 1, std::span(&of.look, 1));
        } catch (const std::exception& e) {
            INFO(e.what());
            CHECK(std::string(e.what()).find(words) != std::string::npos);
            return;
        }
        FAIL("not refused: " << words);
    };
    swivel_look& look = of.look.look;
    const swivel_look good = look;
    const auto with = [&](const auto& change, const std::string& words) {
        look = good;
        change();
        refused(words);
    };
    with([&] { look.joint_count = 0; }, "look.joint_count is 0; it is 1 to 8");
    with([&] { look.joint_count = 9; }, "look.joint_count is 9; it is 1 to 8");
    with([&] { look.joints[2] = 4; }, "look.joints[2] is 4; the skeleton has 4 joints");
    with([&] { look.joints[1] = 0; }, "look.joints[1], joint 0, is not below the one before, joint 0");
    with([&] { look.joints[1] = 3; }, "look.joints[2], joint 2, is not below the one before, joint 3");
    with([&] { look.share[1] = -1; }, "look.share[1] is -1; it is 0 to 1000");
    with([&] { look.share[3] = 0; }, "look.share of the last joint is 0; let it be more");
    with([&] { look.cos_most[1] = kNan; }, "look.cos_most[1] is nan; it is -1 to 1");
    with([&] { look.axis[2] = 0; }, "look.axis is 0, 0, 0; give an axis");
    with([&] { look.eye[2] = 1e16f; }, "look.eye is 0, 0.08, 1e+16; give a place");
    with([&] { look.cos_none = -0.1f; },
         "look.cos_full is -0.1, look.cos_none -0.1; they are -1 to 1, and cos_full is 0.001 more");
    with([&] { look.fade_distance = -1; }, "look.fade_distance is -1; it is 0 to");
    with([&] { look.rate = -1; }, "look.rate is -1; it is 0 to 1000");
    look = good;
    const swivel_group_def twice[] = {of.look, of.look};
    CHECK_THROWS_WITH(Crowd(of.skeleton.view(), 1, twice),
                      Catch::Contains("group 0 turns joint 0, which is also joint 0 of group 1"));
    swivel_group_def lower = of.look, upper = of.look;
    lower.look.joint_count = 1, lower.look.joints[0] = 3, upper.look.joint_count = 2;
    const swivel_group_def wrong[] = {lower, upper}, right[] = {upper, lower};
    CHECK_THROWS_WITH(
        Crowd(of.skeleton.view(), 1, wrong),
        Catch::Contains(
            "group 1 turns joint 0, which is above joint 3 of group 0; let the look that is above come first"));
    CHECK_NOTHROW(Crowd(of.skeleton.view(), 1, right));
    of.look.look.rate = 1;
    Crowd crowd(of.skeleton.view(), 1, std::span(&of.look, 1));
    swivel_pose pose = swivel_default_pose();
    std::array<Float4, 4> rotations{};
    pose.rotations = {rotations.data(), sizeof rotations, sizeof(Float4), nullptr};
    CHECK_THROWS_WITH(crowd.solve({.pose = &pose}),
                      Catch::Contains("the pose has no time, which plants, shifts and looks with a rate need"));
}
