// SPDX-License-Identifier: MIT
//
// The promise: a planted hand or foot is where it is sent, and does not move on its support while it is locked,
// wherever that moves and however far away. What is not in contact stays as it comes. Groups that are not chosen keep
// what they carry, and a support may change. All is checked by forward kinematics of Eigen's, in double.
#include <catch2/catch.hpp>

#include "tests/hill_walkers.h"
#include "tests/posed_bodies.h"
#include "tests/test_crowd.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr int kFrames = 150;

}  // namespace

TEST_CASE("a planted limb is where it is sent, and stands still on its support; without contact the pose stays")
{
    const Ground ground = GENERATE(Ground::still, Ground::moving, Ground::far);
    const bool has_effector = GENERATE(true, false), turns = GENERATE(true, false);
    PlantedBodies stage(1, ground);
    const swivel_plant plant = swivel_default_plant();
    Crowd crowd = stage.crowd(
        kPlanted | (has_effector ? SWIVEL_WITH_EFFECTOR : 0) | (turns ? SWIVEL_WITH_PLANT_ROTATION : 0), plant);
    Random random{9};
    // Some bodies are never in contact, some have targets and hands that are written, and count instead of the pose's.
    const auto is_free = [](std::uint32_t n) { return n % 5 == 0; };
    const auto is_written = [](std::uint32_t n) { return n % 8 == 1; };
    const auto from_root = [&](std::uint32_t n) { return ground == Ground::far ? Vector3d::Zero() : stage.roots[n]; };
    std::vector<std::vector<Float3>> effectors(3);
    std::vector<std::vector<BodyGoal>> written(3);
    for (std::uint32_t g = 0; g < 3; ++g) {
        for (std::uint32_t n = 0; n < stage.body_count; ++n) {
            effectors[g].push_back(has_effector ? floats(random.vector(0, 0.1)) : Float3{});
            BodyGoal& goal = written[g].emplace_back(random_goal(random, stage.skeleton, stage.bodies[n], g));
            const Vector3d from = vec(goal.target) - vec(stage.bodies[n].root_position);
            goal.target = floats(Vector3d(from_root(n) + from));
            if (!is_written(n)) continue;
            crowd.write(SWIVEL_TARGET, g, std::span(&goal.target, 1), n);
            crowd.write(SWIVEL_HAND, g, std::span(&goal.hand, 1), n);
        }
        if (has_effector) crowd.write(SWIVEL_EFFECTOR, g, effectors[g]);
    }
    std::vector<std::vector<double>> locked_for(3, std::vector<double>(stage.body_count));  // seconds
    using TurnBits = std::array<std::uint32_t, 10>;  // its first four are the mark's
    std::vector<std::vector<PlantBits>> last(3, std::vector<PlantBits>(stage.body_count));
    std::vector<std::vector<TurnBits>> last_turn(3, std::vector<TurnBits>(stage.body_count));
    int reached_count = 0, limb_count = 0, stood_count = 0;
    for (int frame = 0; frame < kFrames; ++frame) {
        stage.go_to(frame);
        for (std::vector<float>& labels : stage.labels)
            for (std::uint32_t n = 0; n < stage.body_count; ++n)
                if (is_free(n)) labels[n] = 0.5f;
        stage.solve(crowd);
        for (std::uint32_t n = 0; n < stage.body_count; ++n) {
            const std::vector<JointAt> was = joints_at(stage.skeleton, stage.bodies[n]),
                                       is = joints_at(stage.skeleton, stage.poses.read(n, stage.bodies[n]));
            for (std::uint32_t g = 0; g < 3; ++g) {
                const BodyLimbJoints& joints = stage.skeleton.limbs[g];
                const LimbAt limb(stage.skeleton, stage.bodies[n], was, joints);
                const std::uint32_t flags = flags_of(crowd, g, n);
                REQUIRE(!(flags & SWIVEL_BAD_INPUT));
                if (is_free(n) && !is_written(n)) {
                    REQUIRE((flags & (SWIVEL_PLANTED | SWIVEL_RELEASED | SWIVEL_CUT)) == 0);
                    REQUIRE(strayed(limb, joints, was, is) <= 1);
                    continue;
                }
                const PlantBits bits = plant_bits(crowd, g, n);
                double& locked = locked_for[g][n];
                const bool is_locked = flags & SWIVEL_PLANTED, stays = frame > 0 && is_locked && locked > 0;
                locked = is_locked ? locked + double{stage.times[n]} : -double{stage.times[n]};
                if (stays) REQUIRE(is_same_mark(bits, last[g][n]));
                last[g][n] = bits;
                if (turns) {
                    const auto turn = value_of<TurnBits>(crowd, SWIVEL_PLANT_ROTATION, g, n);
                    if (stays) REQUIRE(std::equal(&turn[0], &turn[4], &last_turn[g][n][0]));
                    last_turn[g][n] = turn;
                }
                if (!is_written(n)) ++limb_count, reached_count += (flags & SWIVEL_REACHED) != 0;
                const auto goal = value_of<std::array<float, 7>>(crowd, SWIVEL_SOLVED_GOAL, g, n);
                const Vector3d sent(goal[0], goal[1], goal[2]), from = from_root(n);
                const Quaterniond hand = quat({goal[3], goal[4], goal[5], goal[6]}),
                                  comes = is_written(n) ? quat(written[g][n].hand) : was[joints.wrist].rotation;
                const double scale = stage.bodies[n].root_scale, root = stage.roots[n].norm();
                const double bound = limb.wrist_bound() + 5e-6 * 0.1 * scale + (from.norm() > 0 ? 2e-7 * root : 0);
                if (!turns) REQUIRE(hand.angularDistance(comes) <= 2e-6);
                if (is_written(n) && frame == 0) {
                    REQUIRE((sent - vec(written[g][n].target)).norm() <= bound);
                    REQUIRE(hand.angularDistance(comes) <= 2e-6);
                }
                if (!(flags & SWIVEL_REACHED)) continue;
                const Vector3d point =
                    is[joints.wrist].place + scale * (is[joints.wrist].rotation * vec(effectors[g][n]));
                REQUIRE((point + from - sent).norm() <= bound);
                REQUIRE(is[joints.wrist].rotation.angularDistance(hand) <= 5e-6);
                if (!(stays && locked > double{plant.stop_time} + 0.03)) continue;
                ++stood_count;
                // The root comes from its support in floats, rounded once.
                const Vector3d stands = stage.on_support(n, mark_of(crowd, g, n));
                const double off = 2e-7 * (stage.roots[n] - stage.support_place(n)).norm();
                REQUIRE((point + stage.roots[n] - stands).norm() <= bound + off);
                if (turns) {
                    const auto turn = value_of<std::array<float, 10>>(crowd, SWIVEL_PLANT_ROTATION, g, n);
                    const Quaterniond mark = quat({turn[0], turn[1], turn[2], turn[3]});
                    REQUIRE(hand.angularDistance(quat(stage.support_turns[n]).normalized() * mark) <= 3e-6);
                }
            }
        }
    }
    REQUIRE(reached_count > 0.7 * limb_count);
    REQUIRE(stood_count > 0.2 * limb_count);
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
                    REQUIRE((value_of<Float4>(by_motion, SWIVEL_CONTACT_STATE, g, n)[3] != 0) == contacts[g][n].is);
                }
    }
    REQUIRE(change_count > 100);
    REQUIRE(compared_count > 3 * kFrames * 10);
}

TEST_CASE("a job that names groups steps those alone, and needs no time where none is planted")
{
    PlantedBodies stage(5, Ground::still);
    int count = 0;
    const auto free_last = [&](swivel_body_limb_def& limb) {
        if (count++ % 3 == 2) limb.features &= ~SWIVEL_WITH_PLANT;
    };
    Crowd crowd = body_crowd(stage.skeleton, kPlanted, stage.body_count, free_last),
          other = body_crowd(stage.skeleton, kPlanted, stage.body_count, free_last);
    const auto write = [&](Crowd& to) {
        for (std::uint32_t g = 0; g < 2; ++g) to.write(SWIVEL_CONTACT, g, stage.labels[g]);
    };
    for (int frame = 0; frame < 30; ++frame) {
        stage.go_to(frame);
        write(crowd), write(other);
        const swivel_pose pose = stage.view();
        crowd.solve({.groups = std::array{1u}, .pose = &pose});
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
    CHECK_THROWS_WITH(crowd.solve({.pose = &pose}), Catch::Contains("the pose has no time"));
    CHECK_NOTHROW(crowd.solve({.groups = std::array{2u}, .pose = &pose}));
}

TEST_CASE("a support changes without a jump")
{
    PlantedBodies stage(7, Ground::moving);
    Crowd crowd = stage.crowd(kPlanted | SWIVEL_WITH_PLANT_ROTATION);
    for (int frame = 0; frame < 45; ++frame) stage.go_to(frame), stage.solve(crowd);
    using Goal = std::array<float, 7>;
    const auto solved = [&] {
        stage.solve(crowd);
        std::vector<std::vector<Goal>> goals;
        for (std::uint32_t g = 0; g < 3; ++g) goals.push_back(read<Goal>(crowd, SWIVEL_SOLVED_GOAL, g));
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

// ---- feet that walk over hills, on supports that move and turn

namespace {

constexpr std::uint32_t kWalkers = 40;
constexpr swivel_features kCarrying = HillWalkers::kFeatures | SWIVEL_WITH_PLANT_ROTATION | SWIVEL_WITH_WEIGHTS |
                                      SWIVEL_WITH_SHOULDER_CONE;  // with all inputs that faults are in

// Walkers on supports that move and turn.
struct Stage {
    HillWalkers walkers;
    Crowd crowd;
    PoseBuffer poses;

    explicit Stage(swivel_on_bad_input on_bad_input = SWIVEL_KEEP_POSE, float longest = 0, swivel_features more = 0)
        : walkers(walkers_of(longest)), crowd(walkers.crowd(kCarrying | more, on_bad_input)), poses(walkers.poses())
    {
    }
    void go_to(int frame)
    {
        walkers.go_to(frame);
        const double t = 0.01 * frame;
        walkers.supports.assign(walkers.count(), floats(Vector3d(t, 2 * std::sin(t), 1)));
        walkers.support_turns.assign(walkers.count(), floats(Quaterniond(Eigen::AngleAxisd(t, Vector3d(1, 2, 2) / 3))));
        poses = walkers.poses();
    }
    // With the ground that is written.
    void step() { walkers.solve(crowd, poses); }
    // The ground below each foot, as it is animated.
    void write_ground()
    {
        for (std::uint32_t leg = 0; leg < 2; ++leg) {
            std::vector<GroundSample> ground;
            for (std::uint32_t n = 0; n < walkers.count(); ++n)
                ground.push_back(walkers.sample(n, floats(walkers.leg(poses, n, leg, 0).toe)));
            HillWalkers::write(crowd, leg, ground);
        }
    }
    void play(int first, int end)
    {
        for (int frame = first; frame < end; ++frame) {
            go_to(frame);
            write_ground();
            step();
        }
    }

private:
    static HillWalkers walkers_of(float longest)
    {
        HillWalkers of(5, kWalkers, bumpy_field());
        of.plant.reset_time = longest;
        return of;
    }
};

// The bits of all that a leg carries.
std::vector<std::uint32_t> carried(const Crowd& crowd, std::uint32_t leg, std::uint32_t body)
{
    return bits_of_group(crowd, leg, body, SWIVEL_FIELD_CARRIED);
}

// One thing that is wrong with body 17, or with a number of its leg 1.
constexpr std::uint32_t kBad = 17;
struct Fault {
    const char* name;
    swivel_field field;
    Float4 value;
    void (*spoil)(HillWalkers& walkers) = nullptr;  // then it is the body's
};
const Fault kFaults[] = {
    {"normal NaN", SWIVEL_GROUND_NORMAL, {0, kNan, 0}},
    {"normal of no length", SWIVEL_GROUND_NORMAL, {}},
    {"normal too short", SWIVEL_GROUND_NORMAL, {0, 1e-10f, 0}},
    {"normal without end", SWIVEL_GROUND_NORMAL, {kInf, 0, 0}},
    {"weight NaN", SWIVEL_GROUND_WEIGHT, {kNan}},
    {"weight 2", SWIVEL_GROUND_WEIGHT, {2}},
    {"weight below 0", SWIVEL_GROUND_WEIGHT, {-0.1f}},
    {"effector NaN", SWIVEL_EFFECTOR, {kNan, 0, 0}},
    {"effector without end", SWIVEL_EFFECTOR, {kInf, 0, 0}},
    {"label 2", SWIVEL_CONTACT, {2}},
    {"label NaN", SWIVEL_CONTACT, {kNan}},
    {"target without end", SWIVEL_TARGET, {kInf, 0, 0}},
    {"hand of no length", SWIVEL_HAND, {}},
    {"limb weight 2", SWIVEL_WEIGHTS, {2, 1, 1}},
    {"cone of no axis", SWIVEL_SHOULDER_CONE, {}},
    {"cap NaN", SWIVEL_CAP, {kNan, 0, 0}},
    {"lengths below 0", SWIVEL_LENGTHS, {-1, 1}},
    {"time NaN", {}, {}, [](HillWalkers& of) { of.times[kBad] = kNan; }},
    {"time below 0", {}, {}, [](HillWalkers& of) { of.times[kBad] = -0.01f; }},
    {"time without end", {}, {}, [](HillWalkers& of) { of.times[kBad] = kInf; }},
    {"support nowhere", {}, {}, [](HillWalkers& of) { of.supports[kBad][1] = kNan; }},
    {"root and support too far",
     {},
     {},
     [](HillWalkers& of) {
         of.bodies[kBad].root_position = of.supports[kBad] = {3e37f, 0, 0};
     }},
    {"support's rotation NaN", {}, {}, [](HillWalkers& of) { of.support_turns[kBad][3] = kNan; }},
    {"support's rotation 0", {}, {}, [](HillWalkers& of) { of.support_turns[kBad] = {}; }},
};
void make(const Fault& fault, Stage& stage)
{
    if (fault.spoil) {
        fault.spoil(stage.walkers);
        stage.poses = stage.walkers.poses();
        return;
    }
    if (fault.field == SWIVEL_CONTACT)
        stage.walkers.labels[1][kBad] = fault.value[0];  // written by each solve
    else
        check(swivel_write(stage.crowd.get(), fault.field, 1, kBad, 1, {&fault.value, sizeof fault.value}));
}

}  // namespace

TEST_CASE("bad input of a planted foot is its own, and keeps what it carries")
{
    const swivel_on_bad_input on_bad_input = GENERATE(SWIVEL_KEEP_POSE, SWIVEL_REST_POSE);
    const swivel_features by_motion = GENERATE(swivel_features{0}, SWIVEL_PLANT_BY_MOTION);
    Stage good(on_bad_input, 0, by_motion);
    good.play(0, 31);
    for (const Fault& fault : kFaults) {
        if (by_motion && fault.field == SWIVEL_CONTACT) continue;
        Stage stage(on_bad_input, 0, by_motion);
        stage.play(0, 30);
        const std::vector<std::uint32_t> before[] = {carried(stage.crowd, 0, kBad), carried(stage.crowd, 1, kBad)};
        stage.go_to(30);
        stage.write_ground();
        make(fault, stage);
        const PoseBuffer came = stage.poses;
        stage.step();
        for (std::uint32_t leg = 0; leg < 2; ++leg)
            for (std::uint32_t n = 0; n < kWalkers; ++n) {
                INFO(fault.name << ", leg " << leg << ", body " << n);
                const bool is_bad = n == kBad && (fault.spoil || leg == 1);
                REQUIRE((flags_of(stage.crowd, leg, n) == SWIVEL_BAD_INPUT) == is_bad);
                if (n != kBad)
                    REQUIRE(bits_of_body(stage.crowd, stage.poses, n) == bits_of_body(good.crowd, good.poses, n));
                if (!is_bad) continue;
                for (std::uint32_t joint = 1 + 3 * leg; joint < 4 + 3 * leg && on_bad_input == SWIVEL_KEEP_POSE;
                     ++joint)
                    REQUIRE(stage.poses.joint_bytes(n, joint) == came.joint_bytes(n, joint));
                const std::vector<std::uint32_t> anew(before[leg].size());  // as at the start
                REQUIRE(before[leg] != anew);
                REQUIRE(carried(stage.crowd, leg, n) == (on_bad_input == SWIVEL_KEEP_POSE ? before[leg] : anew));
            }
    }
}

TEST_CASE("time 0 changes no bit of what feet on ground carry")
{
    Stage stage;
    for (const int frame : {1, 25, 40, 55}) {
        stage.play(frame - 1, frame);
        std::vector<std::vector<std::uint32_t>> before;
        for (std::uint32_t n = 0; n < 2 * kWalkers; ++n) before.push_back(carried(stage.crowd, n % 2, n / 2));
        // Elsewhere, on other ground.
        stage.go_to(frame + 7);
        std::ranges::fill(stage.walkers.times, 0.0f);
        stage.write_ground();
        stage.step();
        for (std::uint32_t n = 0; n < 2 * kWalkers; ++n) REQUIRE(carried(stage.crowd, n % 2, n / 2) == before[n]);
    }
}

TEST_CASE("a walker that is reset, or was not solved for longer than `longest`, is on its ground at once")
{
    Stage stage(SWIVEL_KEEP_POSE, 0.5f), fresh(SWIVEL_KEEP_POSE, 0.5f);
    stage.play(0, 30);
    const auto is_reset = [](std::uint32_t n) { return n >= 7 && n < 12; };
    const auto is_old = [](std::uint32_t n) { return n >= 27 && n < 32; };
    stage.go_to(75), fresh.go_to(75);
    for (std::uint32_t g = 0; g < 2; ++g) check(swivel_reset(stage.crowd.get(), g, 7, 5));
    for (std::uint32_t n = 27; n < 32; ++n) stage.walkers.times[n] = 0.6f;
    stage.write_ground(), fresh.write_ground();
    stage.step(), fresh.step();
    int other_count = 0;
    for (std::uint32_t leg = 0; leg < 2; ++leg)
        for (std::uint32_t n = 0; n < kWalkers; ++n) {
            const bool is_anew = carried(stage.crowd, leg, n) == carried(fresh.crowd, leg, n);
            const auto lift = value_of<std::array<float, 9>>(stage.crowd, SWIVEL_LIFT, leg, n);
            if (is_reset(n) || is_old(n))
                REQUIRE((is_anew && lift[1] == 0 && lift[2] == 1));
            else
                other_count += !is_anew;
        }
    REQUIRE(other_count > 30);
}
