// SPDX-License-Identifier: MIT
//
// The promise: the library says where it wants to know the ground, and asks for each chosen foot once, wherever it
// solves. What it is told counts as input. Bad input of one body is its own, keeps what it carries, and says so. What
// is carried can be saved, played again and begun anew.
#include <catch2/catch.hpp>

#include <cfenv>
#include <mutex>

#include "tests/hill_walkers.h"
#include "tests/test_isa_scope.h"

#ifdef __x86_64__
#include <xmmintrin.h>
#endif

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr std::uint32_t kWalkers = 40;
constexpr swivel_features kWalking = HillWalkers::kFeatures;

// Planes that a sample function gives, and what it was asked.
struct Asked {
    const HillWalkers& walkers;
    std::mutex lock = {};
    std::vector<std::vector<int>> count = std::vector<std::vector<int>>(2, std::vector<int>(walkers.count()));
    std::uint32_t most = 0;
    std::vector<std::vector<Float3>> places = std::vector<std::vector<Float3>>(2, std::vector<Float3>(walkers.count()));
    std::vector<std::vector<GroundSample>> had =
        std::vector<std::vector<GroundSample>>(2, std::vector<GroundSample>(walkers.count()));

    static void answer(const swivel_probes* probes, void* user)
    {
        auto& asked = *static_cast<Asked*>(user);
        const std::scoped_lock one(asked.lock);
        asked.most = std::max(asked.most, probes->count);
        for (std::uint32_t n = 0; n < probes->count; ++n) {
            const std::uint32_t body = probes->bodies[n];
            ++asked.count[probes->group][body];
            asked.places[probes->group][body] = {probes->places[n][0], probes->places[n][1], probes->places[n][2]};
            GroundSample& had = asked.had[probes->group][body];
            std::copy_n(probes->grounds[n], 3, had.place.begin()),
                std::copy_n(probes->normals[n], 3, had.normal.begin());
        }
        HillWalkers::answer(probes, const_cast<HillWalkers*>(&asked.walkers));
    }
};

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

// The caller's environment: another rounding, and where there is such a thing denormals that are flushed.
struct OtherEnvironment {
    OtherEnvironment()
    {
        std::feclearexcept(FE_ALL_EXCEPT);
        std::fesetround(FE_UPWARD);
        flush(true);
    }
    ~OtherEnvironment()
    {
        flush(false);
        std::fesetround(FE_TONEAREST);
        std::feclearexcept(FE_ALL_EXCEPT);
    }
    static bool is()
    {
#ifdef __x86_64__
        if ((_mm_getcsr() & kFlushes) != kFlushes) return false;
#endif
        return std::fegetround() == FE_UPWARD;
    }

private:
#ifdef __x86_64__
    static constexpr unsigned kFlushes = 0x8040;
    static void flush(bool does) { _mm_setcsr(does ? _mm_getcsr() | kFlushes : _mm_getcsr() & ~kFlushes); }
#else
    static void flush(bool) {}
#endif
};

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

TEST_CASE("probes_only finds the probes, changes nothing else, and may be repeated")
{
    Stage stage, plain;
    for (int frame = 0; frame < 90; ++frame) {
        stage.go_to(frame), plain.go_to(frame);
        stage.walkers.write_labels(stage.crowd);
        const PoseBuffer came = stage.poses;
        const Words before = all_words(stage.crowd);
        stage.walkers.find_probes(stage.crowd, stage.poses);
        const Words once = all_words(stage.crowd);
        stage.walkers.find_probes(stage.crowd, stage.poses);
        REQUIRE(all_words(stage.crowd) == once);
        REQUIRE(stage.poses.bytes == came.bytes);
        const std::vector<Float3> probes[] = {read<Float3>(stage.crowd, SWIVEL_PROBE, 0),
                                              read<Float3>(stage.crowd, SWIVEL_PROBE, 1)};
        // Other rows have the bits that they had.
        int changed = 0;
        for (std::uint32_t leg = 0; leg < 2; ++leg) {
            const swivel_rows rows = swivel_result_rows(stage.crowd.get(), leg);
            const std::uint32_t probe = swivel_field_first_row(stage.crowd.get(), leg, SWIVEL_PROBE);
            std::size_t at = 0;
            for_all_rows(stage.crowd, [&](const swivel_rows& each) {
                for (std::size_t n = 0; n < float_count(each); ++n, ++at) {
                    if (each.base != rows.base) continue;
                    const auto row = static_cast<std::uint32_t>(n / SWIVEL_LANES % each.row_count);
                    if (row >= probe && row < probe + 3)
                        changed += once[at] != before[at];
                    else
                        REQUIRE(once[at] == before[at]);
                }
            });
        }
        REQUIRE(changed > 0);
        // The solve that follows sends each foot there, but for its height, and has the bits of one without probes.
        for (std::uint32_t leg = 0; leg < 2; ++leg) {
            HillWalkers::write(stage.crowd, leg, stage.walkers.samples(stage.crowd, leg));
            HillWalkers::write(plain.crowd, leg, stage.walkers.samples(stage.crowd, leg));
        }
        stage.step(), plain.step();
        REQUIRE(stage.poses.bytes == plain.poses.bytes);
        REQUIRE(swivel_digest(stage.crowd.get()) == swivel_digest(plain.crowd.get()));
        for (std::uint32_t leg = 0; leg < 2; ++leg)
            for (std::uint32_t n = 0; n < kWalkers; ++n) {
                const auto goal = value_of<std::array<float, 7>>(stage.crowd, SWIVEL_GOAL, leg, n);
                const Vector3d off = vec(probes[leg][n]) - Vector3d(goal[0], goal[1], goal[2]);
                REQUIRE(std::hypot(off.x(), off.z()) <= 1e-5);
            }
    }
}

TEST_CASE("a frame with probes gets them from a job for probes only, and no other result")
{
    Stage stage;
    stage.play(0, 30);
    stage.go_to(30);
    stage.walkers.write_labels(stage.crowd);
    std::vector<Float3> probes(kWalkers, Float3{7, 7, 7});
    std::vector<std::uint32_t> flags(kWalkers, 77);
    const swivel_frame_field fields[] = {{SWIVEL_FLAGS, flags.data(), 4},
                                         {SWIVEL_PROBE, probes.data(), sizeof(Float3)}};
    std::vector<swivel_frame> frames(3, swivel_default_frame());
    frames[1].fields = fields, frames[1].field_count = 2;
    const swivel_pose pose = stage.walkers.view(stage.poses);
    swivel_job job = swivel_default_job();
    job.pose = &pose, job.frames = frames.data(), job.probes_only = 1;
    check(swivel_solve(stage.crowd.get(), &job));
    CHECK(probes == read<Float3>(stage.crowd, SWIVEL_PROBE, 1));
    CHECK(flags == std::vector<std::uint32_t>(kWalkers, 77));
}

TEST_CASE("a sample function is asked for each chosen foot once, with the values that it has")
{
    Stage stage(700), probed(700);
    stage.play(0, 20), probed.play(0, 20);
    stage.go_to(20), probed.go_to(20);
    const auto had = [&](std::uint32_t leg, std::uint32_t n) {
        return GroundSample{value_of<Float3>(probed.crowd, SWIVEL_GROUND, leg, n),
                            value_of<Float3>(probed.crowd, SWIVEL_GROUND_NORMAL, leg, n)};
    };
    std::vector<std::uint32_t> chosen;
    const bool is_some = GENERATE(true, false), here = GENERATE(true, false);
    for (std::uint32_t n = 0; n < 700; ++n)
        if (!is_some || n % 7 == 3 || n / 50 == 2) chosen.push_back(n);
    Words mask((swivel_block_count(stage.crowd.get()) + 1) / 2);
    for (const std::uint32_t n : chosen) mask[n / 32] |= 1u << n % 32;
    Asked asked{stage.walkers};
    stage.walkers.write_labels(stage.crowd);
    const swivel_pose pose = stage.walkers.view(stage.poses);
    const Words before = all_words(stage.crowd);
    swivel_job job = swivel_default_job();
    job.pose = &pose, job.sample = Asked::answer, job.sample_user = &asked, job.on_this_thread = here;
    if (is_some) job.mask = mask.data(), job.mask_word_count = static_cast<std::uint32_t>(mask.size());
    check(swivel_solve(stage.crowd.get(), &job));
    CHECK(asked.most > (is_some ? 8u : 16u));
    CHECK(asked.most <= 128);
    probed.walkers.find_probes(probed.crowd, probed.poses);
    for (std::uint32_t leg = 0; leg < 2; ++leg) {
        std::size_t next = 0;
        for (std::uint32_t n = 0; n < 700; ++n) {
            const bool is_chosen = next < chosen.size() && chosen[next] == n;
            next += is_chosen;
            REQUIRE(asked.count[leg][n] == is_chosen);
            if (!is_chosen) continue;
            REQUIRE(asked.places[leg][n] == value_of<Float3>(probed.crowd, SWIVEL_PROBE, leg, n));
            REQUIRE(asked.had[leg][n] == had(leg, n));
            // What it stores are inputs in rows.
            const GroundSample want = stage.walkers.sample(n, asked.places[leg][n]);
            REQUIRE(value_of<Float3>(stage.crowd, SWIVEL_GROUND, leg, n) == want.place);
            REQUIRE(value_of<Float3>(stage.crowd, SWIVEL_GROUND_NORMAL, leg, n) == want.normal);
        }
    }
    // With the same planes, the same bits; others have what they had.
    for (std::uint32_t leg = 0; leg < 2; ++leg)
        HillWalkers::write(probed.crowd, leg, probed.walkers.samples(probed.crowd, leg));
    const PoseBuffer came = probed.poses;
    probed.step();
    std::size_t next = 0;
    for (std::uint32_t n = 0; n < 700; ++n) {
        const bool is_chosen = next < chosen.size() && chosen[next] == n;
        next += is_chosen;
        for (std::uint32_t leg = 0; leg < 2; ++leg) {
            REQUIRE(leg_bytes(stage.poses, leg, n) == leg_bytes(is_chosen ? probed.poses : came, leg, n));
            if (is_chosen) REQUIRE(results(stage.crowd, leg, n) == results(probed.crowd, leg, n));
        }
    }
}

TEST_CASE("a sample function that stores nothing leaves what was written")
{
    Stage stage, plain;
    stage.play(0, 20), plain.play(0, 20);
    stage.go_to(20), plain.go_to(20);
    stage.walkers.ask_and_solve(stage.crowd, stage.poses, [](const swivel_probes*, void*) {});
    plain.step();
    CHECK(stage.poses.bytes == plain.poses.bytes);
    CHECK(swivel_digest(stage.crowd.get()) == swivel_digest(plain.crowd.get()));
}

TEST_CASE("ground that a sample function gives replaces ground that was bad")
{
    Stage stage, good;
    stage.play(0, 20), good.play(0, 20);
    stage.go_to(20), good.go_to(20);
    spoil(stage, SWIVEL_GROUND_NORMAL, Float3{kNan, kNan, kNan});
    spoil(stage, SWIVEL_GROUND, Float3{kInf, 0, 0});
    stage.walkers.ask_and_solve(stage.crowd, stage.poses);
    good.walkers.ask_and_solve(good.crowd, good.poses);
    for (std::uint32_t leg = 0; leg < 2; ++leg)
        for (std::uint32_t n = 0; n < kWalkers; ++n) {
            INFO("leg " << leg << ", body " << n);
            REQUIRE((flags_of(stage.crowd, leg, n) & SWIVEL_BAD_INPUT) == 0);
            // The height at which it was asked is not that of the ground before.
            if (n == kBad && leg == 1) continue;
            if (n != kBad) REQUIRE(results(stage.crowd, leg, n) == results(good.crowd, leg, n));
        }
    const Vector3d a = vec(value_of<Float3>(stage.crowd, SWIVEL_PROBE, 1, kBad)),
                   b = vec(value_of<Float3>(good.crowd, SWIVEL_PROBE, 1, kBad));
    CHECK((a - b).norm() <= 1e-6);
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

TEST_CASE("what feet on ground carry can be saved and played again, and begun anew")
{
    Stage stage, other;
    stage.play(0, 45);
    for (std::uint32_t g = 0; g < 3; ++g)
        for (const swivel_field field : {SWIVEL_PLANT, SWIVEL_LIFT, SWIVEL_SHIFT}) {
            const std::size_t count = swivel_field_row_count(stage.crowd.get(), g, field);
            if (count == 0) continue;
            std::vector<float> values(kWalkers * count);
            check(swivel_read(stage.crowd.get(), field, g, 0, kWalkers, {values.data(), 4 * count}));
            check(swivel_write(other.crowd.get(), field, g, 0, kWalkers, {values.data(), 4 * count}));
        }
    stage.play(45, 80), other.play(45, 80);
    REQUIRE(stage.poses.bytes == other.poses.bytes);
    REQUIRE(swivel_digest(stage.crowd.get()) == swivel_digest(other.crowd.get()));
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

TEST_CASE("every instruction set and every thread count walks the same")
{
    const IsaScope scope;
    std::uint64_t digest = 0;
    for (std::uint32_t n = 0; const char* const isa = swivel_isa_at(n); ++n) {
        if (!swivel_isa_runs(isa)) continue;
        check(swivel_use_isa(isa));
        Stage stage(300);
        stage.play(0, 40);
        INFO(isa);
        if (digest == 0) digest = swivel_digest(stage.crowd.get());
        REQUIRE(swivel_digest(stage.crowd.get()) == digest);
    }
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
