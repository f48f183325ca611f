// SPDX-License-Identifier: MIT
//
// The promise: of a limb that the library sends somewhere, bad input keeps every result but flags and the hand's frame,
// which is whole or none. A job for probes alone gives them also where the last solve kept the pose.
#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>

#include "tests/planted_bodies.h"
#include "tests/test_crowd.h"

namespace {

using namespace swivel;
using namespace swivel::test;

using Bits7 = std::array<std::uint32_t, 7>;

// Limb 1 of each body holds limb 0's hand.
Crowd linked_crowd(const PlantedBodies& stage)
{
    const swivel_limb_joints held = stage.skeleton.joints(0), holding = stage.skeleton.joints(1);
    constexpr swivel_features features = SWIVEL_WITH_HAND | SWIVEL_POLE_INCOMING;
    std::vector<swivel_group_def> groups = {
        body_group(held, features),
        body_group(holding, features | SWIVEL_WITH_LINK | SWIVEL_WITH_RECORD | SWIVEL_WITH_WEIGHTS)};
    groups[1].link = 0;
    return Crowd(stage.skeleton.view(), stage.body_count, groups);
}

}  // namespace

TEST_CASE("bad input of a linked limb keeps its goal, whichever input it is")
{
    struct Fault {
        const char* name;
        swivel_field field;
        std::uint32_t group;
        std::array<float, 7> value;
    };
    constexpr std::uint32_t kBad = 5;
    const Fault faults[] = {
        {"what it holds is nowhere", SWIVEL_TARGET, 0, {kNan, 0, 0}},
        {"grip nowhere", SWIVEL_GRIP, 1, {kInf, 0, 0, 0, 0, 0, 1}},
        {"grip of no rotation", SWIVEL_GRIP, 1, {}},
        {"weights", SWIVEL_WEIGHTS, 1, {1, 2, 1}},
    };
    for (const Fault& fault : faults) {
        PlantedBodies stage(7, Ground::still);
        Crowd crowd = linked_crowd(stage);
        for (std::uint32_t body = 0; body < stage.body_count; ++body) {
            const Float3 target = floats(Vector3d(stage.roots[body] + Vector3d(0.1, 0.2, 0.1)));
            check(swivel_write(crowd.get(), SWIVEL_TARGET, 0, body, 1, {&target, 0}));
        }
        solve_poses(crowd, stage.view());
        std::vector<Bits7> before;
        for (std::uint32_t body = 0; body < stage.body_count; ++body)
            before.push_back(value_of<Bits7>(crowd, SWIVEL_GOAL, 1, body));
        check(swivel_write(crowd.get(), fault.field, fault.group, kBad, 1, {&fault.value, 0}));
        if (fault.group == 0) {  // a limb that keeps its pose has a hand; one whose pose is bad has none
            stage.go_to(1);
            const float nan = kNan;
            std::memcpy(&stage.poses.bytes[kBad * stage.poses.body_stride + stage.skeleton.limbs[0].elbow * 16], &nan,
                        sizeof nan);
        } else {
            stage.go_to(1);
        }
        solve_poses(crowd, stage.view());
        INFO(fault.name);
        for (std::uint32_t body = 0; body < stage.body_count; ++body) {
            INFO("body " << body);
            CHECK((flags_of(crowd, 1, body) == SWIVEL_BAD_INPUT) == (body == kBad));
            CHECK((value_of<Bits7>(crowd, SWIVEL_GOAL, 1, body) == before[body]) == (body == kBad));
        }
    }
}

TEST_CASE("a hand whose pose is bad has no frame")
{
    PlantedBodies stage(9, Ground::still);
    stage.layout.translates = true;
    stage.go_to(0);
    Crowd crowd = stage.crowd(SWIVEL_WITH_HAND | SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND_FRAME);
    const BodyLimbJoints& limb = stage.skeleton.limbs[0];
    const auto spoil = [&](std::uint32_t body, const auto& change) {
        Body pose = stage.bodies[body];
        change(pose);
        stage.poses.write(body, pose);
    };
    spoil(1, [&](Body& pose) { pose.translations[limb.wrist][1] = 3e20f; });
    spoil(2, [&](Body& pose) { pose.rotations[limb.wrist] = {}; });
    spoil(3, [&](Body& pose) { pose.rotations[limb.shoulder][0] = kNan; });
    spoil(4, [&](Body& pose) { pose.root_position[2] = kInf; });
    solve_poses(crowd, stage.view());
    for (std::uint32_t body = 0; body < stage.body_count; ++body) {
        INFO("body " << body);
        const auto frame = value_of<std::array<float, 7>>(crowd, SWIVEL_HAND_FRAME, 0, body);
        const bool has_none = body >= 1 && body <= 4;
        for (const float x : frame) CHECK(std::isnan(x) == has_none);
    }
}

TEST_CASE("a job for probes alone gives them to a frame, also where the last solve kept the pose")
{
    PlantedBodies stage(8, Ground::still);
    Crowd crowd = stage.crowd(kPlanted | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_GROUND);
    constexpr std::uint32_t kBad = 11;
    const float wrong = 2;
    check(swivel_write(crowd.get(), SWIVEL_GROUND_WEIGHT, 0, kBad, 1, {&wrong, 0}));
    stage.solve(crowd);
    REQUIRE(flags_of(crowd, 0, kBad) == SWIVEL_BAD_INPUT);
    stage.go_to(1);
    stage.write_labels(crowd);
    std::vector<Float3> probes(stage.body_count, {kNan, kNan, kNan});
    const swivel_frame_field field = {SWIVEL_PROBE, probes.data(), sizeof probes[0]};
    swivel_frame frames[3] = {swivel_default_frame(), swivel_default_frame(), swivel_default_frame()};
    frames[0].fields = &field, frames[0].field_count = 1;
    const swivel_pose pose = stage.view();
    swivel_job job = swivel_default_job();
    job.pose = &pose, job.frames = frames, job.probes_only = 1;
    check(swivel_solve(crowd.get(), &job));
    for (std::uint32_t body = 0; body < stage.body_count; ++body) {
        INFO("body " << body);
        CHECK(std::isfinite(probes[body][0]));
        CHECK(probes[body] == value_of<Float3>(crowd, SWIVEL_PROBE, 0, body));
    }
}

TEST_CASE("a root without a place is bad input of what is planted, also on a support as far away")
{
    PlantedBodies stage(10, Ground::still);
    Crowd crowd = stage.crowd(kPlanted | SWIVEL_WITH_HAND_FRAME);
    constexpr std::uint32_t kBad = 4;
    Body body = stage.bodies[kBad];
    body.root_position = stage.supports[kBad] = {3e37f, 0, 0};
    stage.poses.write(kBad, body);
    stage.solve(crowd);
    for (std::uint32_t n = 0; n < stage.body_count; ++n)
        CHECK((flags_of(crowd, 0, n) == SWIVEL_BAD_INPUT) == (n == kBad));
}
