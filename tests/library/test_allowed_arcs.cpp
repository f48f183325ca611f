// SPDX-License-Identifier: MIT
//
// The promise: allowed arcs are where joint limits and regions leave room, and the solver's choice is in one of them.
// Where no swivel is allowed, rounding does not choose. Among least violations within 1e-6 the one nearest to the wish
// is taken, then that of the lower line. So a limb in the mirror takes the mirrored swivel. The bounds of what floats
// hold are as documented. The judges work in angles and half-spaces (limited_arms.h).
#include "core/choose_swivel.h"

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
        const LimitedArms of(random, 5, crowd_count % 3 == 0);
        Crowd crowd = of.crowd();
        crowd.solve();
        for (std::uint32_t n = 0; n < of.arms.size(); ++n) {
            const std::vector<swivel_arc> arcs = crowd.allowed_arcs(0, n);
            const LimbPose pose = pose_of(crowd, n);
            const SwivelCircle circle(of.arms[n], pose);
            if (circle.away < 0.05) continue;  // nearly straight: its swivel is hardly known
            const auto is_inside = [&](double angle, double wider) {
                return std::ranges::any_of(arcs, [&](const swivel_arc& arc) {
                    const double from = std::atan2(arc.from[1], arc.from[0]), to = std::atan2(arc.to[1], arc.to[0]);
                    const auto ahead = [](double a, double b) { return std::fmod(b - a + 4 * kPi, 2 * kPi); };
                    return from == to || ahead(from - wider, angle) <= ahead(from, to) + 2 * wider;
                });
            };
            (arcs.empty() ? none : some) += 1;
            CHECK(arcs.empty() == ((pose.flags & SWIVEL_INFEASIBLE) != 0));
            if (!arcs.empty()) CHECK(is_inside(swivel_of(of.arms[n], pose), 1e-4));
            for (int k = 0; k < 500; ++k) {
                const double angle = -kPi + 2 * kPi * (k + 0.5) / 500, room = of.room(n, circle.at(angle));
                if (std::fabs(room) > 1e-5) REQUIRE(is_inside(angle, 0) == (room > 0));
            }
        }
    }
    CHECK(some > 100);
    CHECK(none > 100);
}

namespace {

OnCircle<float> line(double a, double b, double c)
{
    return {static_cast<float>(a), static_cast<float>(b), static_cast<float>(c)};
}
Limits<float> both(const OnCircle<float>& one, const OnCircle<float>& other)
{
    Limits<float> limits;
    limits.line[0] = one, limits.line[1] = other, limits.line_count = 2;
    return limits;
}
// Two lines whose room is least - |sin(phi - peak)| + tilt cos(phi - peak). It peaks at `peak`, and opposite of it.
Limits<float> two_peaks(double peak, double least, double tilt)
{
    const double s = std::sin(peak), c = std::cos(peak);
    return both(line(tilt * c - s, tilt * s + c, least), line(tilt * c + s, tilt * s - c, least));
}
double angle(const Turned<float>& turn) { return std::atan2(double{turn.sin}, double{turn.cos}); }
bool is_at(const FoundSwivel<float>& chosen, double phi)
{
    return std::fabs(std::remainder(angle(chosen.swivel) - phi, 2 * kPi)) < 1e-5;
}

// The mirror image in the plane of e2 and e3. Turns about e2, e3 and axes that are mirrored themselves change sense.
LimitedArms mirrored(LimitedArms of)
{
    for (LimitedArm& a : of.arms) {
        for (Vector3d* v : {&a.arm.wrist, &a.arm.pole, &a.shoulder_axis, &a.hand_axis, &a.twist_axis}) v->x() = -v->x();
        a.hand = Quaterniond(a.hand.w(), a.hand.x(), -a.hand.y(), -a.hand.z());
        for (AngleRange* range : {&a.humeral, &a.forearm, &a.hand_twist}) range->middle = -range->middle;
        for (AngleBox* box : {&a.shoulder_box, &a.wrist_box})
            for (int n = 0; n < 3; ++n)
                if (box->axes[n] != 0) box->range[n].middle = -box->range[n].middle;
    }
    if (of.features & SWIVEL_WITH_REGION) {
        const swivel_region region = of.region.region;
        REQUIRE(swivel_region_mirror(&region, &of.region.region) == SWIVEL_OK);
    }
    return of;
}
void straighten(LimitedArm& a, double share)
{
    a.arm.wrist *= share * a.arm.length() / a.arm.wrist.norm();
    a.arm = rounded(a.arm);
}
std::vector<LimbPose> solved(const LimitedArms& of)
{
    Crowd crowd = of.crowd();
    crowd.solve();
    std::vector<LimbPose> poses;
    for (std::uint32_t n = 0; n < of.arms.size(); ++n) poses.push_back(pose_of(crowd, n));
    return poses;
}

}  // namespace

TEST_CASE("of two least violations within 1e-6, the one nearer to the wish is taken")
{
    rc::prop("whichever rounding prefers", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < 100; ++n) {
            const double far = random.between(1.7, 4.5), near = far + kPi;  // by their distance from 0
            const double room = random.between(-0.9, -0.01);
            RC_ASSERT(is_at(choose_swivel(two_peaks(far, room, random.between(-3e-7, 3e-7)), true), near));
            RC_ASSERT(is_at(choose_swivel(two_peaks(far, room, 3e-6), true), far));  // 6e-6 more room
        }
    });
}

TEST_CASE("of two as near, the lower line's is taken")
{
    // The first line falls towards the wish. The others fall away from it, on either side. `less`: the third line falls
    // a little sooner, so its peak is nearer by as much. With turns up
    // to 0.91, the first line can meet one of the others just where the other one peaks. So turns start at 0.95.
    rc::prop("whichever rounding prefers", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < 100; ++n) {
            const double slope = random.between(0.05, 0.2), turn = random.between(0.95, 1.2);
            const double less = random.between(-2e-7, 2e-7), c = 0.5 * std::cos(turn), s = 0.5 * std::sin(turn);
            Limits<float> limits = both(line(-slope, 0, -0.5), line(c, -s, -0.5));
            limits.line[2] = line(c, s, -0.5 - less), limits.line_count = 3;
            RC_ASSERT(choose_swivel(limits, true).swivel.sin > 0.1f);
            std::swap(limits.line[1], limits.line[2]);
            RC_ASSERT(choose_swivel(limits, true).swivel.sin < -0.1f);
        }
    });
}

TEST_CASE("an allowed swivel ties with no other")
{
    // The arc at the farther peak is too short for its ends to be found. The nearer one violates the limits by 1.15e-6.
    for (const double far : {2.0, 2.5, 3.0, 4.0}) {
        const Limits<float> limits = two_peaks(far, -7.5e-7, 4e-7);
        CHECK_FALSE(nearest_end(limits).allowed);
        const FoundSwivel<float> chosen = choose_swivel(limits, true);
        CHECK(chosen.allowed);
        CHECK(is_at(chosen, far));
    }
}

TEST_CASE("a limb in the mirror takes the mirrored swivel, bent or straight")
{
    // Where rooms differ by 1e-6 itself, rounding still chooses. Without the rule, 1 in 1,000 bent and 1 in 40 straight
    // limbs were apart.
    const bool is_straight = GENERATE(false, true);
    Random random{77};
    int infeasible = 0, apart = 0;
    for (int crowd_count = 0; crowd_count < 300; ++crowd_count) {
        LimitedArms of(random, 100, crowd_count % 4 == 0);
        if (is_straight)
            for (LimitedArm& arm : of.arms) straighten(arm, random.between(0.9999, 1.001));
        const std::vector<LimbPose> poses = solved(of), images = solved(mirrored(of));
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
        LimitedArms of(random, 10, false);
        of.features &= ~kBoxes;
        for (LimitedArm& arm : of.arms) straighten(arm, 1 - random.spread(1e-6, 1e-2));
        const std::vector<LimbPose> poses = solved(of);
        for (std::uint32_t n = 0; n < poses.size(); ++n) {
            const SwivelCircle exact(of.arms[n]), own(of.arms[n], poses[n]);
            // Floats know the distance of a straight arm's elbow from the line to a root of their digits. The most of 3
            // million arms was 2.6e-7.
            CHECK(std::fabs(own.away - exact.away) <= 3e-7 / exact.away);
            if (!(poses[n].flags & SWIVEL_INFEASIBLE)) continue;
            ++infeasible;
            double most = -2;
            for (int step = 0; step < 1000; ++step) most = std::max(most, of.room(n, own.at(step * kPi / 500)));
            CHECK(of.room(n, poses[n]) >= most - 1.5e-6);  // kTie of core/choose_swivel.h, and half of it for rounding
        }
    }
    CHECK(infeasible > 100);
}

TEST_CASE("a middle angle near a right angle is held to 1e-6 of its sine, and to 0.082 degrees")
{
    // The upper arm is wished along e1: the middle angle of x, y, z is a right angle there.
    rc::prop("shoulder boxes that end within 6 degrees of it", [](std::uint64_t seed) {
        Random random{seed};
        int feasible = 0;
        for (int n = 0; n < 20; ++n) {
            const double end = rounded(AngleRange{0, kPi / 2 - random.spread(1e-4, 0.1)}).half;
            const Vector3d upper = (Vector3d::UnitX() + 0.1 * random.direction()).normalized(),
                           off = random.across(upper);
            FreeLimb limb(rounded(Arm{upper + random.between(0.5, 1.1) * off, upper, 1, 1}), SWIVEL_WITH_SHOULDER_BOX);
            limb.write(SWIVEL_SHOULDER_BOX, numbers(AngleBox{{0, 1, 2}, {{}, {0, end}, {}}}));
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
