// SPDX-License-Identifier: MIT
//
// The promise: with a largest swivel for each frame, the elbow never swivels further in a frame, whatever target and
// pole do. Only joint limits make it jump, and a flag says so. Without a largest swivel, the elbow jumps only where
// swivel.h says. Where the step wins, limits do not make it jump either: it is where they allow within half a second.
// A reset forgets the swivel. Eigen judges, from the results.
#include <optional>
#include <string>
#include <vector>

#include <rapidcheck/catch.h>
#include <catch2/catch.hpp>

#include "tests/limited_arms.h"
#include "tests/test_arm.h"

using namespace swivel;
using namespace swivel::test;

namespace {

// How far a normal has swivelled since the one before, carried across the new line.
double step(const Vector3d& before, const Vector3d& now, const Vector3d& line)
{
    const Vector3d carried = before - before.dot(line) * line;
    return angle_between(carried, now);
}

using Path = std::vector<Arm>;
constexpr int kFrames = 400;

template <class Place>
Path path(Place place)
{
    Path arms;
    for (int n = 0; n <= kFrames; ++n) arms.push_back(rounded(place(2.0 * n / kFrames - 1)));  // t from -1 to 1
    return arms;
}

// Paths through everything that is hard; t = 0 is the hard place.
struct NamedPath {
    std::string name;
    Path path;
};
std::vector<NamedPath> hard_paths()
{
    const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
    return {
        {"through the straight arm", path([&](double t) {
             return Arm{(0.6 - 0.1 * t) * z + 0.05 * t * x, y, 0.3, 0.3};
         })},
        {"through the folded arm", path([&](double t) {
             return Arm{0.2 * t * z + 1e-3 * x + 2e-3 * y, Vector3d(x + y), 0.3, 0.3};
         })},
        {"folded, unequal bones", path([&](double t) {
             return Arm{(0.1 + 0.1 * t) * z + 0.01 * x, y, 0.35, 0.25};
         })},
        {"across the pole", path([&](double t) {
             return Arm{0.4 * (z + 0.5 * t * x + 1e-4 * y).normalized(), z, 0.3, 0.3};
         })},
        {"across the pole's opposite", path([&](double t) {
             return Arm{-0.4 * (z + 0.5 * t * x + 1e-4 * y).normalized(), z, 0.3, 0.3};
         })},
        {"exactly over the pole", path([&](double t) {
             return Arm{0.4 * (z + 0.5 * t * x).normalized(), z, 0.3, 0.3};
         })},
        {"the pole leaps over the arm", path([&](double t) {
             return Arm{0.4 * z, Vector3d(t < 0 ? x : -x) + 0.1 * y, 0.3, 0.3};
         })},
    };
}

struct Run {
    double largest = 0;  // swivel in a frame
    int largest_frame = 0;
    int jumped = 0;
    Vector3d last;  // normal of the swivel plane
};
// most: of the swivel in a frame; none: no limit.
Run run(const Path& arms, std::optional<double> max)
{
    FreeLimb limb(arms[0], max ? SWIVEL_WITH_MAX_SWIVEL : 0);
    if (max) limb.write(SWIVEL_MAX_SWIVEL, cos_sin(*max));
    Run out;
    for (std::size_t n = 0; n < arms.size(); ++n) {
        write_arm(limb.crowd, 0, arms[n]);
        const LimbPose got = limb.solve();
        const double by = n > 0 ? step(out.last, got.hinge(), arms[n].wrist.normalized()) : 0;
        if (by > out.largest) out.largest = by, out.largest_frame = static_cast<int>(n);
        out.jumped += (got.flags & SWIVEL_JUMPED) != 0;
        out.last = got.hinge();
    }
    return out;
}

}  // namespace

TEST_CASE("the swivel of a frame stays under the limit on every hard path")
{
    for (const NamedPath& hard : hard_paths())
        for (const double max : {0.02, 0.1, 0.5}) {
            INFO(hard.name << ", most " << max);
            const Run got = run(hard.path, max);
            CHECK(got.largest <= max + 1e-5);
            CHECK(got.jumped == 0);
        }
}

TEST_CASE("without the limit the elbow jumps where it is said to, and only there")
{
    for (const NamedPath& hard : hard_paths()) {
        INFO(hard.name);
        const Run got = run(hard.path, {});
        const bool passes_shoulder = hard.name == "through the folded arm";
        const bool passes_pole = hard.name.find("pole") != std::string::npos;
        if (passes_shoulder || passes_pole)
            CHECK(std::abs(got.largest_frame - kFrames / 2) <= 2);
        else
            CHECK(got.largest <= 0.05);
    }
}

TEST_CASE("random walks of target and pole stay under the limit, and follow the pole within it")
{
    rc::prop("with nothing else", [](std::uint64_t seed) {
        Random random{seed};
        const double max = random.between(0.01, 1);
        Path arms;
        Vector3d wrist = 0.4 * random.direction(), pole = random.direction();
        for (int n = 0; n < 300; ++n) {
            wrist += 0.05 * random.direction(), pole += 0.2 * random.direction();
            arms.push_back(rounded(Arm{wrist, pole, 0.3, 0.25}));
        }
        arms.insert(arms.end(), 400, Arm(arms.back()));  // time to come to rest at the pole
        const Run got = run(arms, max);
        RC_ASSERT(got.largest <= max + 2e-5);
        const double sine = arms.back().wrist.normalized().cross(arms.back().pole.normalized()).norm();
        if (sine > 0.05) RC_ASSERT((got.last - solve_all({arms.back()})[0].hinge()).norm() <= 1e-5);
    });
}

TEST_CASE("an angle is not turned on while the pole does not say where the elbow goes")
{
    const Arm arm{{0, 0, 1.2}, {0, -1, 0}, 1, 1};
    FreeLimb limb(arm, SWIVEL_WITH_ANGLE | SWIVEL_WITH_MAX_SWIVEL);
    limb.write(SWIVEL_ANGLE, cos_sin(0.5));
    const Vector3d first = limb.solve().hinge();
    limb.write(SWIVEL_POLE, Float3{0, 0, 5});  // along the line
    for (int frame = 0; frame < 4; ++frame) CHECK((limb.solve().hinge() - first).norm() <= 1e-6);
}

TEST_CASE("steps of any size are told from larger ones, 1e-4 rad and half a turn among them, and go towards the wish")
{
    Random random{9};
    for (int n = 0; n < 3000; ++n) {
        const Arm arm = random_reachable(random);
        const Vector3d line = arm.wrist.normalized(), free = solve_all({arm})[0].hinge();
        FreeLimb limb(arm, SWIVEL_WITH_MAX_SWIVEL);
        const double max = random.spread(1e-4, 3);
        limb.write(SWIVEL_MAX_SWIVEL, cos_sin(max)), limb.write(SWIVEL_NORMAL, floats(free));
        CHECK(limb.solve().flags == SWIVEL_REACHED);  // it is there already
        const double away = random.between(max + 1e-3, kPi);
        const Vector3d far = Eigen::AngleAxisd(random.below(2) ? away : -away, line) * free;
        limb.write(SWIVEL_NORMAL, floats(far));
        const LimbPose got = limb.solve();
        INFO("most " << max << ", from " << away);
        CHECK(step(far, got.hinge(), line) <= max * (1 + 1e-5) + 2e-6);
        CHECK(step(free, got.hinge(), line) == Approx(away - max).margin(1e-5));
        CHECK((got.flags & SWIVEL_LIMITED_STEP) != 0);
        // Half a turn is no limit, however it is rounded.
        for (const double half_turn : {kPi, double{3.14159274f}}) {
            limb.write(SWIVEL_MAX_SWIVEL,
                       std::array{static_cast<float>(std::cos(half_turn)), static_cast<float>(std::sin(half_turn))});
            limb.write(SWIVEL_NORMAL, floats(Vector3d(-free)));
            CHECK(limb.solve().flags == SWIVEL_REACHED);
        }
    }
}

TEST_CASE("the swivel carried from solve to solve is forgotten on reset")
{
    for (const bool is_reset : {false, true}) {
        FreeLimb limb({{0, 0, 1}, {0, -1, 0}, 1, 1}, SWIVEL_WITH_MAX_SWIVEL);
        limb.write(SWIVEL_MAX_SWIVEL, cos_sin(0.1));
        limb.solve();
        limb.write(SWIVEL_POLE, Float3{0, 1, 0.1f});
        if (is_reset) CHECK(swivel_reset(limb.crowd.get(), 0, 0, 1) == SWIVEL_OK);
        const LimbPose pose = limb.solve();
        CHECK(pose.flags == (is_reset ? SWIVEL_REACHED : SWIVEL_REACHED | SWIVEL_LIMITED_STEP));
        CHECK(std::fabs(pose.hinge().x() - (is_reset ? -1 : std::cos(0.1))) <= 1e-6);
    }
}

TEST_CASE("a carried swivel turns an aiming arm no further than its step")
{
    FreeLimb limb({{0, 0, 5}, {0, -1, 0}, 1, 1}, SWIVEL_WITH_AIM | SWIVEL_WITH_MAX_SWIVEL);
    limb.write(SWIVEL_AIM, aim({0, 0, 1}, 1)), limb.write(SWIVEL_MAX_SWIVEL, cos_sin(0.1));
    const Quaterniond before = limb.solve().shoulder;
    limb.write(SWIVEL_POLE, Float3{1, 0, 0});
    const LimbPose after = limb.solve();
    CHECK(after.flags == (SWIVEL_REACHED | SWIVEL_LIMITED_STEP));
    CHECK(2 * std::acos(std::fabs(before.dot(after.shoulder))) == Approx(0.1).margin(1e-3));
}

TEST_CASE("a step of less than 0 is bad input")
{
    FreeLimb limb({{0, 0, 1}, {0, -1, 0}, 1, 1}, SWIVEL_WITH_MAX_SWIVEL);
    limb.write(SWIVEL_MAX_SWIVEL, cos_sin(-0.1));
    CHECK(limb.solve().flags == SWIVEL_BAD_INPUT);
}

namespace {

constexpr std::uint32_t kCharacters = 500;
constexpr int kWalkFrames = 300, kHalfSecond = 30;  // at 60 a second
constexpr double kStep = 0.15;                      // radians a frame

struct Kind {
    std::string name;
    swivel_features feature;
};
std::vector<Kind> every_kind()
{
    std::vector<Kind> kinds = {{"region", SWIVEL_WITH_REGION}};
    for (const Limit& limit : kOpenLimits) kinds.push_back({describe(limit.field).name, limit.feature});
    return kinds;
}

// Arms with one kind of limit, whose wrists, poles and hands go round smoothly.
struct Walk {
    LimitedArms arms;
    std::vector<LimitedArm> start;
    std::vector<Vector3d> axis;

    Walk(Random& random, const Kind& kind) : arms(random, kCharacters, true)
    {
        arms.features = SWIVEL_WITH_HAND | kind.feature;
        for (std::uint32_t n = 0; n < kCharacters; ++n) axis.push_back(random.direction());
        start = arms.arms;
    }
    void go_to(int frame)
    {
        for (std::size_t n = 0; n < start.size(); ++n) {
            const double time = frame / 60.0;
            const auto turn = [&](double speed) { return Quaterniond(Eigen::AngleAxisd(speed * time, axis[n])); };
            Arm& arm = arms.arms[n].arm;
            arm.wrist = rounded(turn(0.7) * start[n].arm.wrist);
            arm.pole = rounded(turn(-0.5) * start[n].arm.pole);
            arms.arms[n].hand = turn(0.6) * start[n].hand;
            arms.arms[n].hand.coeffs() = arms.arms[n].hand.coeffs().cast<float>().cast<double>();
            arms.arms[n].hand.normalize();
        }
    }
    bool is_within(std::uint32_t n, const LimbPose& pose) const { return arms.room(n, pose) >= -5e-6; }
};

struct Seen {
    double largest = 0;  // turn of a frame
    int longest = 0;     // frames outside, while some place is allowed
    int outside = 0, jumped = 0, unflagged = 0;
    int wrongly_said = 0;  // that the elbow jumped, or not

    Seen(Random random, const Kind& kind, swivel_features more)
    {
        Walk walk(random, kind);
        Crowd crowd = walk.arms.crowd(SWIVEL_WITH_MAX_SWIVEL | more);
        crowd.write_all(SWIVEL_MAX_SWIVEL, 0, cos_sin(kStep));
        std::vector<Vector3d> before(kCharacters);
        std::vector<int> lasts(kCharacters);
        for (int frame = 0; frame < kWalkFrames; ++frame) {
            walk.go_to(frame);
            for (std::uint32_t n = 0; n < kCharacters; ++n) walk.arms.write(crowd, n);
            crowd.solve();
            for (std::uint32_t n = 0; n < kCharacters; ++n) {
                const LimbPose pose = pose_of(crowd, n);
                const Vector3d now = pose.hinge(), line = walk.arms.arms[n].arm.wrist.normalized();
                const double turned = frame > 0 ? step(before[n], now, line) : 0;
                const bool is_jump = (pose.flags & SWIVEL_JUMPED) != 0;
                largest = std::max(largest, turned), jumped += is_jump;
                if (std::fabs(turned - kStep) > 1e-4) wrongly_said += is_jump != (turned > kStep);
                before[n] = now;
                const bool is_out = !(pose.flags & SWIVEL_INFEASIBLE) && !walk.is_within(n, pose);
                lasts[n] = is_out ? lasts[n] + 1 : 0;
                longest = std::max(longest, lasts[n]);
                outside += is_out;
                unflagged += is_out && !(pose.flags & SWIVEL_LIMITED_STEP);
            }
        }
    }
};

TEST_CASE("where the step wins no elbow pops, whatever the limit, and each is within its limits within half a second")
{
    Random random{41};
    for (const Kind& kind : every_kind()) {
        const Seen popping(random, kind, 0), seen(random, kind, SWIVEL_STEP_WINS);
        INFO(kind.name << ": " << seen.largest << " rad a frame, without " << popping.largest << "; outside for "
                       << seen.longest << " frames, " << seen.outside << " in all; without, jumped " << popping.jumped);
        CHECK(seen.largest <= kStep + 1e-5);
        CHECK(seen.longest <= kHalfSecond);
        CHECK(seen.unflagged == 0);
        CHECK(seen.jumped == 0);
        CHECK(seen.outside > 0);
        CHECK(popping.outside == 0);  // limits win over the largest swivel, and the elbow pops
        CHECK(popping.largest > kStep + 0.05);
        CHECK(popping.jumped > 0);
        CHECK(popping.wrongly_said == 0);
    }
}

TEST_CASE("where the step wins an elbow ends where it would be without a step")
{
    Random random{42};
    const LimitedArms before(random, kCharacters, true);
    LimitedArms arms = before;
    for (LimitedArm& arm : arms.arms) arm.arm.wrist = rounded(arm.arm.wrist.norm() * random.direction());
    Crowd crowd = before.crowd(SWIVEL_WITH_MAX_SWIVEL | SWIVEL_STEP_WINS), free = arms.crowd();
    crowd.write_all(SWIVEL_MAX_SWIVEL, 0, cos_sin(kStep));
    crowd.solve(), free.solve();
    for (std::uint32_t n = 0; n < kCharacters; ++n) arms.write(crowd, n);
    crowd.solve();
    int on_their_way = 0, limited = 0;
    for (std::uint32_t n = 0; n < kCharacters; ++n)
        on_their_way += (pose_of(crowd, n).flags & SWIVEL_LIMITED_STEP) != 0;
    for (int frame = 0; frame < kHalfSecond; ++frame) crowd.solve();
    for (std::uint32_t n = 0; n < kCharacters; ++n) {
        const LimbPose limb = pose_of(crowd, n), wanted = pose_of(free, n);
        CHECK(limb.flags == wanted.flags);
        CHECK(distance(limb.shoulder, wanted.shoulder) < 1e-5);
        limited += (limb.flags & SWIVEL_LIMITED_REGION) != 0;
    }
    CHECK(on_their_way > 100);
    CHECK(limited > 100);
}

}  // namespace
