// SPDX-License-Identifier: MIT
//
// The promise: allowed arcs are where joint limits and regions leave room, and the solver's choice is in one of them. A
// limb in the mirror takes the mirrored swivel, also where no swivel is allowed and two violate limits as little.
// Straight arms are in their region or infeasible. The bounds of what floats hold are as documented. The judges work in
// angles and half-spaces (limited_arms.h). test_limits.cpp has the choice itself.
#include <algorithm>
#include <cmath>

#include <rapidcheck/catch.h>
#include <catch2/catch.hpp>

#include "tests/limited_arms.h"

using namespace swivel;
using namespace swivel::test;

TEST_CASE("allowed arcs are where there is room, and the solver's choice is in one")
{
    Random random{8};
    int some = 0, none = 0;
    for (int crowd_count = 0; crowd_count < 200; ++crowd_count) {
        const LimitedArms arms(random, 5, crowd_count % 3 == 0);
        Crowd crowd = arms.crowd();
        crowd.solve();
        for (std::uint32_t n = 0; n < arms.arms.size(); ++n) {
            const std::vector<swivel_arc> arcs = crowd.allowed_arcs(0, n);
            const LimbPose pose = pose_of(crowd, n);
            const SwivelCircle circle(arms.arms[n], pose);
            if (circle.away < 0.05) continue;  // nearly straight: its swivel is hardly known
            const auto is_inside = [&](double angle, double wider) {
                return std::ranges::any_of(arcs, [&](const swivel_arc& arc) {
                    const double from = std::atan2(arc.from[1], arc.from[0]), end = std::atan2(arc.to[1], arc.to[0]);
                    const auto ahead = [](double a, double b) { return std::fmod(b - a + 4 * kPi, 2 * kPi); };
                    return from == end || ahead(from - wider, angle) <= ahead(from, end) + 2 * wider;
                });
            };
            (arcs.empty() ? none : some) += 1;
            CHECK(arcs.empty() == ((pose.flags & SWIVEL_INFEASIBLE) != 0));
            if (!arcs.empty()) CHECK(is_inside(swivel_of(arms.arms[n], pose), 1e-4));
            for (int k = 0; k < 500; ++k) {
                const double angle = -kPi + 2 * kPi * (k + 0.5) / 500, room = arms.room(n, circle.at(angle));
                if (std::fabs(room) > 1e-5) REQUIRE(is_inside(angle, 0) == (room > 0));
            }
        }
    }
    CHECK(some > 100);
    CHECK(none > 100);
}

namespace {

// The mirror image in the plane of e2 and e3. Turns about e2, e3 and axes that are mirrored themselves change sense.
LimitedArms mirrored(LimitedArms image)
{
    for (LimitedArm& a : image.arms) {
        for (Vector3d* v : {&a.arm.wrist, &a.arm.pole}) v->x() = -v->x();
        a.hand = Quaterniond(a.hand.w(), a.hand.x(), -a.hand.y(), -a.hand.z());
        for (Limit& limit : a.limits.each) limit.mirror();
    }
    swivel_region& region = image.region.region;
    if (image.features & SWIVEL_WITH_REGION) REQUIRE(swivel_region_mirror(&region, &region) == SWIVEL_OK);
    return image;
}
void straighten(LimitedArm& a, double share)
{
    a.arm.wrist *= share * a.arm.length() / a.arm.wrist.norm();
    a.arm = rounded(a.arm);
}
std::vector<LimbPose> solved(const LimitedArms& arms)
{
    Crowd crowd = arms.crowd();
    crowd.solve();
    std::vector<LimbPose> poses;
    for (std::uint32_t n = 0; n < arms.arms.size(); ++n) poses.push_back(pose_of(crowd, n));
    return poses;
}

}  // namespace

TEST_CASE("a limb in the mirror takes the mirrored swivel, bent or straight")
{
    // Where rooms differ by 1e-6 itself, rounding still chooses. Without the rule, 1 in 1,000 bent and 1 in 40 straight
    // limbs were apart.
    const bool is_straight = GENERATE(false, true);
    Random random{77};
    int infeasible = 0, apart = 0;
    for (int crowd_count = 0; crowd_count < 300; ++crowd_count) {
        LimitedArms arms(random, 100, crowd_count % 4 == 0);
        if (is_straight)
            for (LimitedArm& arm : arms.arms) straighten(arm, random.between(0.9999, 1.001));
        const std::vector<LimbPose> poses = solved(arms), images = solved(mirrored(arms));
        for (std::size_t n = 0; n < poses.size(); ++n) {
            CHECK(poses[n].flags == images[n].flags);
            const Quaterniond& q = images[n].shoulder;
            infeasible += (poses[n].flags & SWIVEL_INFEASIBLE) != 0;
            apart += Quaterniond(q.w(), q.x(), -q.y(), -q.z()).angularDistance(poses[n].shoulder) > 1e-3;
        }
    }
    CHECK(apart <= (is_straight ? 3 : 1));
    CHECK(infeasible > 10'000);
}

TEST_CASE("of nearly straight arms the violation is least for the elbow that floats give them")
{
    Random random{6};
    int infeasible = 0;
    for (int crowd_count = 0; crowd_count < 60; ++crowd_count) {
        LimitedArms arms(random, 10, false);
        arms.features &= ~kBoxes;
        for (LimitedArm& arm : arms.arms) straighten(arm, 1 - random.spread(1e-6, 1e-2));
        const std::vector<LimbPose> poses = solved(arms);
        for (std::uint32_t n = 0; n < poses.size(); ++n) {
            const SwivelCircle exact(arms.arms[n]), own(arms.arms[n], poses[n]);
            // Floats know the distance of a straight arm's elbow from the line to a root of their digits. The most of 3
            // million arms was 2.6e-7.
            CHECK(std::fabs(own.away - exact.away) <= 3e-7 / exact.away);
            if (!(poses[n].flags & SWIVEL_INFEASIBLE)) continue;
            ++infeasible;
            double max = -2;
            for (int step = 0; step < 1000; ++step) max = std::max(max, arms.room(n, own.at(step * kPi / 500)));
            CHECK(arms.room(n, poses[n]) >= max - 1.5e-6);  // kTie of core/choose_swivel.h, and half of it for rounding
        }
    }
    CHECK(infeasible > 100);
}

TEST_CASE("straight arms are in their region or infeasible, whatever the pole")
{
    int inside = 0, outside = 0;
    rc::prop("targets out of reach", [&](std::uint64_t seed) {
        Random random{seed};
        LimitedArms arms(random, 21, true);
        arms.features = SWIVEL_WITH_REGION | SWIVEL_WITH_HAND;
        for (LimitedArm& each : arms.arms) {
            each.arm.wrist = rounded(random.between(2, 9) * each.arm.wrist.normalized());
            if (random.below(2)) each.arm.pole = 0.5 * each.arm.wrist;  // undefined
        }
        const std::vector<LimbPose> poses = solved(arms);
        for (std::size_t n = 0; n < poses.size(); ++n) {
            const double room = room_by_half_spaces(arms.region.region, arms.arms[n].arm.wrist.normalized());
            RC_ASSERT((poses[n].flags & SWIVEL_CLAMPED_FAR) != 0);
            if (std::fabs(room) < 1e-3) continue;
            (room > 0 ? inside : outside) += 1;
            RC_ASSERT(((poses[n].flags & SWIVEL_INFEASIBLE) != 0) == (room < 0));
            RC_ASSERT(((poses[n].flags & SWIVEL_LIMITED_REGION) != 0) == (room < 0));
        }
    });
    CHECK(inside > 0);
    CHECK(outside > 0);
}

TEST_CASE("a middle angle near a right angle is held to 1e-6 of its sine, and to 0.082 degrees")
{
    // The upper arm is wished along e1: the middle angle of x, y, z is a right angle there.
    rc::prop("shoulder boxes that end within 6 degrees of it", [](std::uint64_t seed) {
        Random random{seed};
        int feasible = 0;
        for (int n = 0; n < 20; ++n) {
            const Float12 box = box_of({{0, 1, 2}, {{}, {0, kPi / 2 - random.spread(1e-4, 0.1)}, {}}});
            const double end = std::atan2(double{box[7]}, double{box[6]});  // as floats hold it
            const Vector3d upper = (Vector3d::UnitX() + 0.1 * random.direction()).normalized(),
                           off = random.across(upper);
            FreeLimb limb(rounded(Arm{upper + random.between(0.5, 1.1) * off, upper, 1, 1}), SWIVEL_WITH_SHOULDER_BOX);
            limb.write(SWIVEL_SHOULDER_BOX, box);
            const LimbPose pose = limb.solve();
            if (pose.flags & SWIVEL_INFEASIBLE) continue;
            ++feasible;
            const double sine = std::fabs((pose.shoulder * Vector3d::UnitZ()).x());
            RC_ASSERT(sine <= std::sin(end) + 1e-6);
            RC_ASSERT(std::asin(std::min(sine, 1.0)) - end <= 0.082 * kPi / 180);
        }
        RC_ASSERT(feasible > 14);
    });
}
