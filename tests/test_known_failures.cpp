// SPDX-License-Identifier: MIT
//
// The promise: poses on which the IKAN library (Tolani, Goswami, Badler 2000) is known to fail are poses like any
// other.
#include <catch2/catch.hpp>

#include "tests/formula_limb.h"
#include "tests/limit_oracle.h"

namespace {

using namespace swivel;
using namespace swivel::test;

bool is_sound(const Solved<float>& got)
{
    return std::fabs(eigen(got.pose.arm.shoulder).norm() - 1) <= 1e-6 &&
           std::fabs(elbow_rotation(got.pose.arm).norm() - 1) <= 1e-6;
}

}  // namespace

TEST_CASE("wrist on the shoulder, bones of equal length")
{
    const Arm arm = rounded(Arm{{0, 0, 0}, {0, 1, 0.2}, 0.3, 0.3});
    const Solved<float> got = solve(LimbUse{}, limb_goal<float>(arm));
    CHECK(is_sound(got));
    CHECK(got.wrist.norm() <= 1e-6 * arm.length());
    CHECK(got.pose.arm.flags == (SWIVEL_REACHED | SWIVEL_SWIVEL_UNDEFINED));
}

TEST_CASE("exactly full reach, in many directions")
{
    Random random{1};
    for (int n = 0; n < 1000; ++n) {
        const Vector3d axis = Vector3d::Unit(n % 3) * (n % 2 ? 1 : -1);
        const Arm arm = rounded(Arm{0.75 * axis, random.across(axis), 0.5, 0.25});
        const Solved<float> got = solve(LimbUse{}, limb_goal<float>(arm));
        CHECK(is_sound(got));
        CHECK((got.wrist - arm.wrist).norm() <= 1e-6 * arm.length());
        CHECK(got.pose.arm.flags == SWIVEL_REACHED);
        CHECK(got.pose.arm.sin_half <= 1e-3f);
    }
}

TEST_CASE("target on the reference axis from which a swivel angle is measured")
{
    LimbUse use;
    use.angle = use.incoming = true;
    for (const double side : {1.0, -1.0}) {
        Arm arm =
            rounded(Arm{side * Vector3d(0, 0, 0.4), side * Vector3d(0, 0, 1), 0.3, 0.25});  // the pole is the axis
        LimbGoal<float> goal = limb_goal<float>(arm);
        goal.angle = turned<float>(1);
        const Solved<float> got = solve(use, goal);
        CHECK(is_sound(got));
        CHECK((got.wrist - arm.wrist).norm() <= 1e-6 * arm.length());
        // The elbow stays as in the incoming pose, whose hinge is e1.
        CHECK((got.hinge - Vector3d::UnitX()).norm() <= 1e-6);
        CHECK(got.pose.arm.flags == (SWIVEL_REACHED | SWIVEL_SWIVEL_UNDEFINED));
    }
}

TEST_CASE("crossing the plane where its swivel angle flips sense")
{
    // A target on its way through the plane of the reference direction and the vertical: the elbow follows smoothly.
    LimbUse use;
    use.angle = true;
    Vector3d before = Vector3d::Zero();
    for (int n = -500; n <= 500; ++n) {
        const double t = n * 1e-3;
        const Arm arm = rounded(Arm{0.4 * Vector3d(t, 0.3, 1).normalized(), {0, 1, 0}, 0.3, 0.3});
        LimbGoal<float> goal = limb_goal<float>(arm);
        goal.angle = turned<float>(0.7);
        const Solved<float> got = solve(use, goal);
        CHECK((got.wrist - arm.wrist).norm() <= 1e-6 * arm.length());
        if (n > -500) CHECK((got.elbow - before).norm() <= 2e-3);
        before = got.elbow;
    }
}

TEST_CASE("goals that are not numbers")
{
    const Arm arm = rounded(Arm{{0.1, 0.2, 0.3}, {0, 1, 0}, 0.3, 0.3});
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    LimbUse use;
    use.limits.shoulder_cone = use.limits.shoulder_box = use.incoming = use.hand = use.reach = use.continuity = true;
    for (const float bad : {nan, inf, -inf})
        for (int place = 0; place < 8; ++place) {
            LimbGoal<float> goal = limb_goal<float>(arm);
            float* const places[] = {&goal.arm.wrist.c[place % 3],
                                     &goal.arm.pole.c[1],
                                     &goal.arm.upper,
                                     &goal.hand.c[2],
                                     &goal.limits.shoulder_cone.cos_opening,
                                     &goal.limits.shoulder_box[1].middle.sin,
                                     &goal.incoming.shoulder.c[0],
                                     &goal.reach.soft_far};
            *places[place] = bad;
            const Solved<float> got = solve(use, goal);
            INFO("place " << place << ", " << bad);
            CHECK(got.pose.arm.flags == SWIVEL_BAD_INPUT);
            CHECK(distance(eigen(got.pose.arm.shoulder), Quaterniond::Identity()) == 0);
            CHECK(got.pose.arm.cos_half == 1);
            CHECK(got.pose.arm.sin_half == 0);
        }
}

TEST_CASE("bones of length 0 and 3e-12")
{
    Random random{2};
    for (const double tiny : {0.0, 3e-12})
        for (const bool upper : {true, false})
            for (int n = 0; n < 100; ++n) {
                const Vector3d line = random.direction();
                const Arm arm = rounded(
                    Arm{random.between(0.1, 0.6) * line, random.across(line), upper ? tiny : 0.3, upper ? 0.3 : tiny});
                const Solved<float> got = solve(LimbUse{}, limb_goal<float>(arm));
                CHECK(is_sound(got));
                CHECK(got.pose.arm.sin_half == 0);  // one bone, along the line
                CHECK((got.wrist - 0.3 * arm.wrist.normalized()).norm() <= 1e-6);
                CHECK((got.pose.arm.flags & (SWIVEL_CLAMPED_FAR | SWIVEL_CLAMPED_NEAR)) != 0);
            }
}

TEST_CASE("a limit box of +-0.004 rad: arcs far under 0.57 degrees are found")
{
    // The box is centred on where the arm is at some swivel: there is a swivel that it allows, and it is found.
    Random random{3};
    LimbUse use;
    use.limits.shoulder_box = true;
    for (int n = 0; n < 1000; ++n) {
        const Arm arm = random_reachable(random);
        const double there = random.between(-3, 3);
        LimbGoal<float> goal = limb_goal<float>(arm);
        const Quaterniond wish = eigen(solve(LimbUse{}, goal).pose.arm.shoulder).normalized();
        const Quaterniond inside = Quaterniond(Eigen::AngleAxisd(there, arm.wrist.normalized())) * wish;
        const Eigen::Matrix3d r = inside.toRotationMatrix();
        const double angles[] = {std::atan2(-r(1, 2), r(2, 2)), std::asin(std::clamp(r(0, 2), -1.0, 1.0)),
                                 std::atan2(-r(0, 1), r(0, 0))};
        AngleBox box;
        for (int k = 0; k < 3; ++k) {
            const double middle = angles[k] + random.between(-0.002, 0.002);
            goal.limits.shoulder_box[k] = {turned<float>(middle), turned<float>(0.004)};
            box.range[k] = {middle, 0.004};
        }
        const Solved<float> got = solve(use, goal);
        INFO("arm " << n << ", allowed at " << there);
        CHECK((got.pose.arm.flags & SWIVEL_INFEASIBLE) == 0);
        CHECK(box_violation(box, eigen(got.pose.arm.shoulder).normalized().toRotationMatrix()) <= 1e-6);
        CHECK((got.wrist - arm.wrist).norm() <= 1e-6 * arm.length());
    }
}
