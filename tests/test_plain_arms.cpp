// SPDX-License-Identifier: MIT
//
// The promise: arms of every valid size, ratio and place are solved to 1e-6 of the arm. The plain formula solves those
// for which it says that it holds. The others are solved as whole limbs. Both ways give the same flags. Forward
// kinematics is Eigen's.
#include <catch2/catch.hpp>
#include <utility>

#include <rapidcheck/catch.h>

#include "tests/formula_arm.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr double kLeast = 2e-15;  // shorter bones are bad input, nearer wrists on the shoulder

// Sizes from corner to corner of what floats hold, most arms where products of them come near the limits.
Arm sized_arm(Random& random)
{
    const double corners[] = {1e-10, 1e-9, 1e-5, 1, 1e4, 1e7, 1e10};
    const auto size = [&] { return corners[random.below(7)] * random.spread(0.1, 10); };
    Arm arm;
    arm.upper = size();
    arm.fore = random.below(2) ? arm.upper * random.spread(1e-8, 1) : arm.upper * random.spread(0.5, 1);
    arm.fore = std::max(arm.fore, kLeast);
    if (random.below(2)) std::swap(arm.upper, arm.fore);
    arm = rounded({Vector3d::UnitX(), Vector3d::UnitY(), arm.upper, arm.fore});
    const double near = std::fabs(arm.upper - arm.fore), far = arm.length();
    const double wrists[] = {near + (far - near) * random.unit(), near + (far - near) * 1e-6 * random.unit(),
                             far * (1 - 1e-6 * random.unit()), far * random.spread(1e-6, 10), size()};
    const Vector3d line = random.direction();
    const double sine = random.spread(1.1e-3, 1), side = random.below(2) ? 1 : -1;
    arm.wrist = std::max(wrists[random.below(5)], kLeast) * line;
    arm.pole = size() * (side * std::sqrt(1 - sine * sine) * line + sine * random.across(line));
    return rounded(arm);
}

ArmGoal<float> goal_of(const Arm& arm)
{
    return {mv<float>(arm.wrist), mv<float>(arm.pole), static_cast<float>(arm.upper), static_cast<float>(arm.fore)};
}

ArmPose<float> solve_as_limb(const ArmGoal<float>& arm)
{
    LimbGoal<float> goal{};
    goal.arm = arm;
    return solve_limb<false>(LimbUse{}, goal, true).arm;
}

bool is_right(const Arm& arm, const ArmPose<float>& pose)
{
    const double d = arm.wrist.norm(), reach = std::clamp(d, std::fabs(arm.upper - arm.fore), arm.length());
    const bool near_enough = (wrist_place(pose, arm) - reach / d * arm.wrist).norm() <= 1e-6 * arm.length();
    const double sine = arm.wrist.normalized().cross(arm.pole.normalized()).norm();
    const Vector3d hinge = eigen(pose.shoulder).normalized() * Vector3d::UnitX();
    const bool in_plane = sine * (hinge - arm.normal()).norm() <= 1e-6;
    return near_enough && in_plane && std::fabs(eigen(pose.shoulder).norm() - 1) <= 1e-6 &&
           std::fabs(elbow_rotation(pose).norm() - 1) <= 1e-6;
}

template <class Check>
void for_sized_arms(std::uint64_t seed, Check check)
{
    Random random{seed};
    for (int n = 0; n < 1000; ++n) check(sized_arm(random));
}

}  // namespace

TEST_CASE("arms of every size are solved, plain or not")
{
    rc::prop("where the formula says that it holds, it does", [](std::uint64_t seed) {
        for_sized_arms(seed, [](const Arm& arm) {
            const PlainArm<float> plain = solve_plain(goal_of(arm));
            RC_ASSERT(!plain.holds || is_right(arm, plain.pose));
        });
    });
    rc::prop("as whole limbs, whether it holds or not", [](std::uint64_t seed) {
        for_sized_arms(seed, [](const Arm& arm) { RC_ASSERT(is_right(arm, solve_as_limb(goal_of(arm)))); });
    });
    rc::prop("both with the same flags", [](std::uint64_t seed) {
        for_sized_arms(seed, [](const Arm& arm) {
            const ArmGoal<float> goal = goal_of(arm);
            const PlainArm<float> plain = solve_plain(goal);
            RC_ASSERT(!plain.holds || plain.pose.flags == solve_as_limb(goal).flags);
        });
    });
}

TEST_CASE("everyday arms are plain, so they cost what the benchmarks say")
{
    rc::prop("in metres, centimetres and millimetres", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < 1000; ++n) {
            const double unit = n % 3 == 0 ? 1 : n % 3 == 1 ? 100 : 1000;
            Arm arm;
            arm.upper = unit * random.between(0.2, 0.4);
            arm.fore = arm.upper * random.between(0.7, 1.4);
            const Vector3d line = random.direction();
            arm.wrist = unit * random.between(0.05, 1) * line;
            arm.pole = unit * random.between(0.1, 2) * (0.9 * line + 0.43 * random.across(line));
            RC_ASSERT(solve_plain(goal_of(arm)).holds);
        }
    });
}

// The forearm is much shorter than the upper arm, and the pole is far away. So the product of all lengths left the
// range of floats, which once gave a rotor of zeros.
TEST_CASE("the product of all lengths may not overflow unseen")
{
    const Arm arm = rounded({{0x1.7982e6p+14, 0x1.fafb84p+10, -0x1.de74f4p-8},
                             {-0x1.3c4d98p+27, 0x1.372494p+27, 0x1.81a0b2p+5},
                             0x1.7ad6b8p+14,
                             0x1.9b4fc6p-8});
    CHECK(is_right(arm, solve<float>(arm)));
}

TEST_CASE("a folded arm with a pole far away is as exact as one with a pole nearby")
{
    Random random{5};
    for (int n = 0; n < 2000; ++n) {
        const double upper = random.between(0.5, 1.5), fore = upper * (1 + 1e-7 * random.between(-9, 9));
        const Vector3d line = random.direction();
        const Arm arm = rounded({random.spread(1e-6, 1e-3) * line, 1e12 * random.across(line), upper, fore});
        CHECK_FALSE(solve_plain(goal_of(arm)).holds);
        CHECK(is_right(arm, solve<float>(arm)));
    }
}
