// SPDX-License-Identifier: MIT
//
// The promise: what planted limbs carry is whole. Bad input of one limb keeps it, and so do groups that are not chosen;
// a body may start anew; a support may change. That it can be saved and loaded is test_bits.cpp's.
#include <catch2/catch.hpp>

#include "tests/planted_bodies.h"
#include "tests/test_crowd.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr swivel_features kTurning = kPlanted | SWIVEL_WITH_PLANT_TURN;

void play(PlantedBodies& stage, Crowd& crowd, int first, int end)
{
    for (int frame = first; frame < end; ++frame) {
        stage.go_to(frame);
        stage.solve(crowd);
    }
}

// The bits of all that a limb carries.
std::vector<std::uint32_t> carried_bits(const Crowd& crowd, std::uint32_t group, std::uint32_t body)
{
    std::vector<std::uint32_t> all;
    for (const swivel_field field : {SWIVEL_PLANT, SWIVEL_PLANT_TURN, SWIVEL_MOTION}) {
        const std::uint32_t count = swivel_field_row_count(crowd.get(), group, field);
        if (count == 0) continue;
        std::vector<std::uint32_t> bits(count);
        check(swivel_read(crowd.get(), field, group, body, 1, {bits.data(), count * sizeof bits[0]}));
        all.insert(all.end(), bits.begin(), bits.end());
    }
    return all;
}
// Those of a body's joints in the pose.
std::vector<unsigned char> limb_bytes(const PlantedBodies& stage, std::uint32_t group, std::uint32_t body)
{
    std::vector<unsigned char> bytes;
    const BodyLimbJoints& limb = stage.skeleton.limbs[group];
    for (const std::uint32_t joint : {limb.shoulder, limb.elbow, limb.wrist}) {
        const unsigned char* const at = &stage.poses.bytes[body * stage.poses.body_stride + joint * 16];
        bytes.insert(bytes.end(), at, at + 16);
    }
    return bytes;
}

// One thing that is wrong with body 17, or its limb 1.
struct Fault {
    const char* name;
    void (*make)(PlantedBodies& stage, Crowd& crowd);
    bool is_of_body;
    swivel_features needs = 0;
};
constexpr std::uint32_t kBad = 17;
template <class Value>
void spoil(Crowd& crowd, swivel_field field, const Value& value)
{
    check(swivel_write(crowd.get(), field, 1, kBad, 1, {&value, sizeof value}));
}
const Fault kFaults[] = {
    {"label NaN", [](PlantedBodies& stage, Crowd&) { stage.labels[1][kBad] = kNan; }, false},
    {"label 2", [](PlantedBodies& stage, Crowd&) { stage.labels[1][kBad] = 2; }, false},
    {"target without end",
     [](PlantedBodies&, Crowd& crowd) {
         spoil(crowd, SWIVEL_TARGET, Float3{kInf, 0, 0});
     },
     false},
    {"hand of no length", [](PlantedBodies&, Crowd& crowd) { spoil(crowd, SWIVEL_HAND, Float4{}); }, false},
    {"time NaN", [](PlantedBodies& stage, Crowd&) { stage.times[kBad] = kNan; }, true},
    {"time below 0", [](PlantedBodies& stage, Crowd&) { stage.times[kBad] = -0.01f; }, true},
    {"time without end", [](PlantedBodies& stage, Crowd&) { stage.times[kBad] = kInf; }, true},
    {"support nowhere", [](PlantedBodies& stage, Crowd&) { stage.supports[kBad][1] = kNan; }, true},
    {"support's rotation NaN", [](PlantedBodies& stage, Crowd&) { stage.support_turns[kBad][3] = kNan; }, true},
    {"support's rotation 0", [](PlantedBodies& stage, Crowd&) { stage.support_turns[kBad] = {}; }, true},
    {"lengths below 0",
     [](PlantedBodies&, Crowd& crowd) {
         spoil(crowd, SWIVEL_LENGTHS, Float2{-1, 1});
     },
     false},
    {"effector NaN",
     [](PlantedBodies&, Crowd& crowd) {
         spoil(crowd, SWIVEL_EFFECTOR, Float3{kNan, 0, 0});
     },
     false, SWIVEL_WITH_EFFECTOR},
    {"weight 2",
     [](PlantedBodies&, Crowd& crowd) {
         spoil(crowd, SWIVEL_WEIGHTS, Float3{2, 1, 1});
     },
     false, SWIVEL_WITH_WEIGHTS},
    {"cap NaN",
     [](PlantedBodies&, Crowd& crowd) {
         spoil(crowd, SWIVEL_CAP, Float3{kNan, 0, 0});
     },
     false, SWIVEL_WITH_CAP},
    {"cone of no axis", [](PlantedBodies&, Crowd& crowd) { spoil(crowd, SWIVEL_SHOULDER_CONE, Float4{}); }, false,
     SWIVEL_WITH_SHOULDER_CONE},
};

}  // namespace

TEST_CASE("bad input of a planted limb is its own, and keeps what it carries")
{
    const bool by_motion = GENERATE(true, false);
    for (const Fault& fault : kFaults) {
        if (by_motion && std::string(fault.name).starts_with("label")) continue;
        const swivel_features features = kTurning | fault.needs | (by_motion ? SWIVEL_PLANT_BY_MOTION : 0);
        PlantedBodies stage(1, Ground::moving), good(1, Ground::moving);
        Crowd crowd = stage.crowd(features), other = stage.crowd(features);
        play(stage, crowd, 0, 30), play(good, other, 0, 30);
        std::vector<std::vector<std::uint32_t>> before;
        for (std::uint32_t g = 0; g < 3; ++g) before.push_back(carried_bits(crowd, g, kBad));
        stage.go_to(30);
        fault.make(stage, crowd);
        const PlantedBodies came = stage;
        stage.solve(crowd);
        play(good, other, 30, 31);
        for (std::uint32_t g = 0; g < 3; ++g)
            for (std::uint32_t n = 0; n < stage.body_count; ++n) {
                const bool is_bad = n == kBad && (fault.is_of_body || g == 1);
                INFO(fault.name << ", group " << g << ", body " << n);
                REQUIRE((flags_of(crowd, g, n) == SWIVEL_BAD_INPUT) == is_bad);
                REQUIRE(limb_bytes(stage, g, n) == limb_bytes(is_bad ? came : good, g, n));
                CHECK(carried_bits(crowd, g, n) == (is_bad ? before[g] : carried_bits(other, g, n)));
            }
    }
}

TEST_CASE("a limb that goes to its rest pose for bad input starts anew")
{
    for (const Fault& fault : kFaults) {
        const swivel_features features = kTurning | fault.needs;
        PlantedBodies stage(1, Ground::moving);
        Crowd crowd = stage.crowd(features, swivel_default_plant(), SWIVEL_REST_POSE);
        play(stage, crowd, 0, 30);
        stage.go_to(30);
        fault.make(stage, crowd);
        stage.solve(crowd);
        INFO(fault.name);
        REQUIRE(flags_of(crowd, 1, kBad) == SWIVEL_BAD_INPUT);
        REQUIRE(carried_bits(crowd, 1, kBad) == std::vector<std::uint32_t>(21));
        REQUIRE(carried_bits(crowd, 1, kBad - 1) != std::vector<std::uint32_t>(21));
    }
}

TEST_CASE("a job that names groups steps those alone, and needs no time where none is planted")
{
    PlantedBodies stage(5, Ground::still);
    std::vector<swivel_limb_joints> joints;
    for (std::size_t n = 0; n < 3; ++n) joints.push_back(stage.skeleton.joints(n));
    std::vector<swivel_group_def> groups;
    for (const swivel_limb_joints& each : joints) groups.push_back(body_group(each, kPlanted));
    groups[2].features = body_group(joints[2], SWIVEL_POLE_INCOMING).features;
    Crowd crowd(stage.skeleton.view(), stage.body_count, groups),
        other(stage.skeleton.view(), stage.body_count, groups);
    const auto write = [&](Crowd& to) {
        for (std::uint32_t g = 0; g < 2; ++g) to.write(SWIVEL_CONTACT, g, stage.labels[g]);
    };
    for (int frame = 0; frame < 30; ++frame) {
        stage.go_to(frame);
        write(crowd), write(other);
        const swivel_pose pose = stage.view();
        crowd.solve({.groups = {1u}, .pose = &pose});
        stage.go_to(frame);
        const swivel_pose all = stage.view();
        other.solve({.pose = &all});
        for (std::uint32_t n = 0; n < stage.body_count; ++n) {
            REQUIRE(carried_bits(crowd, 1, n) == carried_bits(other, 1, n));
            REQUIRE(carried_bits(crowd, 0, n) == std::vector<std::uint32_t>(11));
        }
    }
    swivel_pose pose = stage.view();
    pose.time = {};
    swivel_job job = swivel_default_job();
    job.pose = &pose;
    CHECK_REFUSED(swivel_solve(crowd.get(), &job), SWIVEL_INVALID_ARGUMENT);
    CHECK(std::string(swivel_last_error()).find("time") != std::string::npos);
    const std::uint32_t third = 1u << 2;
    job.groups = &third, job.group_word_count = 1;
    CHECK(swivel_solve(crowd.get(), &job) == SWIVEL_OK);
}

TEST_CASE("a body that is reset, or was not solved for longer than `longest`, starts anew")
{
    swivel_plant plant = swivel_default_plant();
    plant.longest = 0.5f;
    PlantedBodies stage(6, Ground::still), fresh(6, Ground::still);
    Crowd crowd = stage.crowd(kTurning, plant), anew = stage.crowd(kTurning, plant);
    play(stage, crowd, 0, 30);
    const bool is_reset = GENERATE(true, false);
    stage.go_to(75), fresh.go_to(75);
    if (is_reset)
        for (std::uint32_t g = 0; g < 3; ++g) check(swivel_reset(crowd.get(), g, 7, 5));
    else
        for (std::uint32_t n = 7; n < 12; ++n) stage.times[n] = 0.6f;
    stage.solve(crowd), fresh.solve(anew);
    int other_count = 0;
    for (std::uint32_t g = 0; g < 3; ++g)
        for (std::uint32_t n = 0; n < stage.body_count; ++n) {
            const bool is_anew = carried_bits(crowd, g, n) == carried_bits(anew, g, n);
            if (n >= 7 && n < 12)
                REQUIRE(is_anew);
            else
                other_count += !is_anew;
        }
    REQUIRE(other_count > 30);
}

TEST_CASE("a support changes without a jump")
{
    PlantedBodies stage(7, Ground::moving);
    Crowd crowd = stage.crowd(kTurning);
    play(stage, crowd, 0, 45);
    using Goal = std::array<float, 7>;
    const auto goals = [&] {  // without time, so that nothing else changes
        std::vector<std::vector<Goal>> all(3);
        stage.go_to(45);
        std::ranges::fill(stage.times, 0.0f);
        for (std::uint32_t n = 0; n < stage.body_count; ++n)
            if (n % 2 == 1) stage.supports[n] = {0.5f, -1, 0.25f}, stage.support_turns[n] = {0.6f, 0, 0, 0.8f};
        return all;
    };
    const auto solved = [&](std::vector<std::vector<Goal>> all) {
        stage.solve(crowd);
        for (std::uint32_t g = 0; g < 3; ++g)
            for (std::uint32_t n = 0; n < stage.body_count; ++n)
                all[g].push_back(value_of<Goal>(crowd, SWIVEL_GOAL, g, n));
        return all;
    };
    stage.go_to(45);
    std::ranges::fill(stage.times, 0.0f);
    const auto before = solved(std::vector<std::vector<Goal>>(3));
    std::vector<Double3> from, to;
    std::vector<Float4> from_turn = stage.support_turns, to_turn = from_turn;
    for (std::uint32_t n = 0; n < stage.body_count; ++n) {
        const Vector3d at = vec(stage.supports[n]);
        from.push_back({at.x(), at.y(), at.z()});
        to.push_back(n % 2 == 1 ? Double3{0.5, -1, 0.25} : from[n]);
        if (n % 2 == 1) to_turn[n] = {0.6f, 0, 0, 0.8f};
    }
    for (std::uint32_t g = 0; g < 3; ++g)
        check(swivel_change_support(crowd.get(), g, 0, stage.body_count,
                                    {{from.data(), sizeof from[0]}, {from_turn.data(), sizeof from_turn[0]}},
                                    {{to.data(), sizeof to[0]}, {to_turn.data(), sizeof to_turn[0]}}));
    const auto after = solved(goals());
    for (std::uint32_t g = 0; g < 3; ++g)
        for (std::uint32_t n = 0; n < stage.body_count; ++n) {
            const Goal &was = before[g][n], &is = after[g][n];
            REQUIRE((Vector3d(was[0], was[1], was[2]) - Vector3d(is[0], is[1], is[2])).norm() <=
                    4e-7 * (3 + stage.roots[n].norm() + vec(stage.supports[n]).norm()));
            REQUIRE(quat({was[3], was[4], was[5], was[6]}).angularDistance(quat({is[3], is[4], is[5], is[6]})) <= 3e-6);
        }
    CHECK_REFUSED(swivel_change_support(crowd.get(), 3, 0, 1, {}, {}), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(swivel_change_support(crowd.get(), 0, 0, stage.body_count + 1, {}, {}), SWIVEL_INVALID_ARGUMENT);
    const Float4 none{};
    CHECK_REFUSED(swivel_change_support(crowd.get(), 0, 0, 1, {{}, {&none, 0}}, {}), SWIVEL_INVALID_ARGUMENT);
    CHECK(swivel_change_support(crowd.get(), 0, 0, 1, {}, {}) == SWIVEL_OK);
}
