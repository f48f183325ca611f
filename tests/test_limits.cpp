// SPDX-License-Identifier: MIT
//
// The promise: joint limits hold. Where a swivel is allowed, the result violates no limit by more than 1e-6. It is as
// near to the wish as a scan of the whole circle finds. Where no swivel is allowed, a flag says so. The judge works in
// angles (limit_oracle.h).
#include <catch2/catch.hpp>
#include <vector>

#include "core/limb.h"
#include "tests/formula_limb.h"
#include "tests/limit_oracle.h"

namespace {

using namespace swivel;
using namespace swivel::test;

struct LimitedArm {
    Arm arm;
    Quaterniond hand;
    LimitUse use;
    Vector3d shoulder_axis, hand_axis, twist_axis;
    double shoulder_cos, hand_cos;
    AngleRange humeral, forearm, hand_twist;
    AngleBox shoulder_box, wrist_box;
};

template <class T>
Range<T> formula_range(const AngleRange& range)
{
    const auto turned = [](double x) { return Turned<T>{static_cast<T>(std::cos(x)), static_cast<T>(std::sin(x))}; };
    Range<T> out{turned(range.middle), turned(range.half)};
    out.half.sin = std::fabs(out.half.sin);
    return out;
}
AngleRange rounded_range(const AngleRange& range)
{
    const Range<float> r = formula_range<float>(range);
    return {std::atan2(double{r.middle.sin}, double{r.middle.cos}), std::atan2(double{r.half.sin}, double{r.half.cos})};
}
Vector3d rounded(const Vector3d& v) { return v.cast<float>().cast<double>(); }
double rounded(double x) { return static_cast<float>(x); }

AngleRange random_range(Random& random, double least)
{
    return rounded_range({random.between(-kPi, kPi), random.spread(least, kPi)});
}
AngleBox random_box(Random& random, const EulerOrder& order)
{
    AngleBox box{{order.first, order.middle, order.last}, {}};
    const double least = random.below(4) ? 0.1 : 0.004;
    for (AngleRange& range : box.range) range = random_range(random, least);
    if (random.below(2)) box.range[1] = rounded_range({random.between(-0.5, 0.5), random.spread(least, 1)});
    return box;
}

LimitedArm random_arm(Random& random)
{
    LimitedArm a;
    const double upper = random.between(0.2, 0.4), fore = upper * random.between(0.6, 1.6);
    const double near = std::fabs(upper - fore), far = upper + fore;
    const Vector3d line = random.direction();
    a.arm = rounded(Arm{random.between(near + 0.02 * (far - near), far) * line,
                        random.between(-1, 1) * line + random.spread(0.05, 1) * random.across(line), upper, fore});
    a.hand = random.rotation();
    a.hand.coeffs() = a.hand.coeffs().cast<float>().cast<double>();
    a.hand.normalize();
    const auto axis = [&] { return rounded(random.direction()); };
    a.shoulder_axis = axis(), a.hand_axis = axis(), a.twist_axis = axis();
    a.shoulder_cos = rounded(random.between(-0.99, 0.99)), a.hand_cos = rounded(random.between(-0.99, 0.95));
    a.humeral = random_range(random, 0.05), a.forearm = random_range(random, 0.05);
    a.hand_twist = random_range(random, 0.05);
    const std::uint32_t kinds = random.word();
    a.use.shoulder_cone = kinds & 1, a.use.humeral_twist = kinds & 2;
    a.use.hand_cone = kinds & 4 && kinds & 8, a.use.forearm_twist = kinds & 16 && kinds & 32;
    a.use.hand_twist = kinds & 64 && kinds & 128, a.use.shoulder_box = kinds & 256 && kinds & 512;
    a.use.wrist_box = kinds & 1024 && kinds & 2048;
    a.use.shoulder_order = kEulerOrders[random.below(6)], a.use.wrist_order = kEulerOrders[random.below(6)];
    a.shoulder_box = random_box(random, a.use.shoulder_order), a.wrist_box = random_box(random, a.use.wrist_order);
    return a;
}

template <class T>
SolvedLimb<T> solve(const LimitedArm& a)
{
    LimbUse use;
    use.hand = true;
    use.limits = a.use;
    LimbGoal<T> goal{};
    goal.arm = {mv<T>(a.arm.wrist), mv<T>(a.arm.pole), static_cast<T>(a.arm.upper), static_cast<T>(a.arm.fore)};
    goal.hand = rotor(static_cast<T>(a.hand.x()), static_cast<T>(a.hand.y()), static_cast<T>(a.hand.z()),
                      static_cast<T>(a.hand.w()));
    JointLimits<T>& limits = goal.limits;
    limits.shoulder_cone = {mv<T>(a.shoulder_axis), static_cast<T>(a.shoulder_cos)};
    limits.hand_cone = {mv<T>(a.hand_axis), static_cast<T>(a.hand_cos)};
    limits.humeral_twist = formula_range<T>(a.humeral);
    limits.forearm_twist = formula_range<T>(a.forearm);
    limits.hand_twist = {mv<T>(a.twist_axis), formula_range<T>(a.hand_twist)};
    for (int n = 0; n < 3; ++n) {
        limits.shoulder_box[n] = formula_range<T>(a.shoulder_box.range[n]);
        limits.wrist_box[n] = formula_range<T>(a.wrist_box.range[n]);
    }
    return solve_limb<false>(use, goal, Mask<T>(true));
}

// The arm at a swivel from the wish, in double, from its elbow's place.
struct ArmAt {
    Quaterniond shoulder, wrist;
};
struct Circle {
    Vector3d line, wish, across;  // across: a quarter turn on from the wish
    double along, away;           // the upper arm, of length 1, along the line and from it
    Quaterniond elbow, hand;

    explicit Circle(const LimitedArm& a)
        : line(a.arm.wrist.normalized()), wish(a.arm.normal()), across(line.cross(wish)), hand(a.hand)
    {
        const double d = std::min(a.arm.wrist.norm(), a.arm.length()), upper = a.arm.upper, fore = a.arm.fore;
        along = (d * d + upper * upper - fore * fore) / (2 * d * upper);
        away = std::sqrt(std::max(0.0, 1 - along * along));
        const double cosine = (d * d - upper * upper - fore * fore) / (2 * upper * fore);
        elbow = Quaterniond(Eigen::AngleAxisd(-std::acos(std::clamp(cosine, -1.0, 1.0)), Vector3d::UnitX()));
    }
    ArmAt at(double swivel) const
    {
        const Vector3d normal = std::cos(swivel) * wish + std::sin(swivel) * across;
        const Vector3d bone = along * line + away * normal.cross(line);
        Eigen::Matrix3d r;
        r << normal, bone.cross(normal), bone;
        const Quaterniond shoulder(r);
        return {shoulder, (shoulder * elbow).conjugate() * hand};
    }
};

double violation(const LimitedArm& a, const ArmAt& at)
{
    double worst = -1;
    const auto broken = [&](double by) { worst = std::max(worst, by); };
    const Vector3d e3 = Vector3d::UnitZ();
    if (a.use.shoulder_cone) broken(cone_violation(a.shoulder_axis, a.shoulder_cos, at.shoulder * e3));
    if (a.use.humeral_twist) broken(twist_violation(e3, a.humeral, at.shoulder));
    if (a.use.shoulder_box) broken(box_violation(a.shoulder_box, at.shoulder.toRotationMatrix()));
    if (a.use.hand_cone) broken(cone_violation(e3, a.hand_cos, at.wrist * a.hand_axis));
    if (a.use.forearm_twist) broken(twist_violation(e3, a.forearm, at.wrist));
    if (a.use.hand_twist) broken(twist_violation(a.twist_axis, a.hand_twist, at.wrist));
    if (a.use.wrist_box) broken(box_violation(a.wrist_box, at.wrist.toRotationMatrix()));
    return worst;
}

// The swivel that a pose took, from the wish, -pi to pi.
template <class T>
double swivel_of(const LimitedArm& a, const SolvedLimb<T>& pose)
{
    const Vector3d line = a.arm.wrist.normalized(), wish = a.arm.normal();
    const Vector3d normal = eigen(pose.arm.shoulder).normalized() * Vector3d::UnitX();
    return std::atan2(wish.cross(normal).dot(line), wish.dot(normal));
}

struct Scan {
    int allowed = 0;
    double best = kPi;      // the least swivel allowed, without sign
    double half_width = 0;  // of the arc it belongs to
    double least = 10;      // violation anywhere
};
Scan scan(const LimitedArm& a, const Circle& circle, int steps)
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
        const LimitedArm a = random_arm(random);
        const Circle circle(a);
        const SolvedLimb<T> pose = solve<T>(a);
        const bool allowed = !(pose.arm.flags & flag::infeasible);
        const double swivel = swivel_of(a, pose);
        const double by = violation(a, {eigen(pose.arm.shoulder).normalized(), eigen(pose.wrist).normalized()});
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
            // The pose itself is as far off as floats know the elbow's height over the line: of a straight arm, a root.
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

TEST_CASE("a locked angle does not allow its opposite")
{
    const Ends<float> locked = ends(Range<float>{{1, 0}, {1, 0}});
    CHECK(room_between(locked, 1.0f, 0.0f, 1.0f) == 0);
    CHECK(room_between(locked, -1.0f, 0.0f, 1.0f) == -1);
    CHECK(room_between(locked, -1.0f, 0.0f, -1.0f) == 0);
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
    REQUIRE((got.pose.arm.flags & flag::infeasible) != 0);
    const auto sine_at = [&](double angle) {  // of the middle angle, the swivel turned on by an angle
        const Quaterniond shoulder = eigen(got.pose.arm.shoulder).normalized();
        return (Eigen::AngleAxisd(angle, arm.wrist.normalized()) * shoulder).toRotationMatrix()(0, 2);
    };
    double least = 1;
    for (int n = 0; n < 3600; ++n) least = std::min(least, sine_at(n * kPi / 1800));
    CHECK(sine_at(0) <= least + 1e-5);
}
