// SPDX-License-Identifier: MIT
//
// The promise: a limb meets its goals, by forward kinematics in Eigen. These are effectors, hands, turns of the swivel,
// planes, incoming poses and blends with them.
#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include "tests/formula_limb.h"
#include "tests/limit_oracle.h"

namespace {

using namespace swivel;
using namespace swivel::test;

// How far a direction is from the plane's wanted normal.
double off(const Vector3d& hinge, const Vector3d& normal) { return (hinge - normal).norm(); }

template <class Check>
void for_arms(const std::string& promise, Check check)
{
    rc::prop(promise, [&](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < 200; ++n) check(random, random_reachable(random));
    });
}

struct Incoming {
    Quaterniond shoulder, elbow, wrist;

    Vector3d wrist_place(const Arm& arm) const
    {
        return shoulder * Vector3d(0, 0, arm.upper) + shoulder * elbow * Vector3d(0, 0, arm.fore);
    }
};
Incoming random_incoming(Random& random)
{
    return {random.rotation(),
            Quaterniond(Eigen::AngleAxisd(-random.between(0.3, 2.5), Vector3d::UnitX())) *
                Quaterniond(Eigen::AngleAxisd(random.between(-0.3, 0.3), Vector3d::UnitZ())),
            random.rotation()};
}
template <class T>
IncomingPose<T> incoming_of(const Incoming& pose)
{
    return {mv<T>(pose.shoulder), mv<T>(pose.elbow), mv<T>(pose.wrist)};
}

}  // namespace

TEST_CASE("everything on and at rest changes nothing")
{
    LimbUse all;
    all.hand = all.effector = all.angle = all.incoming = all.weights = all.reach = all.continuity = true;
    LimitUse& limits = all.limits;
    limits.flexion = limits.shoulder_cone = limits.hand_cone = limits.humeral_twist = limits.forearm_twist =
        limits.hand_twist = limits.shoulder_box = limits.wrist_box = true;
    for_arms("the arm is the plain solver's", [&](Random&, const Arm& arm) {
        const Solved<float> got = solve(all, limb_goal<float>(arm));
        const ArmPose<float> plain = solve<float>(arm);
        // Each solver's cross product knows the plane to 4.4e-7 over the sine of the pole's angle, the most of a
        // billion plain arms and 100 million limbs. In the plane elbows were 4.2e-7 apart at most, of 80,000 arms.
        const Vector3d apart = got.elbow - elbow_place(plain, arm);
        const double sine = arm.wrist.normalized().cross(arm.pole.normalized()).norm();
        const double across = apart.dot(arm.normal());
        RC_ASSERT(std::fabs(across) <= 1e-6 / sine * arm.upper);
        RC_ASSERT((apart - across * arm.normal()).norm() <= 1e-6 * arm.length());
        RC_ASSERT((got.wrist - wrist_place(plain, arm)).norm() <= 1e-6 * arm.length());
        RC_ASSERT(got.pose.arm.flags == SWIVEL_REACHED);
    });
}

TEST_CASE("effectors and hands")
{
    for_arms("the effector is at the target, the hand as wanted", [](Random& random, const Arm& arm) {
        LimbUse use;
        use.hand = use.effector = true;
        const Quaterniond hand = random.rotation();
        const Vector3d effector = random.vector(0, 0.3);
        LimbGoal<float> goal = limb_goal<float>(arm);
        goal.arm.wrist = mv<float>(Vector3d(arm.wrist + hand * effector));
        goal.hand = mv<float>(Quaterniond(random.spread(0.1, 10) * hand.coeffs()));
        goal.effector = mv<float>(effector);
        const Solved<float> got = solve(use, goal);
        RC_ASSERT((got.wrist + got.hand * effector - eigen(goal.arm.wrist)).norm() <= 2e-6 * arm.length());
        RC_ASSERT(distance(got.hand, hand) <= 1e-6);
    });
}

TEST_CASE("where the elbow goes")
{
    for_arms("a turn from the pole's side, by the right hand about the line to the wrist",
             [](Random& random, const Arm& arm) {
                 LimbUse use;
                 use.angle = true;
                 const double angle = random.between(-kPi, kPi), size = random.spread(1e-3, 1e3);
                 LimbGoal<float> goal = limb_goal<float>(arm);
                 goal.angle = {static_cast<float>(size * std::cos(angle)), static_cast<float>(size * std::sin(angle))};
                 const Vector3d want = Eigen::AngleAxisd(angle, arm.wrist.normalized()) * arm.normal();
                 RC_ASSERT(off(solve(use, goal).hinge, want) <= 3e-6);
             });
    for_arms("a plane's normal", [](Random& random, const Arm& arm) {
        LimbUse use;
        use.wish = Wish::normal;
        LimbGoal<float> goal = limb_goal<float>(arm);
        const Vector3d line = arm.wrist.normalized(), tilted = arm.normal() + random.between(-2, 2) * line;
        goal.arm.pole = mv<float>(Vector3d(random.spread(1e-3, 1e3) * tilted));
        RC_ASSERT(off(solve(use, goal).hinge, arm.normal()) <= 3e-6);
    });
    for_arms("as in the incoming pose", [](Random& random, const Arm& arm) {
        LimbUse use;
        use.incoming = true, use.wish = Wish::incoming;
        const Incoming pose = random_incoming(random);
        const Vector3d line = arm.wrist.normalized(), hinge = pose.shoulder * Vector3d::UnitX();
        const Vector3d across = hinge - hinge.dot(line) * line;
        if (across.norm() < 0.05) return;
        LimbGoal<float> goal = limb_goal<float>(arm);
        goal.incoming = incoming_of<float>(pose);
        RC_ASSERT(off(solve(use, goal).hinge, across.normalized()) <= 1e-5);
    });
    for_arms("where the wrist of a hand is not bent, whatever its roll", [](Random& random, const Arm& arm) {
        LimbUse use;
        use.hand = true, use.wish = Wish::hand;
        const Vector3d fore = arm.wrist - arm.elbow(), line = arm.wrist.normalized();
        const double sine = fore.cross(line).norm() / fore.norm();
        if (sine < 0.01) return;
        const Quaterniond hand = Quaterniond::FromTwoVectors(Vector3d::UnitZ(), fore) *
                                 Eigen::AngleAxisd(random.between(-kPi, kPi), Vector3d::UnitZ());
        LimbGoal<float> goal = limb_goal<float>(arm);
        goal.hand = mv<float>(Quaterniond(random.spread(0.1, 10) * hand.coeffs()));
        RC_ASSERT(off(solve(use, goal).hinge, arm.normal()) <= 1e-6 / sine + 3e-6);
        // The incoming pose counts within 20 degrees of the line, and alone along it.
        use.incoming = true;
        const Incoming pose = random_incoming(random);
        const Vector3d hinge = pose.shoulder * Vector3d::UnitX(), across = hinge - hinge.dot(line) * line;
        if (across.norm() < 0.05) return;
        goal.incoming = incoming_of<float>(pose);
        const Vector3d want =
            (sine * arm.normal() + std::max(std::sin(20 * kPi / 180) - sine, 0.0) * across.normalized());
        if (want.norm() < 0.01) return;
        RC_ASSERT(off(solve(use, goal).hinge, want.normalized()) <= 1e-3);
        goal.hand = mv<float>(Quaterniond::FromTwoVectors(Vector3d::UnitZ(), line));
        RC_ASSERT(off(solve(use, goal).hinge, across.normalized()) <= 1e-4);
    });
    for_arms("where the pole does not say: the incoming pose, or the previous normal first",
             [](Random& random, const Arm& arm) {
                 LimbUse use;
                 use.incoming = true;
                 const Incoming pose = random_incoming(random);
                 const Vector3d line = arm.wrist.normalized(), hinge = pose.shoulder * Vector3d::UnitX();
                 const Vector3d across = hinge - hinge.dot(line) * line, previous = random.across(line);
                 if (across.norm() < 0.05) return;
                 LimbGoal<float> goal = limb_goal<float>(arm);
                 goal.arm.pole = mv<float>(Vector3d(random.between(-2, 2) * line));
                 goal.incoming = incoming_of<float>(pose);
                 const Solved<float> by_pose = solve(use, goal);
                 RC_ASSERT(off(by_pose.hinge, across.normalized()) <= 1e-5);
                 RC_ASSERT(by_pose.pose.arm.flags == (SWIVEL_REACHED | SWIVEL_SWIVEL_UNDEFINED));
                 use.continuity = true;
                 goal.continuity.previous_normal = mv<float>(previous);
                 RC_ASSERT(off(solve(use, goal).hinge, previous) <= 1e-5);
             });
}

TEST_CASE("weights blend with the incoming pose")
{
    LimbUse use;
    use.hand = use.incoming = use.weights = true;
    for_arms("0 keeps its wrist, hand and swivel", [&](Random& random, const Arm& arm) {
        Incoming pose = random_incoming(random);
        pose.elbow = Quaterniond(Eigen::AngleAxisd(-random.between(0.3, 2.5), Vector3d::UnitX()));  // the hinge alone
        LimbGoal<float> goal = limb_goal<float>(arm);
        goal.incoming = incoming_of<float>(pose);
        goal.hand = mv<float>(random.rotation());
        goal.weights = {0, 0, 0};
        const Solved<float> got = solve(use, goal);
        RC_ASSERT((got.wrist - pose.wrist_place(arm)).norm() <= 2e-6 * arm.length());
        RC_ASSERT((got.elbow - pose.shoulder * Vector3d(0, 0, arm.upper)).norm() <= 1e-5 * arm.length());
        RC_ASSERT(distance(got.hand, pose.shoulder * pose.elbow * pose.wrist) <= 3e-6);
    });
    for_arms("1 takes the target itself, however near the shoulder it is", [](Random& random, const Arm& arm) {
        LimbUse without, with;
        without.incoming = with.incoming = with.weights = true;
        const double distance_wanted = arm.length() * random.spread(1e-12, 1);
        Arm near = arm;
        near.wrist *= distance_wanted / arm.wrist.norm();
        LimbGoal<float> goal = limb_goal<float>(rounded(near));
        goal.incoming = incoming_of<float>(random_incoming(random));
        const ArmPose<float> want = solve(without, goal).pose.arm, got = solve(with, goal).pose.arm;
        RC_ASSERT(distance(eigen(got.shoulder), eigen(want.shoulder)) <= 1e-6);
        RC_ASSERT(got.cos_half == want.cos_half && got.sin_half == want.sin_half && got.flags == want.flags);
    });
    for_arms("between: the wrist on the straight way, the hand and the swivel between the two", [&](Random& random,
                                                                                                    const Arm& arm) {
        const Incoming pose = random_incoming(random);
        const Quaterniond hand = random.rotation(), hand_was = pose.shoulder * pose.elbow * pose.wrist;
        LimbGoal<float> goal = limb_goal<float>(arm);
        goal.incoming = incoming_of<float>(pose);
        goal.hand = mv<float>(hand);
        const double w = static_cast<float>(random.unit());
        goal.weights = {static_cast<float>(w), static_cast<float>(w), 1};
        const Solved<float> got = solve(use, goal);
        const Vector3d was = pose.wrist_place(arm), place = was + w * (arm.wrist - was);
        if (got.pose.arm.flags & SWIVEL_REACHED) RC_ASSERT((got.wrist - place).norm() <= 3e-6 * arm.length());
        const double whole = hand_was.angularDistance(hand);
        if (whole > 3) return;
        RC_ASSERT(std::fabs(hand_was.angularDistance(got.hand) + got.hand.angularDistance(hand) - whole) <= 1e-4);
    });
    for_arms("half of a pole's weight: the middle of the two planes", [&](Random& random, const Arm& arm) {
        const Incoming pose = random_incoming(random);
        const Vector3d line = arm.wrist.normalized(), hinge = pose.shoulder * Vector3d::UnitX();
        const Vector3d was = (hinge - hinge.dot(line) * line).normalized(), middle = was + arm.normal();
        if ((hinge - hinge.dot(line) * line).norm() < 0.05 || middle.norm() < 0.1) return;
        LimbGoal<float> goal = limb_goal<float>(arm);
        goal.incoming = incoming_of<float>(pose);
        goal.weights = {1, 1, 0.5f};
        RC_ASSERT(off(solve(use, goal).hinge, middle.normalized()) <= 1e-4);
    });
}

TEST_CASE("a limit of flexion that stretching makes up for is not said; an arm of no length reaches nothing")
{
    LimbUse use;
    use.reach = use.limits.flexion = true;
    LimbGoal<float> goal = limb_goal<float>(rounded(Arm{{0, 0, 1.95}, {0, -1, 0}, 1, 1}));
    goal.limits.flexion = {0.9f, 0};
    CHECK(solve(use, goal).pose.arm.flags == (SWIVEL_CLAMPED_FAR | SWIVEL_LIMITED_FLEXION));
    goal.reach.most_stretch = 3;
    CHECK(solve(use, goal).pose.arm.flags == (SWIVEL_REACHED | SWIVEL_STRETCHED));
    goal = limb_goal<float>(rounded(Arm{{0, 0, 10}, {0, -1, 0}, 0, 0}));
    goal.reach.most_stretch = 100;
    const Solved<float> nothing = solve(use, goal);
    CHECK(nothing.pose.arm.flags == SWIVEL_CLAMPED_FAR);
    CHECK(nothing.pose.stretch == 1);
}
