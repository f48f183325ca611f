// SPDX-License-Identifier: MIT
//
// Bodies' limbs that keep a record of what their pose gave: forward kinematics, residuals, arcs and explain say of them
// what they say of free limbs.
#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include "tests/body_crowd.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr swivel_features kRecorded = SWIVEL_WITH_RECORD | SWIVEL_WITH_HAND;

struct RecordedBodies {
    BodySkeleton skeleton;
    std::vector<Body> bodies;
    PoseLayout layout;
    PoseBuffer poses;
    BodyGoals goals;
    Crowd crowd;

    RecordedBodies(Random& random, swivel_features features, bool is_reached)
        : skeleton(random_body_skeleton(random, {2 + random.below(5), 1, random.below(3), true})),
          bodies(random_bodies(random)),
          layout{SWIVEL_ROTATIONS, true, true, true, random.below(60)},
          poses(layout, bodies),
          crowd(body_crowd(skeleton, features, static_cast<std::uint32_t>(bodies.size())))
    {
        goals.emplace_back();
        for (const Body& body : bodies) goals[0].push_back(random_goal(random, skeleton, body, 0));
        if (!is_reached)
            for (std::size_t n = 0; n < bodies.size(); ++n)
                for (float& x : goals[0][n].target) x += 100;
        write_goals(crowd, goals);
        if (features & SWIVEL_WITH_CLAVICLE) crowd.write_all(SWIVEL_CLAVICLE, 0, std::array{0.5f});
        solve();
    }
    void solve() { solve_poses(crowd, poses.view()); }
    std::string explained(std::uint32_t body) const
    {
        std::string text(400, ' ');
        check(swivel_explain(crowd.get(), 0, body, text.data(), text.size()));
        return text.substr(0, text.find('\0'));
    }

private:
    std::vector<Body> random_bodies(Random& random)
    {
        std::vector<Body> made;
        for (int n = 0; n < 18; ++n) made.push_back(random_body(random, skeleton, {true, true, true, 2.5}));
        return made;
    }
};

}  // namespace

TEST_CASE("what is kept of a pose")
{
    rc::prop("gives joints and residuals as the solved pose has them", [](std::uint64_t seed) {
        Random random{seed};
        const swivel_features clavicle = random.below(2) ? SWIVEL_WITH_CLAVICLE : 0;
        const RecordedBodies solved(random, kRecorded | clavicle, random.below(4) != 0);
        const auto count = static_cast<std::uint32_t>(solved.bodies.size());
        std::vector<std::array<double, 3>> elbows(count), wrists(count);
        std::vector<std::array<double, 4>> hands(count);
        std::vector<double> residuals(count);
        const auto out = [](auto& values) { return swivel_out{values.data(), sizeof values[0]}; };
        check(swivel_forward(solved.crowd.get(), 0, 0, count, out(elbows), out(wrists), out(hands)));
        check(swivel_residuals(solved.crowd.get(), 0, 0, count, out(residuals)));
        const BodyLimbJoints& limb = solved.skeleton.limbs[0];
        for (std::uint32_t n = 0; n < count; ++n) {
            const Body body = solved.poses.read(n, solved.bodies[n]);
            const std::vector<JointAt> at = joints_at(solved.skeleton, body);
            const Vector3d root = vec(body.root_position), wrist = root + at[limb.wrist].place;
            const double length = (at[limb.elbow].place - at[limb.shoulder].place).norm() +
                                  (at[limb.wrist].place - at[limb.elbow].place).norm();
            const double way = way_to(solved.skeleton, at, limb.wrist), bound = 1e-5 * (way + root.norm());
            RC_ASSERT((Eigen::Map<const Vector3d>(elbows[n].data()) - root - at[limb.elbow].place).norm() <= bound);
            RC_ASSERT((Eigen::Map<const Vector3d>(wrists[n].data()) - wrist).norm() <= bound);
            RC_ASSERT(Quaterniond(hands[n].data()).angularDistance(at[limb.wrist].rotation) <= 1e-5);
            const double missed = (wrist - vec(solved.goals[0][n].target)).norm() / length;
            const double length_error = 1e-6 * length + 2e-7 * way;  // floats of the way are rounded, too
            RC_ASSERT(std::fabs(residuals[n] - missed) * length <= bound + length_error * missed);
        }
    });
}

TEST_CASE("explain says of a body's limb what happened")
{
    Random random{5};
    RecordedBodies reached(random, kRecorded, true);
    const BodyLimbJoints& limb = reached.skeleton.limbs[0];
    CHECK_THAT(reached.explained(3), Catch::Contains("The target is reached"));
    const Float3 far = {100, 0, 0};
    check(swivel_write(reached.crowd.get(), SWIVEL_TARGET, 0, 3, 1, {&far, 0}));
    CHECK_THAT(reached.explained(3), Catch::StartsWith("Its inputs changed since it was solved"));
    reached.bodies[3].rotations[0] = {0, 0, 0, 0};
    reached.poses.write(3, reached.bodies[3]);
    reached.solve();
    CHECK_THAT(reached.explained(3), Catch::StartsWith("Bad input: in the pose, a rotation"));
    CHECK_THAT(reached.explained(3), Catch::Contains("keeps its incoming pose"));
    CHECK_THAT(reached.explained(4), Catch::StartsWith("The target is reached"));
    reached.bodies[4].rotations[limb.wrist] = {0, 0, std::nanf(""), 0};
    reached.poses.write(4, reached.bodies[4]);
    reached.solve();
    CHECK_THAT(reached.explained(4), Catch::StartsWith("Bad input: in the pose, a rotation"));
    CHECK(reached.explained(5).find("The target is reached") == 0);
    RecordedBodies without_hands(random, SWIVEL_WITH_RECORD, true);
    without_hands.bodies[4].rotations[without_hands.skeleton.limbs[0].wrist] = {0, 0, std::nanf(""), 0};
    without_hands.poses.write(4, without_hands.bodies[4]);
    without_hands.solve();
    CHECK_THAT(without_hands.explained(4), Catch::StartsWith("Bad input: in the pose, a rotation"));
    const RecordedBodies missed(random, kRecorded, false);
    CHECK_THAT(missed.explained(3), Catch::Contains("out of reach"));
}

TEST_CASE("limits of a body's limb have arcs and reasons")
{
    Random random{8};
    RecordedBodies bodies(random, kRecorded | SWIVEL_WITH_SHOULDER_CONE, true);
    bodies.crowd.write_all(SWIVEL_SHOULDER_CONE, 0, cone({0, 0, -1}, 0.01));
    bodies.solve();
    std::uint32_t count = 0;
    REQUIRE(swivel_allowed_arcs(bodies.crowd.get(), 0, 2, nullptr, 0, &count) == SWIVEL_OK);
    CHECK(count == 0);
    CHECK_THAT(bodies.explained(2), Catch::Contains("No place of the elbow keeps shoulder_cone"));
    bodies.crowd.write_all(SWIVEL_SHOULDER_CONE, 0, cone({0, 0, -1}, 3.1415));
    REQUIRE(swivel_allowed_arcs(bodies.crowd.get(), 0, 2, nullptr, 0, &count) == SWIVEL_OK);
    CHECK(count > 0);
}

TEST_CASE("explain says that a body was never solved")
{
    Random random{5};
    const BodySkeleton skeleton = random_body_skeleton(random, {2, 1, 0, true});
    const Crowd crowd = body_crowd(skeleton, kRecorded, 3);
    std::array<char, 100> text;
    check(swivel_explain(crowd.get(), 0, 1, text.data(), text.size()));
    CHECK_THAT(text.data(), Catch::StartsWith("It was never solved"));
}
