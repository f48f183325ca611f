// SPDX-License-Identifier: MIT
//
// The promise: the library asks for the ground of each chosen foot once, wherever it solves. Bad input of one body is
// its own, keeps what it carries, and says so. What is carried can be begun anew. That the ground counts as input,
// however a job samples it, and that nothing else changes, is test_body_ground.cpp's and the test `interface`'s.
#include <catch2/catch.hpp>

#include <atomic>

#include "tests/hill_walkers.h"
#include "tests/test_scopes.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr std::uint32_t kWalkers = 40;
constexpr swivel_features kWalking = HillWalkers::kFeatures;

struct Stage {
    HillWalkers walkers;
    Crowd crowd;
    PoseBuffer poses;

    explicit Stage(std::uint32_t count = kWalkers, swivel_on_bad_input on_bad_input = SWIVEL_KEEP_POSE,
                   float longest = 0)
        : walkers(walkers_of(count, longest)), crowd(walkers.crowd(kWalking, on_bad_input)), poses(walkers.poses())
    {
    }
    void go_to(int frame)
    {
        walkers.go_to(frame);
        poses = walkers.poses();
    }
    // With the ground that is written.
    void step() { walkers.solve(crowd, poses); }
    void write_ground()
    {
        walkers.find_probes(crowd, poses);
        for (std::uint32_t leg = 0; leg < 2; ++leg) HillWalkers::write(crowd, leg, walkers.samples(crowd, leg));
    }
    void play(int first, int end)
    {
        for (int frame = first; frame < end; ++frame) {
            go_to(frame);
            write_ground();
            step();
        }
    }

private:
    static HillWalkers walkers_of(std::uint32_t count, float longest)
    {
        HillWalkers of(5, count, bumpy_field());
        of.plant.longest = longest;
        return of;
    }
};

using Words = std::vector<std::uint32_t>;
void append(Words& to, const Crowd& crowd, swivel_field field, std::uint32_t group, std::uint32_t body)
{
    const std::size_t at = to.size(), count = swivel_field_row_count(crowd.get(), group, field);
    if (count == 0) return;
    to.resize(at + count);
    check(swivel_read(crowd.get(), field, group, body, 1, {&to[at], 4 * count}));
}
// The bits of all that a leg carries; and of the body's shift.
Words carried(const Crowd& crowd, std::uint32_t leg, std::uint32_t body)
{
    Words all;
    append(all, crowd, SWIVEL_PLANT, leg, body), append(all, crowd, SWIVEL_LIFT, leg, body);
    return all;
}
Words results(const Crowd& crowd, std::uint32_t leg, std::uint32_t body)
{
    Words all;
    for (const swivel_field field : every_field())
        if (field >= SWIVEL_SHOULDER) append(all, crowd, field, leg, body);
    return all;
}
std::vector<unsigned char> leg_bytes(const PoseBuffer& poses, std::uint32_t leg, std::uint32_t body)
{
    const unsigned char* const at = &poses.bytes[body * poses.body_stride + (1 + 3 * leg) * 16];
    return {at, at + 48};
}

// One thing that is wrong with body 17, or its leg 1.
constexpr std::uint32_t kBad = 17;
struct Fault {
    const char* name;
    void (*make)(Stage& stage);
    bool is_of_body = false;
};
template <class Value>
void spoil(Stage& stage, swivel_field field, const Value& value)
{
    check(swivel_write(stage.crowd.get(), field, 1, kBad, 1, {&value, sizeof value}));
}
const Fault kFaults[] = {
    {"normal NaN",
     [](Stage& s) {
         spoil(s, SWIVEL_GROUND_NORMAL, Float3{0, kNan, 0});
     }},
    {"normal of no length", [](Stage& s) { spoil(s, SWIVEL_GROUND_NORMAL, Float3{}); }},
    {"normal too short",
     [](Stage& s) {
         spoil(s, SWIVEL_GROUND_NORMAL, Float3{0, 1e-10f, 0});
     }},
    {"normal without end",
     [](Stage& s) {
         spoil(s, SWIVEL_GROUND_NORMAL, Float3{kInf, 0, 0});
     }},
    {"weight NaN", [](Stage& s) { spoil(s, SWIVEL_GROUND_WEIGHT, kNan); }},
    {"weight 2", [](Stage& s) { spoil(s, SWIVEL_GROUND_WEIGHT, 2.0f); }},
    {"weight below 0", [](Stage& s) { spoil(s, SWIVEL_GROUND_WEIGHT, -0.1f); }},
    {"effector NaN",
     [](Stage& s) {
         spoil(s, SWIVEL_EFFECTOR, Float3{kNan, 0, 0});
     }},
    {"effector without end",
     [](Stage& s) {
         spoil(s, SWIVEL_EFFECTOR, Float3{kInf, 0, 0});
     }},
    {"label 2", [](Stage& s) { spoil(s, SWIVEL_CONTACT, 2.0f); }},
    {"cap NaN",
     [](Stage& s) {
         spoil(s, SWIVEL_CAP, Float3{kNan, 0, 0});
     }},
    {"lengths below 0",
     [](Stage& s) {
         spoil(s, SWIVEL_LENGTHS, Float2{-1, 1});
     }},
    {"time NaN", [](Stage& s) { s.walkers.times[kBad] = kNan; }, true},
    {"time below 0", [](Stage& s) { s.walkers.times[kBad] = -0.01f; }, true},
    {"time without end", [](Stage& s) { s.walkers.times[kBad] = kInf; }, true},
};
void solve_written(Stage& stage)
{
    const swivel_pose pose = stage.walkers.view(stage.poses);
    solve_poses(stage.crowd, pose);
}

}  // namespace

TEST_CASE("a sample function is asked for each chosen foot once")
{
    constexpr std::uint32_t kMany = 700;  // on threads
    Stage stage(kMany);
    struct Asked {
        const HillWalkers& walkers;
        std::array<std::array<std::atomic<int>, kMany>, 2> counts = {};
    } asked{stage.walkers};
    std::vector<std::uint32_t> mask((swivel_block_count(stage.crowd.get()) + 1) / 2);
    const auto is_chosen = [](std::uint32_t n) { return n % 7 == 3 || n / 50 == 2; };
    for (std::uint32_t n = 0; n < kMany; ++n) mask[n / 32] |= (is_chosen(n) ? 1u : 0u) << n % 32;
    stage.walkers.write_labels(stage.crowd);
    const swivel_pose pose = stage.walkers.view(stage.poses);
    swivel_job job = swivel_default_job();
    job.pose = &pose, job.mask = mask.data(), job.mask_word_count = static_cast<std::uint32_t>(mask.size());
    job.sample_user = &asked;
    job.sample = [](const swivel_probes* probes, void* user) {
        auto& to = *static_cast<Asked*>(user);
        for (std::uint32_t n = 0; n < probes->count; ++n) ++to.counts[probes->group][probes->bodies[n]];
        HillWalkers::answer(probes, const_cast<HillWalkers*>(&to.walkers));
    };
    check(swivel_solve(stage.crowd.get(), &job));
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
    Stage stage, usual;
    stage.play(0, 20), usual.play(0, 20);
    stage.go_to(20), usual.go_to(20);
    usual.write_ground();
    Seen seen;
    for (std::uint32_t leg = 0; leg < 2; ++leg) seen.planes[leg] = usual.walkers.samples(usual.crowd, leg);
    usual.step();
    stage.walkers.write_labels(stage.crowd);
    const swivel_pose pose = stage.walkers.view(stage.poses);
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
        status = swivel_solve(stage.crowd.get(), &job);
        is_other = OtherEnvironment::is();
        raised = std::fetestexcept(FE_ALL_EXCEPT);
    }
    CHECK(status == SWIVEL_OK);
    CHECK(seen.calls == 2);
    CHECK((seen.is_other && is_other));
    CHECK((raised & (FE_OVERFLOW | FE_INVALID | FE_DIVBYZERO | FE_UNDERFLOW)) == FE_OVERFLOW);  // the function's own
    CHECK(stage.poses.bytes == usual.poses.bytes);
    CHECK(swivel_digest(stage.crowd.get()) == swivel_digest(usual.crowd.get()));
}

TEST_CASE("far from the origin, places are from the root, and feet stand as well")
{
    HillWalkers walkers(5, kWalkers, bumpy_field());
    walkers.has_doubles = true;
    walkers.origin = {3e6 + 0.25, 0, -5e6 + 0.75};
    const bool asks = GENERATE(true, false);
    walkers.go_to(0);
    Crowd crowd = walkers.crowd();
    int rest_count = 0;
    for (int frame = 0; frame < 240; ++frame) {
        walkers.go_to(frame);
        PoseBuffer poses = walkers.poses();
        if (asks)
            walkers.ask_and_solve(crowd, poses);
        else
            walkers.probe_and_solve(crowd, poses);
        for (std::uint32_t leg = 0; leg < 2; ++leg)
            for (std::uint32_t n = 0; n < kWalkers; ++n) {
                const Vector3d probe = vec(value_of<Float3>(crowd, SWIVEL_PROBE, leg, n));
                REQUIRE(probe.norm() < 1.5);
                const auto plant = value_of<std::array<float, 11>>(crowd, SWIVEL_PLANT, leg, n);
                const std::uint32_t flags = flags_of(crowd, leg, n);
                REQUIRE((flags & SWIVEL_BAD_INPUT) == 0);
                if (!(flags & SWIVEL_PLANTED) || !(flags & SWIVEL_REACHED) || plant[9] != 0) continue;
                ++rest_count;
                const double shift = double{value_of<Float3>(crowd, SWIVEL_SHIFT, 2, n)[0]};
                REQUIRE(std::fabs(walkers.terrain.over(walkers.leg(poses, n, leg, shift).toe)) <= 1e-4);
            }
    }
    CHECK(rest_count > 2000);
}

TEST_CASE("ground that is not known, or too steep, is as if there were none")
{
    HillWalkers walkers(6, kWalkers, bumpy_field());
    Crowd unknown = walkers.crowd(), without = walkers.crowd(kWalking & ~SWIVEL_WITH_GROUND), steep = walkers.crowd();
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
            REQUIRE(read<Lift>(unknown, SWIVEL_LIFT, leg) == std::vector<Lift>(kWalkers, {0, 0, 1, 0, 1, 0}));
        }
    }
}

TEST_CASE("bad input of a foot on ground is its own, and keeps what it carries")
{
    const swivel_on_bad_input on_bad_input = GENERATE(SWIVEL_KEEP_POSE, SWIVEL_REST_POSE);
    for (const Fault& fault : kFaults) {
        Stage stage(kWalkers, on_bad_input), good(kWalkers, on_bad_input);
        stage.play(0, 30), good.play(0, 30);
        const Words before[] = {carried(stage.crowd, 0, kBad), carried(stage.crowd, 1, kBad)};
        stage.go_to(30), good.go_to(30);
        stage.write_ground(), good.write_ground();
        stage.walkers.write_labels(stage.crowd), good.walkers.write_labels(good.crowd);
        fault.make(stage);
        const PoseBuffer came = stage.poses;
        solve_written(stage), solve_written(good);
        for (std::uint32_t leg = 0; leg < 2; ++leg)
            for (std::uint32_t n = 0; n < kWalkers; ++n) {
                INFO(fault.name << ", leg " << leg << ", body " << n);
                const bool is_bad = n == kBad && (fault.is_of_body || leg == 1);
                REQUIRE((flags_of(stage.crowd, leg, n) == SWIVEL_BAD_INPUT) == is_bad);
                if (n != kBad) {
                    REQUIRE(leg_bytes(stage.poses, leg, n) == leg_bytes(good.poses, leg, n));
                    REQUIRE(results(stage.crowd, leg, n) == results(good.crowd, leg, n));
                }
                if (!is_bad) continue;
                if (on_bad_input == SWIVEL_KEEP_POSE)
                    REQUIRE(leg_bytes(stage.poses, leg, n) == leg_bytes(came, leg, n));
                REQUIRE(carried(stage.crowd, leg, n) ==
                        (on_bad_input == SWIVEL_KEEP_POSE ? before[leg] : Words(before[leg].size())));
            }
    }
}

TEST_CASE("time 0 changes no bit of what feet on ground carry")
{
    Stage stage;
    for (const int frame : {1, 25, 40, 55}) {
        stage.play(frame - 1, frame);
        std::vector<Words> before;
        for (std::uint32_t n = 0; n < 2 * kWalkers; ++n) before.push_back(carried(stage.crowd, n % 2, n / 2));
        // Elsewhere, on other ground.
        stage.go_to(frame + 7);
        std::ranges::fill(stage.walkers.times, 0.0f);
        stage.write_ground();
        stage.step();
        for (std::uint32_t n = 0; n < 2 * kWalkers; ++n) REQUIRE(carried(stage.crowd, n % 2, n / 2) == before[n]);
    }
}

TEST_CASE("a walker that is reset, or was not solved for longer than `longest`, is on its ground at once")
{
    Stage stage(kWalkers, SWIVEL_KEEP_POSE, 0.5f), fresh(kWalkers, SWIVEL_KEEP_POSE, 0.5f);
    stage.play(0, 30);
    const bool is_reset = GENERATE(true, false);
    stage.go_to(75), fresh.go_to(75);
    if (is_reset)
        for (std::uint32_t g = 0; g < 2; ++g) check(swivel_reset(stage.crowd.get(), g, 7, 5));
    else
        for (std::uint32_t n = 7; n < 12; ++n) stage.walkers.times[n] = 0.6f;
    stage.write_ground(), fresh.write_ground();
    // The same planes: probes of those that stand differ from those of a fresh walker only in others.
    stage.step(), fresh.step();
    int other_count = 0;
    for (std::uint32_t leg = 0; leg < 2; ++leg)
        for (std::uint32_t n = 0; n < kWalkers; ++n) {
            const bool is_anew = carried(stage.crowd, leg, n) == carried(fresh.crowd, leg, n);
            const auto lift = value_of<std::array<float, 9>>(stage.crowd, SWIVEL_LIFT, leg, n);
            if (n >= 7 && n < 12)
                REQUIRE((is_anew && lift[1] == 0 && lift[2] == 1));
            else
                other_count += !is_anew;
        }
    REQUIRE(other_count > 30);
}

TEST_CASE("constants of ground that cannot be are refused in one line")
{
    HillWalkers walkers(7, 4, bumpy_field());
    const std::array<swivel_limb_joints, 2> joints = {walkers.skeleton.joints(0), walkers.skeleton.joints(1)};
    const auto refuses = [&](const auto& spoil, const char* name) {
        std::vector<swivel_group_def> groups = {body_group(joints[0], kWalking & ~SWIVEL_WITH_FIT),
                                                body_group(joints[1], kWalking & ~SWIVEL_WITH_FIT)};
        spoil(groups[1]);
        const swivel_skeleton skeleton = walkers.skeleton.view();
        swivel_crowd_def def = swivel_default_crowd_def();
        def.groups = groups.data(), def.group_count = 2, def.skeleton = &skeleton, def.body_count = 4;
        swivel_crowd* crowd = nullptr;
        INFO(name);
        CHECK_REFUSED(swivel_crowd_create(&def, &crowd), SWIVEL_INVALID_ARGUMENT);
        CHECK(std::string(swivel_last_error()).find(name) != std::string::npos);
        CHECK(swivel_crowd_bytes(&def) == 0);
    };
    for (const float bad : {kNan, kInf, -0.01f, 2e15f}) {
        refuses([&](swivel_group_def& g) { g.ground.toe_clearance = bad; }, "group 1, ground.toe_clearance is ");
        refuses([&](swivel_group_def& g) { g.ground.heel_clearance = bad; }, "group 1, ground.heel_clearance is ");
        refuses([&](swivel_group_def& g) { g.ground.half = bad; }, "group 1, ground.half is ");
        refuses([&](swivel_group_def& g) { g.ground.cos_most = bad; }, "group 1, ground.cos_most is ");
    }
    refuses([](swivel_group_def& g) { g.ground.cos_most = 1.001f; }, "group 1, ground.cos_most is 1.001; it is 0 to 1");
    for (const float bad : {kNan, kInf, 2e15f})
        for (std::size_t c = 0; c < 3; ++c)
            refuses([&](swivel_group_def& g) { g.ground.heel[c] = bad; }, "group 1, ground.heel is ");
    refuses([](swivel_group_def& g) { g.features &= ~SWIVEL_WITH_EFFECTOR & ~SWIVEL_HAND_YIELDS; }, "WITH_EFFECTOR");
    refuses([](swivel_group_def& g) { g.features &= ~SWIVEL_WITH_PLANT; }, "WITH_PLANT");
}

TEST_CASE("jobs that sample no ground are refused in one line")
{
    Stage stage;
    const swivel_pose pose = stage.walkers.view(stage.poses);
    const std::uint32_t shift_alone = 4;
    swivel_job job = swivel_default_job();
    job.pose = &pose;
    const auto refuses = [&](Crowd& crowd, const char* part) {
        CHECK_REFUSED(swivel_solve(crowd.get(), &job), SWIVEL_INVALID_ARGUMENT);
        CHECK(std::string(swivel_last_error()).find(part) != std::string::npos);
    };
    const Words before = all_words(stage.crowd);
    job.sample = [](const swivel_probes*, void*) {};
    job.probes_only = 1;
    refuses(stage.crowd, "give one of them");
    job.groups = &shift_alone, job.group_word_count = 1, job.sample = nullptr;
    refuses(stage.crowd, "is for probes_only, but names no group that is SWIVEL_WITH_GROUND");
    CHECK(all_words(stage.crowd) == before);
    job.groups = nullptr, job.group_word_count = 0;
    Crowd without = stage.walkers.crowd(kWalking & ~SWIVEL_WITH_GROUND);
    refuses(without, "probes_only");
    Crowd free = crowd_of(0, 4);
    swivel_job plain = swivel_default_job();
    plain.probes_only = 1;
    CHECK_REFUSED(swivel_solve(free.get(), &plain), SWIVEL_INVALID_ARGUMENT);
    plain.probes_only = 0;
    plain.sample = [](const swivel_probes*, void*) { FAIL("no limb of this crowd stands on ground"); };
    CHECK(swivel_solve(free.get(), &plain) == SWIVEL_OK);
}
