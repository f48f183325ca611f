// SPDX-License-Identifier: MIT
//
// The promise: groups have a region of their own, also with a step, with aims, straight arms and bad input, and with
// the same bits on every instruction set. Regions that cannot be are refused. That limbs keep their region, with all
// other limits, is in test_limits.cpp.
#include <algorithm>
#include <cstring>

#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include "tests/limited_arms.h"
#include "tests/test_crowd.h"
#include "tests/test_scopes.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr std::uint32_t kArms = 21;

bool has(const LimbPose& limb, std::uint32_t flag) { return (limb.flags & flag) != 0; }

TEST_CASE("a step, an aim and limbs alone give equal bits on every instruction set")
{
    const IsaScope scope;
    const std::vector<std::string> isas = runnable_isas();
    int jumped = 0;
    rc::prop("three frames of targets", [&](std::uint64_t seed) {
        Random random{seed};
        LimitedArms of(random, kArms, true);
        const bool aims = random.below(2) == 0;
        if (aims) of.features = SWIVEL_WITH_REGION | SWIVEL_WITH_HAND | SWIVEL_WITH_AIM | SWIVEL_WITH_SHOULDER_CONE;
        const LimitedArms other(random, kArms, true);
        const auto frames = [&](std::uint32_t count) {
            LimitedArms some = of;
            some.arms.resize(count);
            Crowd crowd = some.crowd(SWIVEL_WITH_MOST_SWIVEL);
            crowd.write_all(SWIVEL_MOST_SWIVEL, 0, turn(0.1));
            if (aims) crowd.write_all(SWIVEL_AIM, 0, aim({0, 0.3, 1}, 0.8));
            for (int frame = 0; frame < 3; ++frame) {
                for (std::uint32_t n = 0; frame > 0 && n < count; ++n) {
                    const Eigen::Vector3f between =
                        (of.arms[n].arm.wrist + 0.3 * frame * (other.arms[n].arm.wrist - of.arms[n].arm.wrist))
                            .cast<float>();
                    const std::array target{between.x(), between.y(), between.z()};
                    crowd.write(SWIVEL_TARGET, 0, std::span(&target, 1), n);
                }
                crowd.solve();
            }
            return crowd;
        };
        std::vector<std::uint32_t> words;
        for (const std::string& isa : isas) {
            RC_ASSERT(swivel_use_isa(isa.c_str()) == SWIVEL_OK);
            const Crowd crowd = frames(kArms);
            if (words.empty()) words = all_words(crowd);
            RC_ASSERT(words == all_words(crowd));
            const Crowd alone = frames(1);
            const LimbPose one = pose_of(alone), same = pose_of(crowd);
            RC_ASSERT(one.flags == same.flags);
            RC_ASSERT(one.shoulder.coeffs() == same.shoulder.coeffs());
            for (std::uint32_t n = 0; n < kArms; ++n) {
                const LimbPose limb = pose_of(crowd, n);
                jumped += has(limb, SWIVEL_JUMPED);
                if (!has(limb, SWIVEL_INFEASIBLE))
                    RC_ASSERT(room_by_half_spaces(of.region.region, limb.shoulder * Vector3d::UnitZ()) >= -1e-6);
            }
        }
    });
    CHECK(jumped > 0);
}

TEST_CASE("straight arms are in their region or infeasible, whatever the pole")
{
    int inside = 0, outside = 0;
    rc::prop("targets out of reach", [&](std::uint64_t seed) {
        Random random{seed};
        LimitedArms of(random, kArms, true);
        of.features = SWIVEL_WITH_REGION | SWIVEL_WITH_HAND;
        for (LimitedArm& arm : of.arms) {
            arm.arm.wrist = rounded(random.between(2, 9) * arm.arm.wrist.normalized());
            if (random.below(2)) arm.arm.pole = 0.5 * arm.arm.wrist;  // undefined
        }
        Crowd crowd = of.crowd();
        crowd.solve();
        for (std::uint32_t n = 0; n < kArms; ++n) {
            const LimbPose limb = pose_of(crowd, n);
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

TEST_CASE("a limb with bad input is at rest, and its neighbour has the bits it has without it")
{
    const OneArm one;
    const std::array<float, 3> good{0, 0, 1}, bad{kNan, 0, 1};
    Crowd crowd = one.crowd(good);
    const std::vector<std::uint32_t> before = all_words(crowd);
    crowd.write(SWIVEL_TARGET, 0, std::span(&bad, 1), 1);
    crowd.solve();
    CHECK(flags_of(crowd, 0, 1) == SWIVEL_BAD_INPUT);
    std::array<float, 4> at_rest{};
    crowd.read(SWIVEL_SHOULDER, 0, std::span(&at_rest, 1), 1);
    CHECK(at_rest == std::array<float, 4>{0, 0, 0, 1});
    crowd.write(SWIVEL_TARGET, 0, std::span(&good, 1), 1);
    crowd.solve();
    CHECK(all_words(crowd) == before);
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
    CHECK(flags_of(kept, 0, 0) == (SWIVEL_REACHED | SWIVEL_LIMITED_REGION));
    says(kept, "Where the elbow was wished it breaks region: the nearest place that keeps all limits is ");
    // Along +z it is 60 degrees off, of which the cone has 28.65.
    const Crowd none = one.crowd({0, 0, 1});
    CHECK(flags_of(none, 0, 0) == (SWIVEL_REACHED | SWIVEL_LIMITED_REGION | SWIVEL_INFEASIBLE));
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
