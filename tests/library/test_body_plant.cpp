// SPDX-License-Identifier: MIT
//
// The promise: a planted hand or foot is where it is sent, and does not move on its support while it is locked,
// wherever that moves and however far away. What is not in contact stays as it comes. Groups that are not chosen keep
// what they carry, and a support may change. All is checked by forward kinematics of Eigen's, in double.
#include <catch2/catch.hpp>

#include "tests/planted_bodies.h"
#include "tests/test_crowd.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr int kFrames = 150;

// The seconds for which limbs have been locked.
struct LockedFor {
    std::vector<std::vector<double>> seconds;

    LockedFor(std::size_t limbs, std::size_t bodies) : seconds(limbs, std::vector<double>(bodies)) {}
    double after(std::size_t limb, std::uint32_t body, std::uint32_t flags, double time)
    {
        double& of = seconds[limb][body];
        return of = flags & SWIVEL_PLANTED ? of + time : -time;
    }
};

struct Effectors {
    std::vector<std::vector<Float3>> of;  // of each group

    Effectors(Random& random, std::size_t limbs, std::size_t bodies)
    {
        for (std::size_t g = 0; g < limbs; ++g) {
            of.emplace_back();
            for (std::size_t n = 0; n < bodies; ++n) of.back().push_back(floats(random.vector(0, 0.1)));
        }
    }
};

}  // namespace

TEST_CASE("a planted limb is where it is sent, and stands still on its support")
{
    const Ground ground = GENERATE(Ground::still, Ground::moving, Ground::far);
    const bool has_effector = GENERATE(true, false), turns = GENERATE(true, false);
    PlantedBodies stage(1, ground);
    const swivel_plant plant = swivel_default_plant();
    Crowd crowd =
        stage.crowd(kPlanted | (has_effector ? SWIVEL_WITH_EFFECTOR : 0) | (turns ? SWIVEL_WITH_PLANT_TURN : 0), plant);
    Random random{9};
    const Effectors effectors(random, 3, stage.body_count);
    if (has_effector)
        for (std::uint32_t g = 0; g < 3; ++g) crowd.write(SWIVEL_EFFECTOR, g, effectors.of[g]);
    LockedFor locked(3, stage.body_count);
    using TurnBits = std::array<std::uint32_t, 10>;  // its first four are the mark's
    std::vector<std::vector<PlantBits>> last(3, std::vector<PlantBits>(stage.body_count));
    std::vector<std::vector<TurnBits>> last_turn(3, std::vector<TurnBits>(stage.body_count));
    int reached_count = 0, limb_count = 0, stood_count = 0;
    for (int frame = 0; frame < kFrames; ++frame) {
        stage.go_to(frame);
        stage.solve(crowd);
        for (std::uint32_t n = 0; n < stage.body_count; ++n) {
            const std::vector<JointAt> was = joints_at(stage.skeleton, stage.bodies[n]),
                                       is = joints_at(stage.skeleton, stage.poses.read(n, stage.bodies[n]));
            for (std::uint32_t g = 0; g < 3; ++g) {
                const BodyLimbJoints& joints = stage.skeleton.limbs[g];
                const std::uint32_t flags = flags_of(crowd, g, n);
                REQUIRE(!(flags & SWIVEL_BAD_INPUT));
                const PlantBits bits = plant_bits(crowd, g, n);
                const bool stays = frame > 0 && (flags & SWIVEL_PLANTED) && locked.seconds[g][n] > 0;
                const double locked_for = locked.after(g, n, flags, stage.times[n]);
                if (stays) REQUIRE(is_same_mark(bits, last[g][n]));
                last[g][n] = bits;
                if (turns) {
                    const auto turn = value_of<TurnBits>(crowd, SWIVEL_PLANT_TURN, g, n);
                    if (stays) REQUIRE(std::equal(&turn[0], &turn[4], &last_turn[g][n][0]));
                    last_turn[g][n] = turn;
                }
                ++limb_count;
                reached_count += (flags & SWIVEL_REACHED) != 0;
                if (!(flags & SWIVEL_REACHED)) continue;
                const auto goal = value_of<std::array<float, 7>>(crowd, SWIVEL_GOAL, g, n);
                const Vector3d sent(goal[0], goal[1], goal[2]);
                const Quaterniond hand = quat({goal[3], goal[4], goal[5], goal[6]});
                const LimbAt limb(stage.skeleton, stage.bodies[n], was, joints);
                const double scale = stage.bodies[n].root_scale, root = stage.roots[n].norm();
                Vector3d point = is[joints.wrist].place;
                if (has_effector) point += scale * (is[joints.wrist].rotation * vec(effectors.of[g][n]));
                const Vector3d from = ground == Ground::far ? Vector3d(Vector3d::Zero()) : stage.roots[n];
                const double bound = limb.wrist_bound() + 5e-6 * 0.1 * scale + (from.norm() > 0 ? 2e-7 * root : 0);
                REQUIRE((point + from - sent).norm() <= bound);
                REQUIRE(is[joints.wrist].rotation.angularDistance(hand) <= 5e-6);
                if (!turns) REQUIRE(hand.angularDistance(was[joints.wrist].rotation) <= 2e-6);
                if (!(stays && locked_for > double{plant.stop} + 0.03)) continue;
                ++stood_count;
                // The root comes from its support in floats, rounded once.
                const Vector3d stands = stage.on_support(n, mark_of(crowd, g, n));
                const double off = 2e-7 * (stage.roots[n] - stage.support_place(n)).norm();
                REQUIRE((point + stage.roots[n] - stands).norm() <= bound + off);
                if (turns) {
                    const auto turn = value_of<std::array<float, 10>>(crowd, SWIVEL_PLANT_TURN, g, n);
                    const Quaterniond mark = quat({turn[0], turn[1], turn[2], turn[3]});
                    REQUIRE(hand.angularDistance(quat(stage.support_turns[n]).normalized() * mark) <= 3e-6);
                }
            }
        }
    }
    REQUIRE(reached_count > 0.7 * limb_count);
    REQUIRE(stood_count > 0.2 * limb_count);
}

TEST_CASE("without contact the pose stays as it comes")
{
    const Ground ground = GENERATE(Ground::still, Ground::moving, Ground::far);
    PlantedBodies stage(3, ground);
    Crowd crowd = stage.crowd(kPlanted);
    for (int frame = 0; frame < 20; ++frame) {
        stage.go_to(frame);
        for (std::vector<float>& labels : stage.labels) std::ranges::fill(labels, 0.5f);
        stage.solve(crowd);
        for (std::uint32_t n = 0; n < stage.body_count; ++n) {
            const std::vector<JointAt> was = joints_at(stage.skeleton, stage.bodies[n]),
                                       is = joints_at(stage.skeleton, stage.poses.read(n, stage.bodies[n]));
            for (std::uint32_t g = 0; g < 3; ++g) {
                const BodyLimbJoints& joints = stage.skeleton.limbs[g];
                const LimbAt limb(stage.skeleton, stage.bodies[n], was, joints);
                REQUIRE((flags_of(crowd, g, n) & (SWIVEL_PLANTED | SWIVEL_RELEASED | SWIVEL_CUT | SWIVEL_BAD_INPUT)) ==
                        0);
                REQUIRE(strayed(limb, joints, was, is) <= 1);
            }
        }
    }
}

TEST_CASE("a target and a hand that are written count instead of the pose's")
{
    PlantedBodies stage(4, Ground::still);
    Crowd crowd = stage.crowd(kPlanted);
    for (std::vector<float>& labels : stage.labels) std::ranges::fill(labels, 1.0f);
    Random random{5};
    BodyGoals goals(3);
    for (std::uint32_t g = 0; g < 3; ++g)
        for (const Body& body : stage.bodies) goals[g].push_back(random_goal(random, stage.skeleton, body, g));
    write_goals(crowd, goals);
    stage.solve(crowd);
    for (std::uint32_t n = 0; n < stage.body_count; ++n) {
        const std::vector<JointAt> is = joints_at(stage.skeleton, stage.poses.read(n, stage.bodies[n]));
        for (std::uint32_t g = 0; g < 3; ++g) {
            const JointAt& wrist = is[stage.skeleton.limbs[g].wrist];
            const LimbAt limb(stage.skeleton, stage.bodies[n], joints_at(stage.skeleton, stage.bodies[n]),
                              stage.skeleton.limbs[g]);
            REQUIRE((flags_of(crowd, g, n) & SWIVEL_PLANTED) != 0);
            REQUIRE((wrist.place + stage.roots[n] - vec(goals[g][n].target)).norm() <=
                    limb.wrist_bound() + 2e-7 * stage.roots[n].norm());
            REQUIRE(wrist.rotation.angularDistance(quat(goals[g][n].hand).normalized()) <= 5e-6);
        }
    }
}

TEST_CASE("contact by motion is a hysteresis of speed and height")
{
    PlantedBodies stage(5, Ground::moving);
    swivel_plant plant = swivel_default_plant();
    plant.speed[0] = 0.15f, plant.speed[1] = 0.2f, plant.height[0] = 0.5f, plant.height[1] = 0.6f;
    Crowd by_motion = stage.crowd(kPlanted | SWIVEL_PLANT_BY_MOTION, plant), by_label = stage.crowd(kPlanted, plant);
    struct Contact {
        Vector3d place;
        bool is = false, is_clear = true;
    };
    std::vector<std::vector<Contact>> contacts(3, std::vector<Contact>(stage.body_count));
    int change_count = 0, compared_count = 0;
    for (int frame = 0; frame < kFrames; ++frame) {
        stage.go_to(frame);
        for (std::uint32_t g = 0; g < 3; ++g) {
            const BodyLimbJoints& joints = stage.skeleton.limbs[g];
            const swivel_binding rest = bind(stage.skeleton.view(), stage.skeleton.joints(g));
            for (std::uint32_t n = 0; n < stage.body_count; ++n) {
                const Body& body = stage.bodies[n];
                const Vector3d point = joints_at(stage.skeleton, body)[joints.wrist].place;
                const Vector3d place = quat(stage.support_turns[n]).normalized().conjugate() *
                                       (point + stage.roots[n] - stage.support_place(n));
                const double length = (double{rest.lengths[0]} + rest.lengths[1]) * body.root_scale;
                const double height = point.dot(quat(body.root_rotation).normalized() * Vector3d::UnitY()) / length;
                Contact& contact = contacts[g][n];
                const double speed = (place - contact.place).norm() / length / stage.times[n];
                const double speed_bar = plant.speed[contact.is], height_bar = plant.height[contact.is];
                const bool is = frame > 0 && speed <= speed_bar && height <= height_bar;
                if (frame > 0 && (std::fabs(speed - speed_bar) < 1e-3 || std::fabs(height - height_bar) < 1e-4))
                    contact.is_clear = false;
                change_count += is != contact.is;
                contact.is = is, contact.place = place;
                stage.labels[g][n] = is;
            }
        }
        stage.solve(by_label);
        stage.go_to(frame);
        stage.solve(by_motion);
        for (std::uint32_t g = 0; g < 3; ++g)
            for (std::uint32_t n = 0; n < stage.body_count; ++n)
                if (contacts[g][n].is_clear) {
                    ++compared_count;
                    REQUIRE(plant_bits(by_motion, g, n) == plant_bits(by_label, g, n));
                    REQUIRE((value_of<Float4>(by_motion, SWIVEL_MOTION, g, n)[3] != 0) == contacts[g][n].is);
                }
    }
    REQUIRE(change_count > 100);
    REQUIRE(compared_count > 3 * kFrames * 10);
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
            REQUIRE(plant_bits(crowd, 1, n) == plant_bits(other, 1, n));
            REQUIRE(plant_bits(crowd, 0, n) == PlantBits{});
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

TEST_CASE("a support changes without a jump")
{
    PlantedBodies stage(7, Ground::moving);
    Crowd crowd = stage.crowd(kPlanted | SWIVEL_WITH_PLANT_TURN);
    for (int frame = 0; frame < 45; ++frame) stage.go_to(frame), stage.solve(crowd);
    using Goal = std::array<float, 7>;
    const auto solved = [&] {
        stage.solve(crowd);
        std::vector<std::vector<Goal>> goals;
        for (std::uint32_t g = 0; g < 3; ++g) goals.push_back(read<Goal>(crowd, SWIVEL_GOAL, g));
        return goals;
    };
    const auto go_on = [&] { stage.go_to(45), std::ranges::fill(stage.times, 0.0f); };  // so that nothing else changes
    const auto doubles = [](const Float3& v) { return Double3{v[0], v[1], v[2]}; };
    go_on();
    const auto before = solved();
    std::vector<Double3> from, to;
    const std::vector<Float4> from_turn = stage.support_turns;
    go_on();
    for (std::uint32_t n = 0; n < stage.body_count; ++n) {
        from.push_back(doubles(stage.supports[n]));
        if (n % 2 == 1) stage.supports[n] = {0.5f, -1, 0.25f}, stage.support_turns[n] = {0.6f, 0, 0, 0.8f};
        to.push_back(doubles(stage.supports[n]));
    }
    for (std::uint32_t g = 0; g < 3; ++g)
        check(swivel_change_support(crowd.get(), g, 0, stage.body_count,
                                    {{from.data(), sizeof from[0]}, {from_turn.data(), sizeof from_turn[0]}},
                                    {{to.data(), sizeof to[0]}, {stage.support_turns.data(), sizeof(Float4)}}));
    const auto after = solved();
    for (std::uint32_t g = 0; g < 3; ++g)
        for (std::uint32_t n = 0; n < stage.body_count; ++n) {
            const Goal &old = before[g][n], &now = after[g][n];
            REQUIRE((Vector3d(old[0], old[1], old[2]) - Vector3d(now[0], now[1], now[2])).norm() <=
                    4e-7 * (3 + stage.roots[n].norm() + vec(stage.supports[n]).norm()));
            REQUIRE(quat({old[3], old[4], old[5], old[6]}).angularDistance(quat({now[3], now[4], now[5], now[6]})) <=
                    3e-6);
        }
    CHECK_REFUSED(swivel_change_support(crowd.get(), 3, 0, 1, {}, {}), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(swivel_change_support(crowd.get(), 0, 0, stage.body_count + 1, {}, {}), SWIVEL_INVALID_ARGUMENT);
    const Float4 none{};
    CHECK_REFUSED(swivel_change_support(crowd.get(), 0, 0, 1, {{}, {&none, 0}}, {}), SWIVEL_INVALID_ARGUMENT);
    CHECK(swivel_change_support(crowd.get(), 0, 0, 1, {}, {}) == SWIVEL_OK);
}
