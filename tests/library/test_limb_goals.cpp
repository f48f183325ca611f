// SPDX-License-Identifier: MIT
//
// The promise: a limb meets its goals, by forward kinematics in Eigen. These are effectors, hands, turns of the swivel,
// planes, incoming poses and blends with them. A hand that may yield does so where its wrist misses its place.
#include <catch2/catch.hpp>

#include <optional>

#include <rapidcheck/catch.h>

#include "tests/limit_oracle.h"
#include "tests/test_arm.h"

namespace {

using namespace swivel;
using namespace swivel::test;

template <class Check>
void for_arms(const std::string& promise, Check check)
{
    rc::prop(promise, [&](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < 100; ++n) check(random, random_reachable(random));
    });
}
// A quaternion of any length that means a rotation.
Float4 any_length(Random& random, const Quaterniond& q)
{
    return floats(Quaterniond(random.spread(0.1, 10) * q.coeffs()));
}
// Across a line, of length 1; none where a direction is nearly along it.
std::optional<Vector3d> across(const Vector3d& line, const Vector3d& direction)
{
    const Vector3d v = direction - direction.dot(line) * line;
    if (v.norm() < 0.05) return {};
    return v.normalized();
}

struct Incoming {
    Quaterniond shoulder, elbow, wrist;

    explicit Incoming(Random& random)
        : shoulder(random.rotation()),
          elbow(Quaterniond(Eigen::AngleAxisd(-random.between(0.3, 2.5), Vector3d::UnitX())) *
                Quaterniond(Eigen::AngleAxisd(random.between(-0.3, 0.3), Vector3d::UnitZ()))),
          wrist(random.rotation())
    {
    }
    Vector3d hinge() const { return shoulder * Vector3d::UnitX(); }
    Quaterniond hand() const { return shoulder * elbow * wrist; }
    Vector3d wrist_place(const Arm& arm) const
    {
        return shoulder * Vector3d(0, 0, arm.upper) + shoulder * elbow * Vector3d(0, 0, arm.fore);
    }
    void write(FreeLimb& limb) const
    {
        limb.write(SWIVEL_INCOMING_SHOULDER, floats(shoulder)), limb.write(SWIVEL_INCOMING_ELBOW, floats(elbow));
        if (swivel_field_row_count(limb.crowd.get(), 0, SWIVEL_INCOMING_WRIST))
            limb.write(SWIVEL_INCOMING_WRIST, floats(wrist));
    }
};

}  // namespace

TEST_CASE("effectors and hands")
{
    for_arms("the effector is at the target, the hand as wanted", [](Random& random, const Arm& arm) {
        FreeLimb limb(arm, SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR);
        const Quaterniond hand = random.rotation();
        const Vector3d effector = random.vector(0, 0.3), target = arm.wrist + hand * effector;
        limb.write(SWIVEL_TARGET, floats(target)), limb.write(SWIVEL_EFFECTOR, floats(effector));
        limb.write(SWIVEL_HAND, any_length(random, hand));
        const LimbPose got = limb.solve();
        RC_ASSERT((got.wrist_place() + got.hand() * effector - target).norm() <= 2e-6 * arm.length());
        RC_ASSERT(distance(got.hand(), hand) <= 1e-6);
    });
    // Elsewhere the least turn brings the effector onto the line from the wrist to its target.
    for_arms("a hand yields where its wrist does not get to its place, and there alone",
             [](Random& random, const Arm& arm) {
                 const swivel_features hand = SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_REACH;
                 FreeLimb stiff(arm, hand), yielding(arm, hand | SWIVEL_HAND_YIELDS);
                 const Vector3d target = arm.length() * random.vector(0.05, 2),
                                effector = arm.length() * random.vector(0.05, 0.3);
                 const Quaterniond wanted = random.rotation();
                 const Float4 reach{0.1f, 0.1f, static_cast<float>(random.between(1, 1.3)), 0.2f};
                 for (FreeLimb* const limb : {&stiff, &yielding}) {
                     limb->write(SWIVEL_TARGET, floats(target)), limb->write(SWIVEL_EFFECTOR, floats(effector));
                     limb->write(SWIVEL_HAND, floats(wanted)), limb->write(SWIVEL_REACH, reach);
                 }
                 const LimbPose want = stiff.solve(), got = yielding.solve();
                 RC_ASSERT(got.flags == want.flags);
                 RC_ASSERT(got.shoulder.coeffs() == want.shoulder.coeffs());
                 RC_ASSERT(got.elbow.coeffs() == want.elbow.coeffs());
                 if (got.flags & SWIVEL_REACHED) {
                     RC_ASSERT(got.wrist.coeffs() == want.wrist.coeffs());
                     return;
                 }
                 const Vector3d stiff_way = want.hand() * effector, line = target - got.wrist_place();
                 const double turn = angle_between(stiff_way, line);
                 if (line.norm() < 0.03 || turn > 3.1) return;  // floats do not know the line, or the turn
                 RC_ASSERT(angle_between(got.hand() * effector, line) < 1e-4);
                 RC_ASSERT(std::fabs(got.hand().angularDistance(want.hand()) - turn) < 1e-4);
             });
}

TEST_CASE("where the elbow goes")
{
    for_arms("a turn from the pole's side, by the right hand about the line to the wrist",
             [](Random& random, const Arm& arm) {
                 FreeLimb limb(arm, SWIVEL_WITH_ANGLE);
                 const double angle = random.between(-kPi, kPi), size = random.spread(1e-3, 1e3);
                 limb.write(SWIVEL_ANGLE, std::array{static_cast<float>(size * std::cos(angle)),
                                                     static_cast<float>(size * std::sin(angle))});
                 const Vector3d want = Eigen::AngleAxisd(angle, arm.wrist.normalized()) * arm.normal();
                 RC_ASSERT((limb.solve().hinge() - want).norm() <= 3e-6);
             });
    for_arms("a plane's normal", [](Random& random, const Arm& arm) {
        FreeLimb limb(arm, SWIVEL_POLE_NORMAL);
        const Vector3d tilted = arm.normal() + random.between(-2, 2) * arm.wrist.normalized();
        limb.write(SWIVEL_POLE, floats(Vector3d(random.spread(1e-3, 1e3) * tilted)));
        RC_ASSERT((limb.solve().hinge() - arm.normal()).norm() <= 3e-6);
    });
    for_arms("as in the incoming pose", [](Random& random, const Arm& arm) {
        FreeLimb limb(arm, SWIVEL_WITH_INCOMING | SWIVEL_POLE_INCOMING);
        const Incoming pose(random);
        pose.write(limb);
        if (const auto want = across(arm.wrist.normalized(), pose.hinge()))
            RC_ASSERT((limb.solve().hinge() - *want).norm() <= 1e-5);
    });
    for_arms("where the wrist of a hand is not bent, whatever its roll", [](Random& random, const Arm& arm) {
        FreeLimb limb(arm, SWIVEL_WITH_HAND | SWIVEL_POLE_HAND);
        const Vector3d fore = arm.wrist - arm.elbow(), line = arm.wrist.normalized();
        const double sine = fore.cross(line).norm() / fore.norm();
        if (sine < 0.01) return;
        const Quaterniond hand = Quaterniond::FromTwoVectors(Vector3d::UnitZ(), fore) *
                                 Eigen::AngleAxisd(random.between(-kPi, kPi), Vector3d::UnitZ());
        limb.write(SWIVEL_HAND, any_length(random, hand));
        RC_ASSERT((limb.solve().hinge() - arm.normal()).norm() <= 1e-6 / sine + 3e-6);
        // The incoming pose counts within 20 degrees of the line, and alone along it.
        FreeLimb posed(arm, SWIVEL_WITH_HAND | SWIVEL_POLE_HAND | SWIVEL_WITH_INCOMING);
        const Incoming pose(random);
        pose.write(posed);
        const auto own = across(line, pose.hinge());
        if (!own) return;
        const Vector3d want = sine * arm.normal() + std::max(std::sin(20 * kPi / 180) - sine, 0.0) * *own;
        if (want.norm() < 0.01) return;
        posed.write(SWIVEL_HAND, floats(hand));
        RC_ASSERT((posed.solve().hinge() - want.normalized()).norm() <= 1e-3);
        posed.write(SWIVEL_HAND, floats(Quaterniond::FromTwoVectors(Vector3d::UnitZ(), line)));
        RC_ASSERT((posed.solve().hinge() - *own).norm() <= 1e-4);
    });
    for_arms("where the pole does not say: the incoming pose, or the previous normal first",
             [](Random& random, const Arm& arm) {
                 const Incoming pose(random);
                 const Vector3d line = arm.wrist.normalized(), previous = random.across(line);
                 const auto own = across(line, pose.hinge());
                 if (!own) return;
                 for (const bool is_carried : {false, true}) {
                     FreeLimb limb(arm, SWIVEL_WITH_INCOMING | (is_carried ? describe(SWIVEL_NORMAL).needs : 0));
                     limb.write(SWIVEL_POLE, floats(Vector3d(random.between(-2, 2) * line)));
                     pose.write(limb);
                     if (is_carried) limb.write(SWIVEL_NORMAL, floats(previous));
                     const LimbPose got = limb.solve();
                     RC_ASSERT((got.hinge() - (is_carried ? previous : *own)).norm() <= 1e-5);
                     RC_ASSERT(got.flags == (SWIVEL_REACHED | SWIVEL_SWIVEL_UNDEFINED));
                 }
             });
}

TEST_CASE("weights blend with the incoming pose")
{
    const swivel_features posed = SWIVEL_WITH_INCOMING | SWIVEL_WITH_WEIGHTS;
    for_arms("0 keeps its wrist, hand and swivel", [=](Random& random, const Arm& arm) {
        FreeLimb limb(arm, posed | SWIVEL_WITH_HAND);
        Incoming pose(random);
        pose.elbow = Quaterniond(Eigen::AngleAxisd(-random.between(0.3, 2.5), Vector3d::UnitX()));  // the hinge alone
        pose.write(limb);
        limb.write(SWIVEL_HAND, floats(random.rotation())), limb.write(SWIVEL_WEIGHTS, Float3{0, 0, 0});
        const LimbPose got = limb.solve();
        RC_ASSERT((got.wrist_place() - pose.wrist_place(arm)).norm() <= 2e-6 * arm.length());
        RC_ASSERT((got.elbow_place() - pose.shoulder * Vector3d(0, 0, arm.upper)).norm() <= 1e-5 * arm.length());
        RC_ASSERT(distance(got.hand(), pose.hand()) <= 3e-6);
    });
    for_arms("1 takes the target itself, however near the shoulder it is", [=](Random& random, Arm arm) {
        arm.wrist *= arm.length() * random.spread(1e-12, 1) / arm.wrist.norm();
        FreeLimb without(rounded(arm), SWIVEL_WITH_INCOMING), with(rounded(arm), posed);
        const Incoming pose(random);
        pose.write(without), pose.write(with);
        with.write(SWIVEL_WEIGHTS, Float3{1, 1, 1});
        const LimbPose want = without.solve(), got = with.solve();
        RC_ASSERT(distance(got.shoulder, want.shoulder) <= 1e-6);
        RC_ASSERT(got.elbow.coeffs() == want.elbow.coeffs());
        RC_ASSERT(got.flags == want.flags);
    });
    for_arms("between: the wrist on the straight way by its weight, the hand between the two by its own",
             [=](Random& random, const Arm& arm) {
                 FreeLimb limb(arm, posed | SWIVEL_WITH_HAND);
                 const Incoming pose(random);
                 pose.write(limb);
                 const Quaterniond hand = random.rotation();
                 const auto weight = [&] { return random.below(4) ? static_cast<float>(random.unit()) : 0.5f; };
                 const Float3 weights{weight(), weight(), 1};
                 limb.write(SWIVEL_HAND, floats(hand)), limb.write(SWIVEL_WEIGHTS, weights);
                 const LimbPose got = limb.solve();
                 const Vector3d own = pose.wrist_place(arm), place = own + double{weights[0]} * (arm.wrist - own);
                 if (got.flags & SWIVEL_REACHED) RC_ASSERT((got.wrist_place() - place).norm() <= 3e-6 * arm.length());
                 const double whole = pose.hand().angularDistance(hand), part = pose.hand().angularDistance(got.hand());
                 if (whole > 3) return;
                 RC_ASSERT(std::fabs(part + got.hand().angularDistance(hand) - whole) <= 1e-4);
                 const double w = double{weights[1]},
                              want = 2 * std::atan2(w * std::sin(whole / 2), 1 - w + w * std::cos(whole / 2));
                 RC_ASSERT(std::fabs(part - want) <= 1e-4);
             });
    for_arms("half of a pole's weight: the middle of the two planes", [=](Random& random, const Arm& arm) {
        FreeLimb limb(arm, posed);
        const Incoming pose(random);
        pose.write(limb);
        limb.write(SWIVEL_WEIGHTS, Float3{1, 1, 0.5f});
        const auto own = across(arm.wrist.normalized(), pose.hinge());
        if (!own || (*own + arm.normal()).norm() < 0.1) return;
        RC_ASSERT((limb.solve().hinge() - (*own + arm.normal()).normalized()).norm() <= 1e-4);
    });
}

TEST_CASE("a limit of flexion that stretching makes up for is not said; an arm of no length reaches nothing")
{
    FreeLimb limb({{0, 0, 1.95}, {0, -1, 0}, 1, 1}, SWIVEL_WITH_REACH | SWIVEL_WITH_FLEXION_LIMIT);
    limb.write(SWIVEL_FLEXION_LIMIT, std::array{0.9f, 0.0f});
    CHECK(limb.solve().flags == (SWIVEL_CLAMPED_FAR | SWIVEL_LIMITED_FLEXION));
    limb.write(SWIVEL_REACH, Float4{0, 0, 3, 0});
    CHECK(limb.solve().flags == (SWIVEL_REACHED | SWIVEL_STRETCHED));
    FreeLimb straight({{0, 0, 10}, {0, -1, 0}, 1, 1}, SWIVEL_WITH_FLEXION_LIMIT);  // at rest, which allows that
    CHECK(straight.solve().flags == SWIVEL_CLAMPED_FAR);
    FreeLimb nothing({{0, 0, 10}, {0, -1, 0}, 0, 0}, SWIVEL_WITH_REACH);
    nothing.write(SWIVEL_REACH, Float4{0, 0, 100, 0});
    CHECK(nothing.solve().flags == SWIVEL_CLAMPED_FAR);
    CHECK(nothing.solve().stretch == 1);
}
