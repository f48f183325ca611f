// SPDX-License-Identifier: MIT
//
// The promise: joint limits and regions hold. Where a swivel is allowed, the result violates none by more than 1e-6,
// and it is as near to the wish as a scan of the whole circle finds. Where no swivel is allowed, a flag says so, and
// rounding does not choose: among least violations within 1e-6 the one nearest to the wish is taken, then that of the
// lower line.
// The judges work in angles and half-spaces (limited_arms.h).
#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include "core/choose_swivel.h"
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
    double nearest = 10, max = -4;

    Scan(const LimitedArms& arms, std::uint32_t n, const SwivelCircle& circle)
    {
        const auto room_at = [&](double turn) { return arms.room(n, circle.at(turn)); };
        for (int k = 0; k <= kSteps / 2; ++k)
            for (const double sign : {1.0, -1.0}) {
                const double turn = 2 * kPi * k / kSteps, here = room_at(sign * turn);
                max = std::max(max, here);
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
void judge(Random& random, const LimitedArms& arms, Tally& tally)
{
    Crowd crowd = arms.crowd();
    crowd.solve();
    for (std::uint32_t n = 0; n < arms.arms.size(); ++n, ++tally.arms) {
        const LimbPose pose = pose_of(crowd, n);
        const SwivelCircle circle(arms.arms[n], pose);
        const bool allowed = !(pose.flags & SWIVEL_INFEASIBLE);
        const double swivel = swivel_of(arms.arms[n], pose), room = arms.room(n, pose);
        tally.none += !allowed, tally.moved += allowed && std::fabs(swivel) > 1e-4;
        if (allowed) tally.worst = std::min(tally.worst, room), tally.violating += room < -1e-6;
        const double region = arms.region_room(circle.at(0));
        const bool is_limited = pose.flags & SWIVEL_LIMITED_REGION;
        tally.limited_by_region += is_limited;
        if (std::fabs(region) > kClear) tally.wrong_flag += is_limited != (region < 0);

        bool look = tally.arms % 500 == 0;
        const double turn = random.between(0, 0.2);
        for (int k = 0; k < 32 && !look; ++k) {
            const double place = std::remainder(turn + k * 2 * kPi / 32, 2 * kPi);
            if (allowed && std::fabs(place) >= std::fabs(swivel) - 1e-5) continue;
            look = arms.room(n, circle.at(place)) >= kClear;
        }
        if (!look) continue;
        ++tally.scanned;
        const Scan scan(arms, n, circle);
        const bool is_clear = scan.nearest <= kPi;
        tally.missed += is_clear && !allowed;
        tally.too_far += is_clear && std::fabs(swivel) > scan.nearest + 1e-5;
        // Outside of a box there is no one way to measure how far.
        if (!allowed && !(arms.features & kBoxes)) tally.not_least += room < scan.max - 1e-6;
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
        const LimitedArms arms(random, kCrowd, false);
        Crowd crowd = arms.crowd(SWIVEL_POLE_NORMAL);
        for (std::uint32_t n = 0; n < kCrowd; ++n) {
            const double along = random.spread(1, 900) * (random.below(2) ? 1 : -1);
            const Arm& arm = arms.arms[n].arm;
            const Float3 normal = floats(Vector3d(arm.normal() + along * arm.wrist.normalized()));
            crowd.write(SWIVEL_POLE, 0, std::span(&normal, 1), n);
        }
        crowd.solve();
        for (std::uint32_t n = 0; n < kCrowd; ++n) {
            const LimbPose pose = pose_of(crowd, n);
            if (pose.flags & SWIVEL_INFEASIBLE) continue;
            moved += std::fabs(swivel_of(arms.arms[n], pose)) > 1e-2;
            REQUIRE(arms.room(n, pose) >= -1e-6);
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
    limb.write(SWIVEL_SHOULDER_BOX, box_of({{0, 1, 2}, {{}, {-1.3963, 0.0873}, {}}}));
    const LimbPose pose = limb.solve();
    REQUIRE((pose.flags & SWIVEL_INFEASIBLE) != 0);
    const auto sine_at = [&](double angle) {  // of the middle angle, the swivel turned on by an angle
        return (Eigen::AngleAxisd(angle, arm.wrist.normalized()) * pose.shoulder).toRotationMatrix()(0, 2);
    };
    double min = 1;
    for (int n = 0; n < 3600; ++n) min = std::min(min, sine_at(n * kPi / 1800));
    CHECK(sine_at(0) <= min + 1e-5);
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
Limits<float> two_peaks(double peak, double min, double tilt)
{
    const double s = std::sin(peak), c = std::cos(peak);
    return both(line(tilt * c - s, tilt * s + c, min), line(tilt * c + s, tilt * s - c, min));
}
double angle(const Turned<float>& turn) { return std::atan2(double{turn.sin}, double{turn.cos}); }
bool is_at(const FoundSwivel<float>& found, double phi)
{
    return std::fabs(std::remainder(angle(found.swivel) - phi, 2 * kPi)) < 1e-5;
}
// The swivel of a limb whose limits allow no end of an arc.
FoundSwivel<float> found_without_end(const Limits<float>& limits)
{
    REQUIRE_FALSE(nearest_end(limits).allowed);
    return min_violation(limits);
}

}  // namespace

TEST_CASE("of two least violations within 1e-6, the one nearer to the wish is taken")
{
    rc::prop("whichever rounding prefers", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < 100; ++n) {
            const double far = random.between(1.7, 4.5), near = far + kPi;  // by their distance from 0
            const double room = random.between(-0.9, -0.01);
            RC_ASSERT(is_at(found_without_end(two_peaks(far, room, random.between(-3e-7, 3e-7))), near));
            RC_ASSERT(is_at(found_without_end(two_peaks(far, room, 3e-6)), far));  // 6e-6 more room
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
            RC_ASSERT(found_without_end(limits).swivel.sin > 0.1f);
            std::swap(limits.line[1], limits.line[2]);
            RC_ASSERT(found_without_end(limits).swivel.sin < -0.1f);
        }
    });
}

TEST_CASE("an allowed swivel ties with no other")
{
    // The arc at the farther peak is too short for its ends to be found. The nearer one violates the limits by 1.15e-6.
    for (const double far : {2.0, 2.5, 3.0, 4.0}) {
        const Limits<float> limits = two_peaks(far, -7.5e-7, 4e-7);
        const FoundSwivel<float> found = found_without_end(limits);
        CHECK(found.allowed);
        CHECK(is_at(found, far));
    }
}
