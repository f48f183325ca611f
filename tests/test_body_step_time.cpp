// SPDX-License-Identifier: MIT
//
// The promise: where a pose has a time, SWIVEL_MOST_SWIVEL is a step of a 60th of a second. So elbows turn as fast at
// any frame rate, not at all where time stands still, and freely where nothing was written. Angles of the elbow judge.
#include <catch2/catch.hpp>

#include <numbers>

#include "tests/test_arm.h"
#include "tests/test_crowd.h"

using namespace swivel;
using namespace swivel::test;

namespace {

// An arm along x whose pole turns from below to aside.
struct SteppingArm {
    static constexpr std::array<std::int32_t, 4> kParents = {-1, 0, 1, 2};
    static constexpr std::array<Float3, 4> kOffsets = {{{0, 1, 0}, {0.2f, 0.4f, 0}, {0.3f, 0, 0}, {0.3f, 0, 0}}};

    swivel_limb_joints joints = swivel_default_limb_joints(1, 2, 3);
    Crowd crowd;

    SteppingArm() : crowd(made()) { crowd.write_all(SWIVEL_TARGET, 0, Float3{0.6f, 1.4f, 0.1f}); }
    void limit(double angle) { crowd.write_all(SWIVEL_MOST_SWIVEL, 0, turn(angle)); }
    // The elbow's direction across the line from shoulder to wrist.
    Vector3d step(const Float3& pole, float seconds)
    {
        crowd.write_all(SWIVEL_POLE, 0, pole);
        std::array<Float4, 4> rotations;
        std::array<Float3, 4> places;
        rotations.fill({0, 0, 0, 1});
        swivel_pose pose = swivel_default_pose();
        pose.rotations = {rotations.data(), 0, sizeof rotations[0], nullptr};
        pose.joint_places = {places.data(), sizeof places, sizeof places[0], nullptr};
        pose.time = {&seconds, 0};
        crowd.solve({.pose = &pose});
        const Vector3d line = (vec(places[3]) - vec(places[1])).normalized(), elbow = vec(places[2]) - vec(places[1]);
        return (elbow - elbow.dot(line) * line).normalized();
    }

private:
    Crowd made()
    {
        swivel_skeleton skeleton = swivel_default_skeleton();
        skeleton.parents = stream(kParents);
        skeleton.translations = stream(kOffsets);
        skeleton.joint_count = 4;
        joints.bend[2] = 1;
        const std::array groups = {body_group(joints, SWIVEL_WITH_MOST_SWIVEL | SWIVEL_POLE_DIRECTION)};
        return Crowd(skeleton, 1, groups);
    }
};
constexpr Float3 kBelow{0, -1, 0}, kAside{0, 0, -1};

}  // namespace

TEST_CASE("an elbow turns as far in a tenth of a second at any frame rate")
{
    for (const int frames : {1, 3, 6, 12, 24}) {
        SteppingArm arm;
        arm.limit(0.05);
        const Vector3d from = arm.step(kBelow, 0.1f);
        Vector3d to = from;
        for (int n = 0; n < frames; ++n) to = arm.step(kAside, 0.1f / static_cast<float>(frames));
        INFO(frames << " frames");
        CHECK(angle_between(from, to) == Approx(6 * 0.05).epsilon(0.03));
    }
}

TEST_CASE("a step that was never written limits nothing, and half a turn does not")
{
    for (const bool is_written : {false, true})
        for (const float seconds : {1e-3f, 1 / 60.0f, 1.0f}) {
            SteppingArm arm;
            if (is_written) arm.limit(std::numbers::pi);
            const Vector3d from = arm.step(kBelow, seconds), to = arm.step(kAside, seconds);
            CHECK(angle_between(from, to) == Approx(std::numbers::pi / 2).epsilon(0.1));
        }
}

TEST_CASE("where time stands still an elbow stays")
{
    SteppingArm arm;
    arm.limit(0.05);
    const Vector3d from = arm.step(kBelow, 0.1f), to = arm.step(kAside, 0);
    CHECK(angle_between(from, to) <= 1e-5);
}
