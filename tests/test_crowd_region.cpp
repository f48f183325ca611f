// SPDX-License-Identifier: MIT
//
// The promise: limbs keep the region of their group with all of its other limits. The elbow is the nearest allowed one,
// or the one that violates the limits least. Bits are those of the formula. Regions that cannot be are refused.
#include <algorithm>
#include <cstring>

#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include "tests/region_arms.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr double kClear = 5e-6;  // more room than rounding takes
constexpr std::uint32_t kArms = 21;
constexpr int kSteps = 10'000;  // of a scan

bool has(const SolvedLimb<float>& limb, std::uint32_t flag) { return (limb.arm.flags & flag) != 0; }

// The least turn from the wish at which there is room to spare; more than pi: none. `most` is the most room there is.
struct Scan {
    double nearest = 10, most = -4;

    Scan(const RegionArms& of, std::uint32_t n, const SwivelCircle& circle)
    {
        const auto room_at = [&](double turn) { return of.room(n, circle.at(turn)); };
        for (int k = 0; k <= kSteps / 2; ++k)
            for (const double sign : {1.0, -1.0}) {
                const double turn = 2 * kPi * k / kSteps, here = room_at(sign * turn);
                most = std::max(most, here);
                if (here < kClear || nearest < 10) continue;
                double in = turn, out = std::max(0.0, turn - 2 * kPi / kSteps);
                while (in - out > 1e-6) {
                    const double middle = 0.5 * (in + out);
                    (room_at(sign * middle) >= kClear ? in : out) = middle;
                }
                nearest = in;
            }
    }
};

// Whether it has the bits of the whole formula.
bool is_of_formula(const RegionArms& of, std::uint32_t n, const SolvedLimb<float>& limb)
{
    LimitedArm arm = of.arms[n];
    arm.use.region = &of.region.region;
    const SolvedLimb<float> wanted = solve<float>(arm);
    const auto got = eigen(limb.arm.shoulder).coeffs(), q = eigen(wanted.arm.shoulder).coeffs();
    return limb.arm.flags == wanted.arm.flags && (got == q || got == -q);
}

TEST_CASE("limbs with a region keep all limits, and their elbows are the nearest allowed ones")
{
    int granted = 0, moved = 0, infeasible = 0;
    double worst = 0;
    rc::prop("against a scan of the circle by other definitions", [&](std::uint64_t seed) {
        Random random{seed};
        const RegionArms of(random, kArms);
        RC_ASSERT(of.region.good);
        Crowd crowd = of.crowd();
        crowd.solve();
        for (std::uint32_t n = 0; n < kArms; ++n) {
            const SolvedLimb<float> limb = solved_limb(crowd, n);
            const ArmAt pose = pose_of(limb);
            RC_ASSERT(is_of_formula(of, n, limb));
            RC_ASSERT(has(limb, SWIVEL_REACHED));
            if (!has(limb, SWIVEL_INFEASIBLE)) {
                worst = std::min(worst, of.region_room(pose));
                RC_ASSERT(of.region_room(pose) >= -1e-6);
                RC_ASSERT(of.region.oracle.room(pose.shoulder * Vector3d::UnitZ()) >= -2e-6);
                RC_ASSERT(violation(of.arms[n], pose) <= 5e-6);
            }
        }
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t n = random.below(kArms);
            const SolvedLimb<float> limb = solved_limb(crowd, n);
            const SwivelCircle circle(of.arms[n], limb);
            if (circle.away < 0.05) continue;  // nearly straight: its swivel is hardly known
            const ArmAt wish = circle.at(0);
            if (std::fabs(of.region_room(wish)) > kClear)
                RC_ASSERT(has(limb, SWIVEL_LIMITED_REGION) == (of.region_room(wish) < 0));
            const Scan scan(of, n, circle);
            const bool is_clear = scan.nearest <= kPi;
            if (is_clear) {
                RC_ASSERT(!has(limb, SWIVEL_INFEASIBLE));
                RC_ASSERT(std::fabs(swivel_of(of.arms[n], limb)) <= scan.nearest + 1e-4);
            }
            const bool has_box = (of.features & (SWIVEL_WITH_SHOULDER_BOX | SWIVEL_WITH_WRIST_BOX)) != 0;
            if (has(limb, SWIVEL_INFEASIBLE) && !has_box)  // outside of a box there is no one way to measure how far
                RC_ASSERT(of.room(n, pose_of(limb)) >= scan.most - 3e-6);
            granted += of.room(n, wish) > kClear;
            moved += is_clear && of.room(n, wish) < 0;
            infeasible += has(limb, SWIVEL_INFEASIBLE);
        }
    });
    CAPTURE(granted, moved, infeasible, worst);
    CHECK(granted > 0);
    CHECK(moved > 0);
    CHECK(infeasible > 0);
}

TEST_CASE("limbs that step or aim keep their region, over three frames")
{
    int jumped = 0;
    rc::prop("of targets", [&](std::uint64_t seed) {
        Random random{seed};
        RegionArms of(random, kArms);
        const bool aims = random.below(2) == 0;
        if (aims) of.features = SWIVEL_WITH_REGION | SWIVEL_WITH_HAND | SWIVEL_WITH_AIM | SWIVEL_WITH_SHOULDER_CONE;
        const RegionArms other(random, kArms), start = of;
        Crowd crowd = of.crowd(SWIVEL_WITH_MOST_SWIVEL);
        crowd.write_all(SWIVEL_MOST_SWIVEL, 0, turn(0.1));
        if (aims) crowd.write_all(SWIVEL_AIM, 0, aim({0, 0.3, 1}, 0.8));
        for (int frame = 0; frame < 3; ++frame) {
            for (std::uint32_t n = 0; frame > 0 && n < kArms; ++n) {
                const Vector3d from = start.arms[n].arm.wrist, way = other.arms[n].arm.wrist - from;
                of.arms[n].arm.wrist = rounded(from + 0.3 * frame * way);
                of.write(crowd, n);
            }
            crowd.solve();
            for (std::uint32_t n = 0; n < kArms; ++n) {
                const SolvedLimb<float> limb = solved_limb(crowd, n);
                jumped += has(limb, SWIVEL_JUMPED);
                if (!has(limb, SWIVEL_INFEASIBLE)) RC_ASSERT(of.region_room(pose_of(limb)) >= -1e-6);
            }
        }
    });
    CHECK(jumped > 0);
}

TEST_CASE("the mirrored region keeps mirrored arms in mirrored poses")
{
    int limited = 0, same = 0, all = 0;
    rc::prop("in the plane x = 0", [&](std::uint64_t seed) {
        Random random{seed};
        RegionArms of(random, kArms);
        of.features = SWIVEL_WITH_REGION | SWIVEL_WITH_HAND;
        RegionArms image = of;
        RC_ASSERT(swivel_region_mirror(&of.region.region, &image.region.region) == SWIVEL_OK);
        for (LimitedArm& arm : image.arms) arm.arm.wrist.x() *= -1, arm.arm.pole.x() *= -1;
        Crowd crowd = of.crowd(), other = image.crowd();
        crowd.solve(), other.solve();
        for (std::uint32_t n = 0; n < kArms; ++n) {
            const SolvedLimb<float> one = solved_limb(crowd, n), two = solved_limb(other, n);
            RC_ASSERT(one.arm.flags == two.arm.flags);
            const Quaterniond q = eigen(one.arm.shoulder);
            same += distance(Quaterniond(q.w(), q.x(), -q.y(), -q.z()), eigen(two.arm.shoulder)) < 1e-4;
            limited += has(one, SWIVEL_LIMITED_REGION);
            ++all;
        }
    });
    CHECK(limited > 0);
    CHECK(same == all);
}

TEST_CASE("straight arms are in their region or infeasible, whatever the pole")
{
    int inside = 0, outside = 0;
    rc::prop("targets out of reach", [&](std::uint64_t seed) {
        Random random{seed};
        RegionArms of(random, kArms);
        of.features = SWIVEL_WITH_REGION | SWIVEL_WITH_HAND;
        for (LimitedArm& arm : of.arms) {
            arm.arm.wrist = rounded(random.between(2, 9) * arm.arm.wrist.normalized());
            if (random.below(2)) arm.arm.pole = 0.5 * arm.arm.wrist;  // undefined
        }
        Crowd crowd = of.crowd();
        crowd.solve();
        for (std::uint32_t n = 0; n < kArms; ++n) {
            const SolvedLimb<float> limb = solved_limb(crowd, n);
            const double room = room_by_half_spaces(of.region.region, of.arms[n].arm.wrist.normalized());
            RC_ASSERT(has(limb, SWIVEL_CLAMPED_FAR));
            if (std::fabs(room) < 1e-3) continue;
            (room > 0 ? inside : outside) += 1;
            RC_ASSERT(has(limb, SWIVEL_INFEASIBLE) == (room < 0));
            RC_ASSERT(has(limb, SWIVEL_LIMITED_REGION) == (room < 0));
        }
    });
    CHECK(inside > 0);
    CHECK(outside > 0);
}

TEST_CASE("allowed arcs are where there is room")
{
    int some = 0, none = 0;
    rc::prop("wishes all around the circle", [&](std::uint64_t seed) {
        Random random{seed};
        const RegionArms of(random, 3);
        Crowd crowd = of.crowd();
        crowd.solve();
        for (std::uint32_t n = 0; n < 3; ++n) {
            const std::vector<swivel_arc> arcs = crowd.allowed_arcs(0, n);
            const SwivelCircle circle(of.arms[n], solved_limb(crowd, n));
            if (circle.away < 0.05) continue;
            (arcs.empty() ? none : some) += 1;
            for (int k = 0; k < 500; ++k) {
                const double angle = -kPi + 2 * kPi * (k + 0.5) / 500, room = of.room(n, circle.at(angle));
                const bool inside = std::ranges::any_of(arcs, [&](const swivel_arc& arc) {
                    const double from = std::atan2(arc.from[1], arc.from[0]), to = std::atan2(arc.to[1], arc.to[0]);
                    const auto ahead = [](double a, double b) { return std::fmod(b - a + 4 * kPi, 2 * kPi); };
                    return from == to || ahead(from, angle) <= ahead(from, to);
                });
                if (std::fabs(room) > 1e-5) RC_ASSERT(inside == (room > 0));
            }
        }
    });
    CHECK(some > 0);
    CHECK(none > 0);
}

// A cone about +z, and an arm whose wish is far from it.
struct OneArm {
    swivel_region region = swivel_default_region();
    swivel_group_def def = group(2, SWIVEL_WITH_REGION);

    explicit OneArm(double angle = 0.5)
    {
        const swivel_region_cone cone{{0, 0, 1}, float(angle)};
        REQUIRE(swivel_region_add_cones(&region, &cone, 1, 0) == SWIVEL_OK);
        def.region = &region;
    }
    Crowd crowd(const std::array<float, 3>& target) const
    {
        Crowd made(def);
        made.write_all(SWIVEL_LENGTHS, 0, std::array{1.0f, 1.0f});
        made.write_all(SWIVEL_TARGET, 0, target);
        made.write_all(SWIVEL_POLE, 0, std::array{0.0f, 5.0f, 0.0f});
        made.solve();
        return made;
    }
};
std::uint32_t flags_of(const Crowd& crowd, std::uint32_t n)
{
    std::uint32_t flags = 0;
    crowd.read(SWIVEL_FLAGS, 0, std::span(&flags, 1), n);
    return flags;
}

TEST_CASE("explain names the region, and says how far off the elbow is")
{
    const OneArm one;
    const auto says = [](const Crowd& crowd, const char* words) {
        std::string text(500, ' ');
        check(swivel_explain(crowd.get(), 0, 0, text.data(), text.size()));
        INFO(text.c_str());
        CHECK(text.find(words) != std::string::npos);
    };
    // The upper arm is 60 degrees from the line to the target, which is 0.7 radians from +z. So the cone is out of
    // reach by 60 - 40.1 - 28.6 degrees and less, and some swivel keeps it.
    const Crowd kept = one.crowd({0, 0.644f, 0.765f});
    CHECK(flags_of(kept, 0) == (SWIVEL_REACHED | SWIVEL_LIMITED_REGION));
    says(kept, "Where the elbow was wished it breaks region: the nearest place that keeps all limits is ");
    // Along +z it is 60 degrees off, of which the cone has 28.65.
    const Crowd none = one.crowd({0, 0, 1});
    CHECK(flags_of(none, 0) == (SWIVEL_REACHED | SWIVEL_LIMITED_REGION | SWIVEL_INFEASIBLE));
    says(none, "No place of the elbow keeps region: ");
    says(none, "Its pose violates region by 31.35 degrees.");
}

TEST_CASE("a crowd has its own copy of a region")
{
    OneArm one;
    Crowd crowd = one.crowd({0, 0, 1});
    const std::vector<std::uint32_t> before = all_words(crowd);
    std::memset(&one.region, 0xff, sizeof one.region);
    crowd.solve();
    CHECK(all_words(crowd) == before);
}

TEST_CASE("groups with a region that cannot be are refused, with a line")
{
    const auto refused = [](const swivel_group_def& def, const char* words) {
        const swivel_crowd_def crowd_def = def_of(def);
        swivel_crowd* crowd = nullptr;
        CHECK_REFUSED(swivel_crowd_create(&crowd_def, &crowd), SWIVEL_INVALID_ARGUMENT);
        INFO(swivel_last_error());
        CHECK(std::string(swivel_last_error()).find(words) != std::string::npos);
        CHECK(swivel_crowd_bytes(&crowd_def) == 0);
    };
    OneArm none;
    none.def.region = nullptr;
    refused(none.def, "group 0: SWIVEL_WITH_REGION needs a region; give it");
    OneArm without;
    without.def.features = 0;
    refused(without.def, "group 0 has a region, but not SWIVEL_WITH_REGION; add it");
    OneArm empty;
    empty.region = swivel_default_region();
    refused(empty.def, "group 0: the region allows nothing");
    OneArm broken;
    broken.region.half_space[0].axis[2] = 1.1f;
    refused(broken.def, "group 0: half-space 0 of the region needs a unit axis");
    OneArm short_one;
    short_one.region.size = 8;
    refused(short_one.def, "group 0: the region's size is 8");
    OneArm no_limb;
    no_limb.def.features = SWIVEL_WITH_REGION | SWIVEL_LOOK;
    refused(no_limb.def, "");
}

}  // namespace
