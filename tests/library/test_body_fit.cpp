// SPDX-License-Identifier: MIT
//
// The promise: a body is shifted so that its limbs reach, and says by how much; its limbs then do, by forward
// kinematics of Eigen's. A capped limb gets no straighter than animated by more than its margin. What cannot be gets a
// line.
#include <catch2/catch.hpp>

#include "tests/planted_bodies.h"
#include "tests/test_crowd.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr swivel_features kFitting = SWIVEL_WITH_FIT | SWIVEL_POLE_INCOMING | SWIVEL_WITH_RECORD;

// Bodies that stand still, with targets that all limbs reach from one shift.
struct FitStage {
    PlantedBodies bodies;
    std::vector<double> shifts, lengths;  // of each body: that shift, and what drop and rise are shares of
    std::vector<std::vector<Float3>> targets;
    swivel_fit fit = swivel_default_fit();

    explicit FitStage(std::uint64_t seed) : bodies(seed, Ground::still, 80)
    {
        Random random{seed + 1};
        fit.drop = 0.5f, fit.rise = 0.4f;
        const swivel_binding first = bind(bodies.skeleton.view(), bodies.skeleton.joints(0));
        targets.resize(3);
        for (std::uint32_t n = 0; n < bodies.body_count; ++n) {
            const Body& body = bodies.bodies[n];
            lengths.push_back((double{first.lengths[0]} + first.lengths[1]) * body.root_scale);
            shifts.push_back(random.between(-0.45, 0.35) * lengths[n]);
            const std::vector<JointAt> at = joints_at(bodies.skeleton, body);
            for (std::size_t g = 0; g < 3; ++g) {
                const LimbAt limb(bodies.skeleton, body, at, bodies.skeleton.limbs[g]);
                const double near = std::fabs(limb.upper - limb.fore);
                const double distance = near + random.between(0.6, 0.98) * (limb.length() - near);
                const Vector3d way = random.direction();
                targets[g].push_back(floats(Vector3d(bodies.roots[n] + shifts[n] * up(n) +
                                                     at[bodies.skeleton.limbs[g].shoulder].place + distance * way)));
            }
        }
    }
    Vector3d up(std::uint32_t n) const { return quat(bodies.bodies[n].root_rotation).normalized() * Vector3d::UnitY(); }
    Crowd crowd(swivel_features features = kFitting) const
    {
        std::vector<swivel_limb_joints> joints;
        for (std::size_t n = 0; n < 3; ++n) joints.push_back(bodies.skeleton.joints(n));
        std::vector<swivel_group_def> groups{swivel_default_fit_group_def()};
        groups[0].fit = fit;
        for (const swivel_limb_joints& each : joints) groups.push_back(body_group(each, features));
        Crowd made(bodies.skeleton.view(), bodies.body_count, groups);
        for (std::uint32_t g = 0; g < 3; ++g) made.write(SWIVEL_TARGET, g + 1, targets[g]);
        return made;
    }
    void solve(Crowd& crowd, float time)
    {
        bodies.go_to(0);
        std::ranges::fill(bodies.times, time);
        solve_poses(crowd, bodies.view());
    }
    double shift(const Crowd& crowd, std::uint32_t n) const { return value_of<Float3>(crowd, SWIVEL_SHIFT, 0, n)[0]; }
    // The shift nearest to 0 from which all limbs that count reach.
    double wanted(std::uint32_t n, const std::array<bool, 3>& counts = {true, true, true}) const
    {
        double low = -1e9, high = 1e9;
        const std::vector<JointAt> at = joints_at(bodies.skeleton, bodies.bodies[n]);
        for (std::size_t g = 0; g < 3; ++g) {
            if (!counts[g]) continue;
            const LimbAt limb(bodies.skeleton, bodies.bodies[n], at, bodies.skeleton.limbs[g]);
            const Vector3d away = bodies.roots[n] + at[bodies.skeleton.limbs[g].shoulder].place - vec(targets[g][n]);
            const double height = away.dot(up(n)), across2 = away.squaredNorm() - height * height;
            const double room = std::sqrt(std::max(0.0, limb.length() * limb.length() - across2));
            low = std::max(low, -height - room), high = std::min(high, room - height);
        }
        return std::clamp(std::clamp(0.0, low, std::max(low, high)), -fit.drop * lengths[n], fit.rise * lengths[n]);
    }
};

// But for rounding: of a limb at the very end of its reach, the flag may say that it is clamped.
bool reaches(const Crowd& crowd, std::uint32_t group, std::uint32_t limb)
{
    double residual;
    check(swivel_residuals(crowd.get(), group, limb, 1, {&residual, sizeof residual}));
    return residual <= 1e-5;
}

}  // namespace

TEST_CASE("a body is shifted so that all its limbs reach")
{
    FitStage stage(1);
    Crowd crowd = stage.crowd();
    stage.solve(crowd, 0);
    int far_count = 0;
    for (std::uint32_t n = 0; n < stage.bodies.body_count; ++n) far_count += std::fabs(stage.shift(crowd, n)) > 0.01;
    REQUIRE(far_count > 20);  // in the first solve it is there at once
    for (std::uint32_t n = 0; n < stage.bodies.body_count; ++n) {
        const std::vector<JointAt> was = joints_at(stage.bodies.skeleton, stage.bodies.bodies[n]),
                                   is = joints_at(stage.bodies.skeleton,
                                                  stage.bodies.poses.read(n, stage.bodies.bodies[n]));
        const double shift = stage.shift(crowd, n);
        REQUIRE(std::fabs(shift - stage.wanted(n)) <= 3e-6 * (1 + stage.bodies.roots[n].norm()));
        REQUIRE(flags_of(crowd, 0, n) == SWIVEL_REACHED);
        for (std::uint32_t g = 0; g < 3; ++g) {
            const BodyLimbJoints& joints = stage.bodies.skeleton.limbs[g];
            const LimbAt limb(stage.bodies.skeleton, stage.bodies.bodies[n], was, joints);
            const Vector3d wrist = stage.bodies.roots[n] + shift * stage.up(n) + is[joints.wrist].place;
            // At the very end of its reach a limb may lack the shift's rounding.
            const double rounding = 1e-6 * (1 + stage.bodies.roots[n].norm());
            REQUIRE((wrist - vec(stage.targets[g][n])).norm() <= limb.wrist_bound() + rounding);
        }
    }
}

TEST_CASE("a shift that is not there yet comes by a critically damped spring")
{
    FitStage stage(2);
    stage.fit.half = 0.15f;
    Crowd crowd = stage.crowd();
    for (std::uint32_t g = 1; g <= 3; ++g) crowd.write_all(SWIVEL_FIT_WEIGHT, g, 0.0f);
    stage.solve(crowd, 0);
    for (std::uint32_t n = 0; n < stage.bodies.body_count; ++n) REQUIRE(stage.shift(crowd, n) == 0);
    for (std::uint32_t g = 1; g <= 3; ++g) crowd.write_all(SWIVEL_FIT_WEIGHT, g, 1.0f);
    const double k = 1.6783469900166605 / 0.15;
    const float time = 1 / 60.0f;
    for (int frame = 1; frame <= 60; ++frame) {
        stage.solve(crowd, time);
        const double x = k * frame * double{time}, done = 1 - (1 + x) * std::exp(-x);
        for (std::uint32_t n = 0; n < stage.bodies.body_count; ++n) {
            const double to = stage.wanted(n);
            REQUIRE(std::fabs(stage.shift(crowd, n) - done * to) <= 1e-5 * (1 + std::fabs(to)));
        }
    }
}

TEST_CASE("with no half time a shift is there at once, and time 0 changes none")
{
    FitStage stage(3);
    stage.fit.half = 0;
    Crowd crowd = stage.crowd();
    for (std::uint32_t g = 1; g <= 3; ++g) crowd.write_all(SWIVEL_FIT_WEIGHT, g, 0.0f);
    stage.solve(crowd, 0.01f);
    for (std::uint32_t g = 1; g <= 3; ++g) crowd.write_all(SWIVEL_FIT_WEIGHT, g, 1.0f);
    stage.solve(crowd, 0);
    for (std::uint32_t n = 0; n < stage.bodies.body_count; ++n) REQUIRE(stage.shift(crowd, n) == 0);
    stage.solve(crowd, 0.01f);
    for (std::uint32_t n = 0; n < stage.bodies.body_count; ++n) {
        REQUIRE(flags_of(crowd, 0, n) == SWIVEL_REACHED);
        REQUIRE(std::fabs(stage.shift(crowd, n) - stage.wanted(n)) <= 3e-6 * (1 + stage.bodies.roots[n].norm()));
    }
}

TEST_CASE("a shift out of drop and rise is flagged, and a wish is followed as far as limbs allow")
{
    FitStage stage(4);
    stage.fit.drop = stage.fit.rise = 0.02f;
    Crowd crowd = stage.crowd();
    stage.solve(crowd, 0);
    int far_count = 0;
    for (std::uint32_t n = 0; n < stage.bodies.body_count; ++n) {
        const double most = 0.02 * stage.lengths[n];
        REQUIRE(std::fabs(stage.shift(crowd, n)) <= most * 1.000001);
        bool all = true;
        for (std::uint32_t g = 1; g <= 3; ++g) all &= reaches(crowd, g, n);
        REQUIRE((flags_of(crowd, 0, n) == SWIVEL_CLAMPED_FAR) == !all);
        far_count += !all;
    }
    REQUIRE(far_count > 10);
    FitStage free(5);
    Crowd wishing = free.crowd();
    for (std::uint32_t g = 1; g <= 3; ++g) wishing.write_all(SWIVEL_FIT_WEIGHT, g, 0.0f);
    wishing.write_all(SWIVEL_SHIFT_WISH, 0, -0.01f);
    free.solve(wishing, 0);
    for (std::uint32_t n = 0; n < free.bodies.body_count; ++n) REQUIRE(free.shift(wishing, n) == -0.01f);
}

TEST_CASE("a limb with bad input does not count, and costs no other a bit")
{
    struct Fault {
        swivel_field field;
        Float3 value;
        swivel_features needs = 0;
    };
    const Fault faults[] = {{SWIVEL_TARGET, {kNan, 0, 0}},
                            {SWIVEL_LENGTHS, {-1, 1, 0}},
                            {SWIVEL_LENGTHS, {kInf, 1, 0}},
                            {SWIVEL_FIT_WEIGHT, {kNan, 0, 0}},
                            {SWIVEL_FIT_WEIGHT, {2, 0, 0}},
                            {SWIVEL_COMING, {kNan, 0, 0}, SWIVEL_WITH_COMING},
                            {SWIVEL_COMING_TIME, {-1, 0, 0}, SWIVEL_WITH_COMING},
                            {SWIVEL_CAP, {kNan, 0, 0}, SWIVEL_WITH_CAP},
                            {SWIVEL_EFFECTOR, {kNan, 0, 0}, SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_HAND}};
    for (const Fault& fault : faults) {
        FitStage stage(6);
        Crowd crowd = stage.crowd(kFitting | fault.needs), other = stage.crowd(kFitting | fault.needs);
        check(swivel_write(crowd.get(), fault.field, 2, 17, 1, {&fault.value, sizeof fault.value}));
        const float none = 0;
        check(swivel_write(other.get(), SWIVEL_FIT_WEIGHT, 2, 17, 1, {&none, sizeof none}));
        stage.solve(other, 0);
        const PoseBuffer wanted = stage.bodies.poses;
        stage.solve(crowd, 0);
        INFO(swivel_component_count(fault.field, ~swivel_features{0}) << " numbers, field " << fault.field);
        CHECK(flags_of(crowd, 2, 17) == SWIVEL_BAD_INPUT);
        for (std::uint32_t g = 0; g <= 3; ++g)
            for (std::uint32_t n = 0; n < stage.bodies.body_count; ++n)
                if (g != 2 || n != 17) CHECK(flags_of(crowd, g, n) == flags_of(other, g, n));
        CHECK(stage.shift(crowd, 17) == stage.shift(other, 17));
        for (const std::uint32_t limb : {0u, 2u}) {
            const std::size_t at = 17 * wanted.body_stride + stage.bodies.skeleton.limbs[limb].shoulder * 16;
            CHECK(std::memcmp(&wanted.bytes[at], &stage.bodies.poses.bytes[at], 16) == 0);
        }
    }
}

TEST_CASE("bad input of a shift is the shift's alone, which then stays")
{
    FitStage stage(7);
    Crowd crowd = stage.crowd();
    stage.solve(crowd, 0);
    using Bits = std::array<std::uint32_t, 3>;
    const Bits before = value_of<Bits>(crowd, SWIVEL_SHIFT, 0, 17);
    const float bad = kNan;
    check(swivel_write(crowd.get(), SWIVEL_SHIFT_WISH, 0, 17, 1, {&bad, sizeof bad}));
    stage.solve(crowd, 1 / 60.0f);
    CHECK(flags_of(crowd, 0, 17) == SWIVEL_BAD_INPUT);
    CHECK(value_of<Bits>(crowd, SWIVEL_SHIFT, 0, 17) == before);
    for (std::uint32_t g = 1; g <= 3; ++g) CHECK(!(flags_of(crowd, g, 17) & SWIVEL_BAD_INPUT));
    for (std::uint32_t n = 0; n < stage.bodies.body_count; ++n)
        if (n != 17) CHECK(flags_of(crowd, 0, n) == SWIVEL_REACHED);
}

TEST_CASE("a coming target is prepared for the nearer it is")
{
    FitStage stage(8);
    Crowd crowd = stage.crowd(kFitting | SWIVEL_WITH_COMING);
    // The limbs' own wrists are their targets, so only what is coming shifts.
    for (std::uint32_t g = 0; g < 3; ++g) {
        crowd.write(SWIVEL_COMING, g + 1, stage.targets[g]);
        std::vector<Float3> own;
        for (const Body& body : stage.bodies.bodies) own.push_back(own_goal(stage.bodies.skeleton, body, g).target);
        crowd.write(SWIVEL_TARGET, g + 1, own);
        crowd.write_all(SWIVEL_FIT_WEIGHT, g + 1, g == 0 ? 1.0f : 0.0f);
    }
    std::vector<double> last(stage.bodies.body_count);
    int shifted_count = 0;
    for (const float time : {0.31f, 0.3f, 0.2f, 0.1f, 0.0f}) {
        for (std::uint32_t g = 1; g <= 3; ++g) crowd.write_all(SWIVEL_COMING_TIME, g, g == 1 ? time : 1e15f);
        check(swivel_reset(crowd.get(), 0, 0, stage.bodies.body_count));
        stage.solve(crowd, 0);
        const double near = std::max(0.0, 1 - double{time} / stage.fit.ahead);
        for (std::uint32_t n = 0; n < stage.bodies.body_count; ++n) {
            const double shift = stage.shift(crowd, n), whole = stage.wanted(n, {true, false, false});
            if (near == 0) REQUIRE(shift == 0);
            REQUIRE(std::fabs(shift) >= last[n] - 1e-7);
            REQUIRE(std::fabs(shift) <= std::fabs(near * near * whole) + 3e-6 * (1 + stage.bodies.roots[n].norm()));
            last[n] = std::fabs(shift);
            shifted_count += near > 0 && std::fabs(shift) > 1e-3;
        }
    }
    REQUIRE(shifted_count > 10);
}

TEST_CASE("a capped limb gets straighter by its margin at most, and reaches what is no farther than it came")
{
    FitStage stage(9);
    Crowd crowd = stage.crowd(kFitting | SWIVEL_WITH_CAP);
    Random random{10};
    std::vector<std::vector<double>> shares(3);
    for (std::uint32_t g = 0; g < 3; ++g) {
        std::vector<Float3> targets;
        for (std::uint32_t n = 0; n < stage.bodies.body_count; ++n) {
            const Body& body = stage.bodies.bodies[n];
            const std::vector<JointAt> at = joints_at(stage.bodies.skeleton, body);
            const BodyLimbJoints& joints = stage.bodies.skeleton.limbs[g];
            const Vector3d shoulder = at[joints.shoulder].place;
            const double comes = (at[joints.wrist].place - shoulder).norm(), share = random.between(0.8, 1.5);
            shares[g].push_back(share);
            targets.push_back(floats(Vector3d(stage.bodies.roots[n] + shoulder + share * comes * random.direction())));
        }
        crowd.write(SWIVEL_TARGET, g + 1, targets);
        crowd.write_all(SWIVEL_CAP, g + 1, Float3{0.01f, 0, 0});
        crowd.write_all(SWIVEL_FIT_WEIGHT, g + 1, 0.0f);
    }
    stage.solve(crowd, 0);
    int capped_count = 0;
    for (std::uint32_t n = 0; n < stage.bodies.body_count; ++n) {
        const std::vector<JointAt> was = joints_at(stage.bodies.skeleton, stage.bodies.bodies[n]),
                                   is = joints_at(stage.bodies.skeleton,
                                                  stage.bodies.poses.read(n, stage.bodies.bodies[n]));
        for (std::uint32_t g = 0; g < 3; ++g) {
            const BodyLimbJoints& joints = stage.bodies.skeleton.limbs[g];
            const LimbAt limb(stage.bodies.skeleton, stage.bodies.bodies[n], was, joints);
            const double comes = (was[joints.wrist].place - was[joints.shoulder].place).norm(),
                         goes = (is[joints.wrist].place - is[joints.shoulder].place).norm();
            const std::uint32_t flags = flags_of(crowd, g + 1, n);
            REQUIRE(goes <= comes + 0.01 * limb.length() + limb.wrist_bound());
            if (shares[g][n] < 0.9999 && shares[g][n] * comes > std::fabs(limb.upper - limb.fore))
                REQUIRE((flags & SWIVEL_REACHED) != 0);
            if (shares[g][n] * comes > comes + 0.021 * limb.length()) {
                REQUIRE((flags & SWIVEL_CLAMPED_FAR) != 0);
                ++capped_count;
            }
        }
    }
    REQUIRE(capped_count > 20);
}

TEST_CASE("shifts, plants and ground that cannot be get a line")
{
    FitStage stage(11);
    const swivel_skeleton view = stage.bodies.skeleton.view();
    const swivel_limb_joints joints[] = {stage.bodies.skeleton.joints(0), stage.bodies.skeleton.joints(1)};
    std::vector<swivel_group_def> groups;
    swivel_crowd_def def = swivel_default_crowd_def();
    constexpr swivel_features kStanding = kPlanted | SWIVEL_WITH_EFFECTOR | SWIVEL_HAND_YIELDS | SWIVEL_WITH_GROUND;
    const auto start = [&] {
        groups = {swivel_default_fit_group_def(), body_group(joints[0], kFitting), body_group(joints[1], kStanding)};
        def = swivel_default_crowd_def();
        def.skeleton = &view, def.body_count = 2;
    };
    const auto refused = [&](const char* words = "") {
        def.groups = groups.data(), def.group_count = static_cast<std::uint32_t>(groups.size());
        swivel_crowd* crowd = nullptr;
        CHECK_REFUSED(swivel_crowd_create(&def, &crowd), SWIVEL_INVALID_ARGUMENT);
        CHECK_THAT(swivel_last_error(), Catch::Contains(words));
        CHECK(crowd == nullptr);
        CHECK(swivel_crowd_bytes(&def) == 0);
    };
    start();
    def.groups = groups.data(), def.group_count = 3;
    Crowd good(def);
    SECTION("two shifts") { groups.push_back(swivel_default_fit_group_def()), refused(); }
    SECTION("a shift for no limb") { groups.erase(groups.begin() + 1), refused(); }
    SECTION("a limb without a shift") { groups.erase(groups.begin()), refused(); }
    SECTION("a shift with joints") { groups[0].joints = &joints[1], groups.pop_back(), refused(); }
    SECTION("a shift with a limb's feature") { groups[0].features |= SWIVEL_WITH_HAND, refused(); }
    SECTION("an axis of no length") { std::ranges::fill(def.up, 0.0f), refused(); }
    SECTION("an axis that is none") { def.up[1] = kNan, refused(); }
    SECTION("bad constants")
    {
        for (const float bad : {-1.0f, kNan, kInf, 1001.0f}) {
            for (float swivel_fit::*const each :
                 {&swivel_fit::drop, &swivel_fit::rise, &swivel_fit::half, &swivel_fit::ahead})
                start(), groups[0].fit.*each = bad, refused();
            for (float swivel_plant::*const each : {&swivel_plant::lock, &swivel_plant::unlock, &swivel_plant::stop,
                                                    &swivel_plant::blend, &swivel_plant::again, &swivel_plant::run})
                start(), groups[2].plant.*each = bad, refused();
            start(), groups[2].plant.speed[1] = bad, refused();
        }
        for (const float bad : {-1001.0f, kNan, kInf}) start(), groups[2].plant.height[0] = bad, refused();
        for (const float bad : {-1.0f, kNan, kInf}) start(), groups[2].plant.longest = bad, refused();
        start(), groups[2].plant.run = 1.01f, refused();
        for (const float bad : {kNan, kInf, -0.01f, 2e15f})
            for (float swivel_ground::*const each : {&swivel_ground::toe_clearance, &swivel_ground::heel_clearance,
                                                     &swivel_ground::half, &swivel_ground::cos_most})
                start(), groups[2].ground.*each = bad, refused("group 2, ground.");
        for (const float bad : {kNan, kInf, 2e15f})
            for (float& each : groups[2].ground.heel) start(), each = bad, refused("group 2, ground.heel is ");
        start(), groups[2].ground.cos_most = 1.001f;
        refused("group 2, ground.cos_most is 1.001; it is 0 to 1");
    }
    SECTION("features that do not go together")
    {
        for (const swivel_features bad :
             {SWIVEL_WITH_PLANT | SWIVEL_WITH_AIM, SWIVEL_WITH_PLANT_TURN | SWIVEL_WITH_HAND, SWIVEL_PLANT_BY_MOTION,
              SWIVEL_WITH_PLANT | SWIVEL_WITH_PLANT_TURN, SWIVEL_WITH_CAP | SWIVEL_WITH_REACH,
              SWIVEL_WITH_CAP | SWIVEL_WITH_AIM, SWIVEL_WITH_COMING, SWIVEL_WITH_FIT | SWIVEL_WITH_AIM})
            start(), groups[2] = body_group(joints[1], bad), refused();
        start(), groups[2].features &= ~(SWIVEL_WITH_EFFECTOR | SWIVEL_HAND_YIELDS), refused("WITH_EFFECTOR");
        start(), groups[2].features &= ~SWIVEL_WITH_PLANT, refused("WITH_PLANT");
        for (const swivel_features bad : {SWIVEL_WITH_PLANT, SWIVEL_WITH_FIT, SWIVEL_WITH_CAP, SWIVEL_FIT}) {
            const swivel_group_def free = group(1, {}, bad);
            swivel_crowd* crowd = nullptr;
            const swivel_crowd_def of = def_of(free);
            CHECK_REFUSED(swivel_crowd_create(&of, &crowd), SWIVEL_INVALID_ARGUMENT);
        }
    }
}
