// SPDX-License-Identifier: MIT
//
// The promise: feet stand on ground as it lies, for which the library asks once for each chosen foot. What they do on
// hills is measured by forward kinematics of Eigen's, in double: how far soles are from the ground, how they slide, and
// how fast legs turn. docs/howto/feet.md has some of the numbers.
#include <catch2/catch.hpp>

#include <atomic>

#include "tests/hill_walkers.h"
#include "tests/test_scopes.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr int kWalkedFrames = 600;
constexpr std::uint32_t kFewWalkers = 40;

// The worst that walkers do. Lengths in metres, turns in radians a frame.
struct Gait {
    double rest = 0;           // how far a toe that is planted and at rest is from its plane
    double from_ground = 0;    // the same from the ground itself
    double heel = 0, toe = 0;  // how far below the plane of a leg that reaches; of the heel, while it is planted
    double short_toe = 0;      // how far below the plane of a leg that is too short
    double under_ground = 0;   // how far below the ground itself
    double slide = 0;          // of a toe at rest, in a frame
    double shin = 0, foot = 0, pelvis = 0;  // in a frame; the pelvis along up
    int rest_count = 0;

    // As on hills: planes touch smooth ground, which is not the planes.
    void check_on_hills(double max_heel) const
    {
        CHECK(rest_count > 100000);
        CHECK(rest <= 1e-4);
        CHECK(from_ground <= 1e-4);
        CHECK(heel <= max_heel);
        CHECK(toe <= 1e-3);
        CHECK(under_ground <= 0.0095);
        CHECK(slide <= 1e-4);
        CHECK(shin <= 0.157);
        CHECK(foot <= 0.144);
        CHECK(pelvis <= 0.019);
    }
};

// Walkers' legs from frame to frame.
struct Gauge {
    const HillWalkers& walkers;
    Gait is;
    int first;  // the frame from which on it measures
    struct Last {
        HillWalkers::Leg leg;
        bool rests;
        double pelvis;
    };
    std::vector<Last> last;

    explicit Gauge(const HillWalkers& of, int from = 1) : walkers(of), first(from), last(2 * of.count()) {}
    void take(const Crowd& crowd, const PoseBuffer& poses, int frame)
    {
        std::vector<Float3> shifts(walkers.count());
        if (swivel_group_count(crowd.get()) > 2) crowd.read(SWIVEL_SHIFT, 2, std::span(shifts));
        for (std::uint32_t n = 0; n < walkers.count(); ++n)
            for (std::uint32_t leg = 0; leg < 2; ++leg) take(crowd, poses, frame, n, leg, double{shifts[n][0]});
    }

private:
    void take(const Crowd& crowd, const PoseBuffer& poses, int frame, std::uint32_t n, std::uint32_t leg, double shift)
    {
        const std::uint32_t flags = flags_of(crowd, leg, n);
        REQUIRE(!(flags & SWIVEL_BAD_INPUT));
        const HillWalkers::Leg at = walkers.leg(poses, n, leg, shift);
        const auto plant = value_of<std::array<float, 11>>(crowd, SWIVEL_PLANT, leg, n);
        const bool reaches = flags & SWIVEL_REACHED, rests = reaches && flags & SWIVEL_PLANTED && plant[9] == 0;
        Last& was = last[2 * n + leg];
        const double pelvis = walkers.roots[n].y() + shift;
        if (frame >= first) {
            const auto place = value_of<Float3>(crowd, SWIVEL_GROUND, leg, n),
                       normal = value_of<Float3>(crowd, SWIVEL_GROUND_NORMAL, leg, n);
            const Vector3d up = vec(normal).normalized(),
                           from = vec(place) + (walkers.has_doubles ? walkers.roots[n] : Vector3d(Vector3d::Zero()));
            const auto keep = [](double& worst, double x) { worst = x <= worst ? worst : x; };  // NaN stays
            const double toe = up.dot(at.toe - from);
            if (rests) keep(is.rest, std::fabs(toe)), keep(is.from_ground, std::fabs(walkers.terrain.over(at.toe)));
            if (!reaches) keep(is.short_toe, -toe);
            if (reaches) {
                keep(is.toe, -toe);
                if (flags & SWIVEL_PLANTED) keep(is.heel, -up.dot(at.heel - from));
                keep(is.under_ground, -walkers.terrain.over(at.toe)),
                    keep(is.under_ground, -walkers.terrain.over(at.heel));
            }
            if (rests && was.rests) keep(is.slide, (at.toe - was.leg.toe).norm());
            keep(is.shin, at.shin.angularDistance(was.leg.shin));
            keep(is.foot, at.foot.angularDistance(was.leg.foot));
            keep(is.pelvis, std::fabs(pelvis - was.pelvis));
            is.rest_count += rests && was.rests;
        }
        was = {at, rests, pelvis};
    }
};

// Solves frames by solve(crowd, poses).
template <class Solve>
Gait gait_of(HillWalkers& walkers, const Solve& solve, int first = 1)
{
    Crowd crowd = walkers.crowd();
    Gauge gauge(walkers, first);
    for (int frame = 0; frame < kWalkedFrames; ++frame) {
        walkers.go_to(frame);
        PoseBuffer poses = walkers.poses();
        solve(crowd, poses);
        gauge.take(crowd, poses, frame);
    }
    return gauge.is;
}

// The ground that a function has stored, which is in the rows as any input.
std::vector<GroundSample> ground_of(const Crowd& crowd, std::uint32_t leg)
{
    const auto places = read<Float3>(crowd, SWIVEL_GROUND, leg),
               normals = read<Float3>(crowd, SWIVEL_GROUND_NORMAL, leg);
    std::vector<GroundSample> ground;
    for (std::size_t n = 0; n < places.size(); ++n) ground.push_back({places[n], normals[n]});
    return ground;
}
// Asks for the ground, right above or below where each toe then goes. Given the same ground in its rows, another crowd
// gets the same bits.
void ask_and_give(const HillWalkers& walkers, Crowd& asking, Crowd& given, PoseBuffer& poses)
{
    PoseBuffer given_poses = poses;
    walkers.ask_and_solve(asking, poses);
    for (std::uint32_t leg = 0; leg < 2; ++leg) {
        const std::vector<GroundSample> ground = ground_of(asking, leg);
        const auto goals = read<std::array<float, 7>>(asking, SWIVEL_SOLVED_GOAL, leg);
        for (std::size_t n = 0; n < ground.size(); ++n)
            REQUIRE(std::hypot(ground[n].place[0] - goals[n][0], ground[n].place[2] - goals[n][2]) <= 1e-6f);
        HillWalkers::write(given, leg, ground);
    }
    walkers.solve(given, given_poses);
    REQUIRE(given_poses.bytes == poses.bytes);
    REQUIRE(swivel_digest(given.get()) == swivel_digest(asking.get()));
}
}  // namespace

TEST_CASE("feet stand on hills, with the same bits whether their ground is asked for or written")
{
    HillWalkers walkers(1, 500, bumpy_field());
    Crowd given = walkers.crowd(), asking = walkers.crowd();
    Gauge gauge(walkers);
    for (int frame = 0; frame < kWalkedFrames; ++frame) {
        walkers.go_to(frame);
        PoseBuffer poses = walkers.poses();
        ask_and_give(walkers, asking, given, poses);
        if (frame % 100 == 0) REQUIRE(all_words(given) == all_words(asking));
        gauge.take(asking, poses, frame);
    }
    gauge.is.check_on_hills(1e-3);
    CHECK(gauge.is.short_toe <= 1e-5);
}

TEST_CASE("on the ground below the last solve's probes feet stand nearly as well")
{
    HillWalkers walkers(1, 500, bumpy_field());
    // Who starts on ground that is not known yet stands in the air until the next step.
    constexpr int kSecond = 60;
    const auto solve_late = [&](Crowd& crowd, PoseBuffer& poses) {
        walkers.solve(crowd, poses);
        for (std::uint32_t leg = 0; leg < 2; ++leg) HillWalkers::write(crowd, leg, walkers.samples(crowd, leg));
    };
    gait_of(walkers, solve_late, kSecond).check_on_hills(0.01);
}

TEST_CASE("on flat ground feet walk as they are animated")
{
    HillWalkers walkers(2, 50, Terrain{});
    double from_animation = 0;  // of toes that swing freely
    int swing_count = 0;
    const Gait is = gait_of(walkers, [&](Crowd& crowd, PoseBuffer& poses) {
        const PoseBuffer animated = poses;
        walkers.ask_and_solve(crowd, poses);
        const auto shifts = read<Float3>(crowd, SWIVEL_SHIFT, 2);
        for (std::uint32_t n = 0; n < walkers.count(); ++n)
            for (std::uint32_t leg = 0; leg < 2; ++leg) {
                const std::uint32_t flags = flags_of(crowd, leg, n);
                const bool is_blending = value_of<std::array<float, 11>>(crowd, SWIVEL_PLANT, leg, n)[9] > 0;
                if (flags & (SWIVEL_PLANTED | SWIVEL_RELEASED) || !(flags & SWIVEL_REACHED) || is_blending) continue;
                const Vector3d toe = walkers.leg(poses, n, leg, double{shifts[n][0]}).toe,
                               was = walkers.leg(animated, n, leg, 0).toe;
                from_animation = std::max(from_animation, (toe - was).norm()), ++swing_count;
            }
    });
    CHECK(swing_count > 1000);
    CHECK(from_animation <= 1e-5);
    CHECK(is.rest <= 1e-5);
    CHECK(is.heel <= 1e-5);
    CHECK(is.slide <= 1e-5);
}

TEST_CASE("on stairs no sole goes through a tread that it is over")
{
    HillWalkers walkers(3, 200, stairs());
    const Gait is = gait_of(walkers, [&](Crowd& crowd, PoseBuffer& poses) { walkers.ask_and_solve(crowd, poses); });
    CHECK(is.heel <= 1e-3);
    CHECK(is.toe <= 1e-3);
    CHECK(is.slide <= 1e-4);
}

TEST_CASE("over creases a sole in the air turns slowly with its ground, and lies on it as it lands")
{
    const auto [has_heel, end] = GENERATE(table<bool, double>({{false, HUGE_VAL}, {true, HUGE_VAL}, {false, 3}}));
    HillWalkers walkers(8, 200, creased());
    walkers.terrain.end = end;                                    // in the middle of a slope
    if (!has_heel) std::ranges::fill(walkers.ground.heel, 0.0f);  // the ankle, which no slope reaches
    Crowd crowd = walkers.crowd();
    // How a foot is turned beside its animation in each frame of its swing, while it is 10 frames from its contact. A
    // leg that does not reach turns its foot for that. On a slope a foot that swings with its toes up turns so that its
    // heel stays over the ground, as fast as the animation brings the heel down.
    constexpr std::size_t kAhead = 10;
    struct Turned {
        Quaterniond turn;
        bool reaches;
    };
    std::vector<std::vector<Turned>> swings(2 * walkers.count());
    double turn = 0, lies = 0;
    int turn_count = 0;
    for (int frame = 0; frame < kWalkedFrames; ++frame) {
        walkers.go_to(frame);
        PoseBuffer poses = walkers.poses();
        const PoseBuffer animated = poses;
        walkers.ask_and_solve(crowd, poses);
        for (std::uint32_t n = 0; n < walkers.count(); ++n)
            for (std::uint32_t leg = 0; leg < 2; ++leg) {
                std::vector<Turned>& swing = swings[2 * n + leg];
                const std::uint32_t flags = flags_of(crowd, leg, n);
                const Quaterniond foot = walkers.leg(poses, n, leg, 0).foot,
                                  was = walkers.leg(animated, n, leg, 0).foot;
                if (!(flags & SWIVEL_PLANTED)) {
                    swing.push_back({foot * was.conjugate(), (flags & SWIVEL_REACHED) != 0});
                    continue;
                }
                for (std::size_t k = 1; k + kAhead < swing.size(); ++k)
                    if (swing[k].reaches && swing[k - 1].reaches)
                        turn = std::max(turn, swing[k].turn.angularDistance(swing[k - 1].turn)), ++turn_count;
                if (!swing.empty() && flags & SWIVEL_REACHED) {
                    const bool has_ground = std::isfinite(value_of<Float3>(crowd, SWIVEL_GROUND, leg, n)[0]);
                    const Vector3d normal =
                        has_ground ? vec(value_of<Float3>(crowd, SWIVEL_GROUND_NORMAL, leg, n)) : Vector3d::UnitY();
                    const Quaterniond slope = Quaterniond::FromTwoVectors(Vector3d::UnitY(), normal);
                    if (!has_heel) lies = std::max(lies, foot.angularDistance(slope * was));
                }
                swing.clear();
            }
    }
    CHECK(turn_count > 10000);
    CHECK(turn < (has_heel ? 7 : 4) * std::numbers::pi / 180);
    CHECK(lies < 1e-3);
}

TEST_CASE("far from the origin, places are from the root, and feet stand as well")
{
    HillWalkers walkers(5, kFewWalkers, bumpy_field());
    walkers.has_doubles = true;
    walkers.origin = {3e6 + 0.25, 0, -5e6 + 0.75};
    Crowd given = walkers.crowd();
    const Gait is = gait_of(walkers, [&](Crowd& crowd, PoseBuffer& poses) {
        ask_and_give(walkers, crowd, given, poses);
        for (std::uint32_t leg = 0; leg < 2; ++leg)
            for (const Float3& probe : read<Float3>(crowd, SWIVEL_PROBE, leg)) REQUIRE(vec(probe).norm() < 1.5);
    });
    CHECK(is.rest_count > 2000);
    CHECK(is.from_ground <= 1e-4);
}

TEST_CASE("ground that is not known, or too steep, is as if there were none")
{
    HillWalkers walkers(6, kFewWalkers, bumpy_field());
    Crowd unknown = walkers.crowd(), without = walkers.crowd(HillWalkers::kFeatures & ~SWIVEL_WITH_GROUND),
          steep = walkers.crowd();
    for (std::uint32_t leg = 0; leg < 2; ++leg) {
        steep.write_all(SWIVEL_GROUND, leg, Float3{0, 9, 0});
        steep.write_all(SWIVEL_GROUND_NORMAL, leg, Float3{1, 0.05f, 0});
    }
    for (int frame = 0; frame < 120; ++frame) {
        walkers.go_to(frame);
        PoseBuffer poses = walkers.poses(), other = poses, third = poses;
        walkers.solve(unknown, poses), walkers.solve(without, other), walkers.solve(steep, third);
        REQUIRE(poses.bytes == other.bytes);
        REQUIRE(third.bytes == other.bytes);
        for (std::uint32_t leg = 0; leg < 2; ++leg) {
            REQUIRE(read<std::uint32_t>(unknown, SWIVEL_FLAGS, leg) == read<std::uint32_t>(without, SWIVEL_FLAGS, leg));
            using Lift = std::array<float, 9>;
            REQUIRE(read<Lift>(unknown, SWIVEL_LIFT, leg) == std::vector<Lift>(kFewWalkers, {0, 0, 1, 0, 1, 0}));
        }
    }
}

TEST_CASE("a sample function is asked for each chosen foot once")
{
    constexpr std::uint32_t kMany = 700;  // on threads
    HillWalkers walkers(5, kMany, bumpy_field());
    Crowd crowd = walkers.crowd();
    PoseBuffer poses = walkers.poses();
    struct Asked {
        const HillWalkers& walkers;
        std::array<std::array<std::atomic<int>, kMany>, 2> counts = {};
    } asked{walkers};
    std::vector<std::uint32_t> mask((swivel_block_count(crowd.get()) + 1) / 2);
    const auto is_chosen = [](std::uint32_t n) { return n % 7 == 3 || n / 50 == 2; };
    for (std::uint32_t n = 0; n < kMany; ++n) mask[n / 32] |= (is_chosen(n) ? 1u : 0u) << n % 32;
    walkers.write_labels(crowd);
    const swivel_pose pose = walkers.view(poses);
    swivel_job job = swivel_default_job();
    job.pose = &pose, job.mask = mask.data(), job.mask_word_count = static_cast<std::uint32_t>(mask.size());
    job.sample_user = &asked;
    job.sample = [](const swivel_probes* probes, void* user) {
        auto& to = *static_cast<Asked*>(user);
        for (std::uint32_t n = 0; n < probes->count; ++n) ++to.counts[probes->group][probes->bodies[n]];
        HillWalkers::answer(probes, const_cast<HillWalkers*>(&to.walkers));
    };
    check(swivel_solve(crowd.get(), &job));
    for (const auto& counts : asked.counts)
        for (std::uint32_t n = 0; n < kMany; ++n) REQUIRE(counts[n] == is_chosen(n));
}

TEST_CASE("a sample function runs in its thread's floating-point environment, which changes no bit")
{
    struct Seen {
        std::vector<GroundSample> planes[2];
        bool is_other = true;
        int calls = 0;
    };
    HillWalkers walkers(5, kFewWalkers, bumpy_field());
    Crowd crowd = walkers.crowd(), usual = walkers.crowd();
    PoseBuffer poses = walkers.poses(), usual_poses = poses;
    walkers.ask_and_solve(usual, usual_poses);
    Seen seen;
    for (std::uint32_t leg = 0; leg < 2; ++leg) seen.planes[leg] = ground_of(usual, leg);
    walkers.write_labels(crowd);
    const swivel_pose pose = walkers.view(poses);
    swivel_job job = swivel_default_job();
    job.pose = &pose, job.on_this_thread = 1, job.sample_user = &seen;
    job.sample = [](const swivel_probes* probes, void* user) {
        auto& to = *static_cast<Seen*>(user);
        to.is_other = to.is_other && OtherEnvironment::is(), ++to.calls;
        for (std::uint32_t n = 0; n < probes->count; ++n)
            HillWalkers::store(*probes, n, to.planes[probes->group][probes->bodies[n]]);
        std::feraiseexcept(FE_OVERFLOW);
    };
    swivel_status status;
    bool is_other;
    int raised;
    {
        const OtherEnvironment other;
        status = swivel_solve(crowd.get(), &job);
        is_other = OtherEnvironment::is();
        raised = std::fetestexcept(FE_ALL_EXCEPT);
    }
    CHECK(status == SWIVEL_OK);
    CHECK(seen.calls == 2);
    CHECK((seen.is_other && is_other));
    CHECK((raised & (FE_OVERFLOW | FE_INVALID | FE_DIVBYZERO | FE_UNDERFLOW)) == FE_OVERFLOW);  // the function's own
    CHECK(poses.bytes == usual_poses.bytes);
    CHECK(swivel_digest(crowd.get()) == swivel_digest(usual.get()));
}

TEST_CASE("a sample function is not called where no limb of the job stands on ground")
{
    const HillWalkers walkers(5, 4, bumpy_field());
    Crowd crowd = walkers.crowd(), without = walkers.crowd(HillWalkers::kFeatures & ~SWIVEL_WITH_GROUND),
          free = crowd_of(0, 4);
    PoseBuffer poses = walkers.poses();
    const swivel_pose pose = walkers.view(poses);
    const std::uint32_t shift_alone = 4;
    int calls = 0;
    swivel_job job = swivel_default_job();
    job.sample = [](const swivel_probes*, void* user) { ++*static_cast<int*>(user); };
    job.sample_user = &calls;
    CHECK(swivel_solve(free.get(), &job) == SWIVEL_OK);
    job.pose = &pose;
    CHECK(swivel_solve(without.get(), &job) == SWIVEL_OK);
    job.groups = &shift_alone, job.group_word_count = 1;
    CHECK(swivel_solve(crowd.get(), &job) == SWIVEL_OK);
    CHECK(calls == 0);
}

TEST_CASE("a sample function is asked where the foot is about to be, also where the last solve kept the pose")
{
    PlantedBodies stage(8, Ground::still);
    Crowd crowd = stage.crowd(kPlanted | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_GROUND);
    constexpr std::uint32_t kBad = 11;
    const float wrong = 2;
    check(swivel_write(crowd.get(), SWIVEL_GROUND_WEIGHT, 0, kBad, 1, {&wrong, 0}));
    stage.solve(crowd);
    REQUIRE(flags_of(crowd, 0, kBad) == SWIVEL_BAD_INPUT);
    stage.go_to(1);
    stage.write_labels(crowd);
    std::vector<Float3> places(stage.body_count, {kNan, kNan, kNan});
    const swivel_pose pose = stage.view();
    swivel_job job = swivel_default_job();
    job.pose = &pose, job.sample_user = places.data();
    job.sample = [](const swivel_probes* probes, void* user) {
        if (probes->group > 0) return;
        for (std::uint32_t n = 0; n < probes->count; ++n)
            std::copy_n(probes->places[n], 3, static_cast<Float3*>(user)[probes->bodies[n]].begin());
    };
    check(swivel_solve(crowd.get(), &job));
    REQUIRE(flags_of(crowd, 0, kBad) == SWIVEL_BAD_INPUT);
    for (std::uint32_t body = 0; body < stage.body_count; ++body) {
        INFO("body " << body);
        CHECK(std::isfinite(places[body][0]));
        CHECK(places[body] != Float3{});  // as at the start
        if (body == kBad) CHECK(places[body] == value_of<Float3>(crowd, SWIVEL_PROBE, 0, body));
    }
}
