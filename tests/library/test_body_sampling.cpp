// SPDX-License-Identifier: MIT
//
// The promise: the library asks for the ground of each chosen foot once, wherever it solves. Bad input of a limb that
// is planted or stands on ground is its own, keeps what it carries, and says so. What is carried can be begun anew.
// That the ground counts as input, however a job samples it, and that nothing else changes, is test_body_ground.cpp's
// and the test `interface`'s. That what is carried can be saved and loaded is test_bits.cpp's.
#include <catch2/catch.hpp>

#include <atomic>

#include "tests/hill_walkers.h"
#include "tests/test_scopes.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr std::uint32_t kWalkers = 40;
constexpr swivel_features kWalking = HillWalkers::kFeatures,
                          kCarrying = kWalking | SWIVEL_WITH_PLANT_TURN | SWIVEL_WITH_WEIGHTS |
                                      SWIVEL_WITH_SHOULDER_CONE;  // with all inputs that faults are in

// Walkers on supports that move and turn.
struct Stage {
    HillWalkers walkers;
    Crowd crowd;
    PoseBuffer poses;

    explicit Stage(std::uint32_t count = kWalkers, swivel_on_bad_input on_bad_input = SWIVEL_KEEP_POSE,
                   float longest = 0, swivel_features more = 0)
        : walkers(walkers_of(count, longest)),
          crowd(walkers.crowd(kCarrying | more, on_bad_input)),
          poses(walkers.poses())
    {
    }
    void go_to(int frame)
    {
        walkers.go_to(frame);
        const double t = 0.01 * frame;
        walkers.supports.assign(walkers.count(), floats(Vector3d(t, 2 * std::sin(t), 1)));
        walkers.support_turns.assign(walkers.count(), floats(Quaterniond(Eigen::AngleAxisd(t, Vector3d(1, 2, 2) / 3))));
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
// The bits of all that a leg carries.
Words carried(const Crowd& crowd, std::uint32_t leg, std::uint32_t body)
{
    Words all;
    for (const swivel_field field : {SWIVEL_PLANT, SWIVEL_PLANT_TURN, SWIVEL_MOTION, SWIVEL_LIFT})
        append(all, crowd, field, leg, body);
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
    {"label 2", [](Stage& s) { s.walkers.labels[1][kBad] = 2; }},
    {"label NaN", [](Stage& s) { s.walkers.labels[1][kBad] = kNan; }},
    {"target without end",
     [](Stage& s) {
         spoil(s, SWIVEL_TARGET, Float3{kInf, 0, 0});
     }},
    {"hand of no length", [](Stage& s) { spoil(s, SWIVEL_HAND, Float4{}); }},
    {"limb weight 2",
     [](Stage& s) {
         spoil(s, SWIVEL_WEIGHTS, Float3{2, 1, 1});
     }},
    {"cone of no axis", [](Stage& s) { spoil(s, SWIVEL_SHOULDER_CONE, Float4{}); }},
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
    {"support nowhere", [](Stage& s) { s.walkers.supports[kBad][1] = kNan; }, true},
    {"support's rotation NaN", [](Stage& s) { s.walkers.support_turns[kBad][3] = kNan; }, true},
    {"support's rotation 0", [](Stage& s) { s.walkers.support_turns[kBad] = {}; }, true},
};

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

TEST_CASE("bad input of a planted foot is its own, and keeps what it carries")
{
    const swivel_on_bad_input on_bad_input = GENERATE(SWIVEL_KEEP_POSE, SWIVEL_REST_POSE);
    const swivel_features by_motion = GENERATE(swivel_features{0}, SWIVEL_PLANT_BY_MOTION);
    Stage good(kWalkers, on_bad_input, 0, by_motion);
    good.play(0, 31);
    for (const Fault& fault : kFaults) {
        if (by_motion && std::string(fault.name).starts_with("label")) continue;
        Stage stage(kWalkers, on_bad_input, 0, by_motion);
        stage.play(0, 30);
        const Words before[] = {carried(stage.crowd, 0, kBad), carried(stage.crowd, 1, kBad)};
        stage.go_to(30);
        stage.write_ground();
        fault.make(stage);
        const PoseBuffer came = stage.poses;
        stage.step();
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
                const Words anew(before[leg].size());  // as at the start
                REQUIRE(before[leg] != anew);
                REQUIRE(carried(stage.crowd, leg, n) == (on_bad_input == SWIVEL_KEEP_POSE ? before[leg] : anew));
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
