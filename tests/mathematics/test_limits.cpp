// SPDX-License-Identifier: MIT
//
// The promise: joint limits and regions hold. Where a swivel is allowed, the result violates none by more than 1e-6,
// and it is as near to the wish as a scan of the whole circle finds. Where no swivel is allowed, a flag says so.
// The judges work in angles and half-spaces (limited_arms.h).
#include <catch2/catch.hpp>

#include "core/limits.h"
#include "tests/limited_arms.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr double kClear = 5e-6;  // more room than rounding takes
constexpr std::uint32_t kCrowd = 500;

// The least turn from the wish at which there is room to spare; more than pi: none. `most` is the most room there is.
struct Scan {
    static constexpr int kSteps = 10'000;
    double nearest = 10, most = -4;

    Scan(const LimitedArms& of, std::uint32_t n, const SwivelCircle& circle)
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

struct Tally {
    int arms = 0, moved = 0, none = 0, scanned = 0, limited_by_region = 0;
    int violating = 0, too_far = 0, missed = 0, not_least = 0, wrong_flag = 0;  // broken promises
    double worst = 1;                                                           // room
};

// Every arm against some places of the circle, and against the whole scan where one of them is nearer to the wish, and
// for one arm in 500.
void judge(Random& random, const LimitedArms& of, Tally& tally)
{
    Crowd crowd = of.crowd();
    crowd.solve();
    for (std::uint32_t n = 0; n < of.arms.size(); ++n, ++tally.arms) {
        const LimbPose pose = pose_of(crowd, n);
        const SwivelCircle circle(of.arms[n], pose);
        const bool allowed = !(pose.flags & SWIVEL_INFEASIBLE);
        const double swivel = swivel_of(of.arms[n], pose), room = of.room(n, pose);
        tally.none += !allowed, tally.moved += allowed && std::fabs(swivel) > 1e-4;
        if (allowed) tally.worst = std::min(tally.worst, room), tally.violating += room < -1e-6;
        const double region = of.region_room(circle.at(0));
        const bool is_limited = pose.flags & SWIVEL_LIMITED_REGION;
        tally.limited_by_region += is_limited;
        if (std::fabs(region) > kClear) tally.wrong_flag += is_limited != (region < 0);

        bool look = tally.arms % 500 == 0;
        const double turn = random.between(0, 0.2);
        for (int k = 0; k < 32 && !look; ++k) {
            const double place = std::remainder(turn + k * 2 * kPi / 32, 2 * kPi);
            if (allowed && std::fabs(place) >= std::fabs(swivel) - 1e-5) continue;
            look = of.room(n, circle.at(place)) >= kClear;
        }
        if (!look) continue;
        ++tally.scanned;
        const Scan scan(of, n, circle);
        const bool is_clear = scan.nearest <= kPi;
        tally.missed += is_clear && !allowed;
        tally.too_far += is_clear && std::fabs(swivel) > scan.nearest + 1e-5;
        // Outside of a box there is no one way to measure how far.
        if (!allowed && !(of.features & kBoxes)) tally.not_least += room < scan.most - 1e-6;
    }
}

#ifdef __SANITIZE_ADDRESS__  // an eighth of the speed
constexpr int kCrowds = 20;
#else
constexpr int kCrowds = 2000;
#endif

}  // namespace

TEST_CASE("of a million arms limits hold, the nearest swivel is found, and where there is none it is said")
{
    Random random{2};
    Tally tally;
    for (int n = 0; n < kCrowds; ++n) judge(random, LimitedArms(random, kCrowd, n % 4 == 0), tally);
    CAPTURE(tally.arms, tally.moved, tally.none, tally.scanned, tally.limited_by_region, tally.worst);
    CHECK(tally.violating == 0);
    CHECK(tally.too_far == 0);
    CHECK(tally.missed == 0);
    CHECK(tally.not_least == 0);
    CHECK(tally.wrong_flag == 0);
    CHECK(tally.moved > tally.arms / 10);
    CHECK(tally.none > tally.arms / 10);
    CHECK(tally.limited_by_region > tally.arms / 10);
}

TEST_CASE("limits hold, too, where the wished normal is close to the target's line")
{
    Random random{3};
    int moved = 0;
    for (int crowd_count = 0; crowd_count < 200; ++crowd_count) {
        const LimitedArms of(random, kCrowd, false);
        Crowd crowd = of.crowd(SWIVEL_POLE_NORMAL);
        for (std::uint32_t n = 0; n < kCrowd; ++n) {
            const double along = random.spread(1, 900) * (random.below(2) ? 1 : -1);
            const Arm& arm = of.arms[n].arm;
            const Float3 normal = floats(Vector3d(arm.normal() + along * arm.wrist.normalized()));
            crowd.write(SWIVEL_POLE, 0, std::span(&normal, 1), n);
        }
        crowd.solve();
        for (std::uint32_t n = 0; n < kCrowd; ++n) {
            const LimbPose pose = pose_of(crowd, n);
            if (pose.flags & SWIVEL_INFEASIBLE) continue;
            moved += std::fabs(swivel_of(of.arms[n], pose)) > 1e-2;
            REQUIRE(of.room(n, pose) >= -1e-6);
        }
    }
    CHECK(moved > 10'000);
}

TEST_CASE("a locked angle does not allow its opposite")
{
    const Ends<float> locked = ends(Range<float>{{1, 0}, {1, 0}});
    const Rooms<float> along = room_between(locked, 1.0f, 0.0f), against = room_between(locked, -1.0f, 0.0f);
    CHECK(along.front == 0);
    CHECK(along.back == -1);
    CHECK(against.front == -1);
    CHECK(against.back == 0);
}

TEST_CASE("where no middle angle is allowed, the one nearest its range is taken")
{
    // About -80 degrees, and the target keeps it at +69 and more.
    const Arm arm{Vector3d(1.9, 0, 0.1), Vector3d(0, -1, 0.3), 1, 1};
    FreeLimb limb(arm, SWIVEL_WITH_SHOULDER_BOX);
    limb.write(SWIVEL_SHOULDER_BOX, numbers(AngleBox{{0, 1, 2}, {{}, {-1.3963, 0.0873}, {}}}));
    const LimbPose pose = limb.solve();
    REQUIRE((pose.flags & SWIVEL_INFEASIBLE) != 0);
    const auto sine_at = [&](double angle) {  // of the middle angle, the swivel turned on by an angle
        return (Eigen::AngleAxisd(angle, arm.wrist.normalized()) * pose.shoulder).toRotationMatrix()(0, 2);
    };
    double least = 1;
    for (int n = 0; n < 3600; ++n) least = std::min(least, sine_at(n * kPi / 1800));
    CHECK(sine_at(0) <= least + 1e-5);
}
