// SPDX-License-Identifier: MIT
//
// The promise: joint limits hold. Where a swivel is allowed, the result violates no limit by more than 1e-6. It is as
// near to the wish as a scan of the whole circle finds. Where no swivel is allowed, a flag says so. The judge works in
// angles (limit_oracle.h).
#include <catch2/catch.hpp>
#include <vector>

#include "tests/limited_arm.h"

namespace {

using namespace swivel;
using namespace swivel::test;

struct Scan {
    int allowed = 0;
    double best = kPi;      // the least swivel allowed, without sign
    double half_width = 0;  // of the arc it belongs to
    double least = 10;      // violation anywhere
};
Scan scan(const LimitedArm& a, const SwivelCircle& circle, int steps)
{
    Scan out;
    std::vector<char> ok(static_cast<std::size_t>(steps));
    int nearest = -1;
    for (int n = 0; n < steps; ++n) {
        const double swivel = 2 * kPi * n / steps;
        const double by = violation(a, circle.at(swivel));
        out.least = std::min(out.least, by);
        ok[static_cast<std::size_t>(n)] = by <= 0;
        if (!ok[static_cast<std::size_t>(n)]) continue;
        ++out.allowed;
        const double size = std::min(swivel, 2 * kPi - swivel);
        if (nearest < 0 || size < out.best) out.best = size, nearest = n;
    }
    if (nearest < 0) return out;
    int width = 1;
    for (const int way : {1, -1})
        for (int n = nearest + way; width < steps && ok[static_cast<std::size_t>((n + steps) % steps)]; n += way)
            ++width;
    out.half_width = kPi * width / steps;
    return out;
}
constexpr int kScanSteps = 10000;

// How much further from the wish than the scan's best a swivel may be.
double allowance(const Scan& seen)
{
    return 1e-5 + (seen.half_width > 5e-4 ? 1e-6 / std::sin(std::min(seen.half_width, kPi / 2)) : 5e-4);
}

struct Tally {
    int arms = 0, allowed = 0, moved = 0, none = 0, scanned = 0;
    int violating = 0, too_far = 0, missed = 0, not_least = 0;  // broken promises
    double worst = -1;
};

// Every arm against some places of the circle, and against the whole scan where one of them is nearer to the wish, and
// for one arm in `often`.
template <class T>
Tally judge(std::uint64_t seed, int arms, int often)
{
    Random random{seed};
    Tally tally;
    for (; tally.arms < arms; ++tally.arms) {
        const LimitedArm a = random_limited_arm(random);
        const SwivelCircle circle(a);
        const SolvedLimb<T> pose = solve<T>(a);
        const bool allowed = !(pose.arm.flags & SWIVEL_INFEASIBLE);
        const double swivel = swivel_of(a, pose);
        const double by = violation(a, pose);
        tally.allowed += allowed, tally.none += !allowed;
        tally.moved += allowed && std::fabs(swivel) > 1e-4;
        if (allowed) tally.worst = std::max(tally.worst, by), tally.violating += by > 1e-6;

        bool look = tally.arms % often == 0;
        const double turn = random.between(0, 0.2);
        for (int n = 0; n < 32 && !look; ++n) {
            const double place = std::remainder(turn + n * 2 * kPi / 32, 2 * kPi);
            if (allowed && std::fabs(place) >= std::fabs(swivel) - 1e-5) continue;
            look = violation(a, circle.at(place)) <= 0;
        }
        if (!look) continue;
        ++tally.scanned;
        const Scan seen = scan(a, circle, kScanSteps);
        tally.missed += !allowed && seen.allowed > 1;
        // Outside of a box there is no one way to measure how far.
        if (!allowed && !a.use.shoulder_box && !a.use.wrist_box) {
            tally.not_least += violation(a, circle.at(swivel)) > seen.least + 1e-6;
            tally.not_least += by > seen.least + 1e-6 + 2e-7 / circle.away;
        }
        tally.too_far += allowed && seen.allowed > 0 && std::fabs(swivel) > seen.best + allowance(seen);
    }
    return tally;
}

template <class T>
void check(std::uint64_t seed, int arms, int often)
{
    const Tally tally = judge<T>(seed, arms, often);
    CAPTURE(tally.allowed, tally.moved, tally.none, tally.scanned, tally.worst);
    CHECK(tally.violating == 0);
    CHECK(tally.too_far == 0);
    CHECK(tally.missed == 0);
    CHECK(tally.not_least == 0);
    CHECK(tally.moved > arms / 10);
    CHECK(tally.none > arms / 10);
    CHECK(tally.scanned >= arms / often);
}

#ifdef __SANITIZE_ADDRESS__  // an eighth of the speed
constexpr int kArms = 10'000;
#else
constexpr int kArms = 1'000'000;
#endif

}  // namespace

TEST_CASE("in double: a scan of the whole circle finds nothing better") { check<double>(1, 2000, 4); }

TEST_CASE("in float, a million arms: limits hold, the nearest swivel is found, and where there is none it is said")
{
    check<float>(2, kArms, 500);
}

TEST_CASE("limits hold, too, where the wished normal is close to the target's line")
{
    Random random{3};
    int moved = 0;
    for (int n = 0; n < 100'000; ++n) {
        const LimitedArm a = random_limited_arm(random);
        LimbGoal<float> goal = goal_of<float>(a);
        const double along = random.spread(1, 900) * (random.below(2) ? 1 : -1);
        goal.arm.pole = mv<float>(Vector3d(a.arm.normal() + along * a.arm.wrist.normalized()));
        const SolvedLimb<float> pose = solve(a, goal, Wish::normal);
        if (pose.arm.flags & SWIVEL_INFEASIBLE) continue;
        moved += std::fabs(swivel_of(a, pose)) > 1e-2;
        CAPTURE(n, along);
        REQUIRE(violation(a, pose) <= 1e-6);
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
    LimbUse use;
    use.limits.shoulder_box = true;
    const Arm arm{Vector3d(1.9, 0, 0.1), Vector3d(0, -1, 0.3), 1, 1};
    LimbGoal<float> goal = limb_goal<float>(arm);
    goal.limits.shoulder_box[1] = {turned<float>(-1.3963), turned<float>(0.0873)};
    const Solved<float> got = solve(use, goal);
    REQUIRE((got.pose.arm.flags & SWIVEL_INFEASIBLE) != 0);
    const auto sine_at = [&](double angle) {  // of the middle angle, the swivel turned on by an angle
        const Quaterniond shoulder = eigen(got.pose.arm.shoulder).normalized();
        return (Eigen::AngleAxisd(angle, arm.wrist.normalized()) * shoulder).toRotationMatrix()(0, 2);
    };
    double least = 1;
    for (int n = 0; n < 3600; ++n) least = std::min(least, sine_at(n * kPi / 1800));
    CHECK(sine_at(0) <= least + 1e-5);
}
