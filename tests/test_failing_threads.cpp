// SPDX-License-Identifier: MIT
//
// The promise: if oneTBB finds no memory or cannot start a thread, swivel_solve() says SWIVEL_OK and gives every limb
// its bits. What a solve reads and writes, such as the last normal, takes one step and not two.
//
// Each case has a process of its own, because oneTBB takes most of what it needs in the first solve.
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cstring>
#include <utility>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "tests/failing_resources.h"
#include "tests/test_arm.h"
#include "tests/test_crowd.h"
#include "tests/test_random.h"

using namespace swivel;
using namespace swivel::test;

namespace {

constexpr std::uint32_t kLimbs = 6000;  // some chunks
constexpr int kThreads = 4;             // on any machine

enum class Kind { plain, step_limited, pose_in_place };
constexpr std::pair<Kind, const char*> kKinds[] = {
    {Kind::plain, "plain"}, {Kind::step_limited, "step-limited"}, {Kind::pose_in_place, "pose in place"}};

swivel_features features_of(Kind kind)
{
    return kind == Kind::plain          ? swivel_features{0}
           : kind == Kind::step_limited ? SWIVEL_WITH_MOST_SWIVEL
                                        : SWIVEL_JOINTS | SWIVEL_WITH_INCOMING | SWIVEL_WITH_WEIGHTS;
}

// A crowd of which each solve changes all results, but for a plain one.
struct Stage {
    struct Pose {
        Float4 shoulder{0, 0, 0, 1}, elbow{0, 0, 0, 1};
    };
    Kind kind;
    Crowd crowd;
    std::vector<Pose> poses;

    explicit Stage(Kind of, std::uint32_t count = kLimbs)
        : kind(of), crowd(crowd_of(features_of(of), count, group_of(1).binding)), poses(count)
    {
        std::vector<Float3> targets(count), poles(count);
        Random random{1};
        for (std::uint32_t n = 0; n < count; ++n) {
            targets[n] = floats(random.vector(0, 2.2));
            poles[n] = floats(random.direction());
        }
        crowd.write(SWIVEL_TARGET, 0, targets);
        crowd.write(SWIVEL_POLE, 0, poles);
        if (kind == Kind::step_limited) {
            crowd.write_all(SWIVEL_MOST_SWIVEL, 0, turn(0.1));
            solve(true);
            for (Float3& pole : poles) pole = floats(random.direction());  // now steps away
            crowd.write(SWIVEL_POLE, 0, poles);
        }
        if (kind == Kind::pose_in_place) crowd.write_all(SWIVEL_WEIGHTS, 0, Float3{0.5f, 0.5f, 0.5f});
    }
    swivel_status solve(bool on_this_thread)
    {
        const swivel_frame_field fields[] = {{SWIVEL_INCOMING_SHOULDER, &poses[0].shoulder, sizeof(Pose)},
                                             {SWIVEL_INCOMING_ELBOW, &poses[0].elbow, sizeof(Pose)},
                                             {SWIVEL_SHOULDER, &poses[0].shoulder, sizeof(Pose)},
                                             {SWIVEL_ELBOW, &poses[0].elbow, sizeof(Pose)}};
        swivel_frame frame = swivel_default_frame();
        frame.fields = fields;
        frame.field_count = std::size(fields);
        swivel_job job = swivel_default_job();
        job.on_this_thread = on_this_thread;
        if (kind == Kind::pose_in_place) job.frames = &frame;
        return swivel_solve(crowd.get(), &job);
    }
    bool operator==(const Stage& other) const
    {
        return all_words(crowd) == all_words(other.crowd) &&
               std::memcmp(poses.data(), other.poses.data(), poses.size() * sizeof(Pose)) == 0;
    }
};

struct Case {
    Kind kind;
    Resource resource;
    std::uint32_t nth;
    bool later_too, in_arena;
};

// What a case's process says. nothing_failed: there are fewer requests.
enum Outcome { held, nothing_failed, bad_status, other_bits, other_bits_later };

Outcome run(const Case& of)
{
    Stage expected(of.kind), tried(of.kind);
    expected.solve(true);
    std::uint32_t failed = 0;
    swivel_status status = SWIVEL_OK;
    const auto try_it = [&] {
        let_fail(of.resource, of.nth, of.later_too);
        status = tried.solve(false);
        failed = stop_failing();
    };
    if (of.in_arena) {
        using Control = oneapi::tbb::global_control;
        const Control control(Control::max_allowed_parallelism, kThreads);
        oneapi::tbb::task_arena arena(kThreads);
        arena.execute(try_it);
    } else {
        try_it();  // oneTBB itself hangs when this process uses it again, so nothing here does
    }
    if (status != SWIVEL_OK) return bad_status;
    if (!(tried == expected)) return other_bits;
    for (int n = 0; n < 2; ++n) {
        expected.solve(true);
        if (tried.solve(false) != SWIVEL_OK || !(tried == expected)) return other_bits_later;
    }
    return failed ? held : nothing_failed;
}

// One of oneTBB's threads fails after the calling thread has solved its first limbs. These must not step again. All
// threads are there before, but none has memory for tasks.
Outcome run_late(Kind kind)
{
    Stage expected(kind, 20 * kLimbs), tried(kind, 20 * kLimbs);
    expected.solve(true);
    hide_own_memory();
    using Control = oneapi::tbb::global_control;
    const Control control(Control::max_allowed_parallelism, kThreads);
    oneapi::tbb::task_arena arena(kThreads);
    std::uint32_t failed = 0;
    swivel_status status = SWIVEL_OK;
    arena.execute([&] {
        std::atomic<int> there{0};
        oneapi::tbb::task_group group;
        for (int n = 0; n < kThreads; ++n)
            group.run([&] {
                ++there;
                for (int waited = 0; there < kThreads && waited < 10000; ++waited) ::usleep(10);
            });
        group.wait();
        let_fail_elsewhere(swivel_result_rows(tried.crowd.get(), 0).base);
        status = tried.solve(false);
        failed = stop_failing();
    });
    if (status != SWIVEL_OK) return bad_status;
    if (!(tried == expected)) return other_bits;
    return failed ? held : nothing_failed;
}

// Runs a case in a process of its own. Returns its outcome, or a signal's number above 100.
template <class Run>
int run_apart(const Run& run_it)
{
    std::fflush(stdout);
    const pid_t child = ::fork();
    if (child == 0) {
        ::alarm(20);  // if it waits for ever
        std::exit(run_it());
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFSIGNALED(status) ? 100 + WTERMSIG(status) : WEXITSTATUS(status);
}

int failures = 0;

// Fails the first request, the second, and so on, until there are no more. Returns how many there were.
std::uint32_t run_all(Case of, const std::string& name)
{
    for (of.nth = 1; of.nth < 1000; ++of.nth) {
        const int outcome = run_apart([&] { return run(of); });
        if (outcome == nothing_failed) break;
        if (outcome == held) continue;
        static const char* const kTexts[] = {"", "", "a status", "other bits", "other bits in a later solve"};
        const std::string text = outcome > 100 ? "signal " + std::to_string(outcome - 100) : kTexts[outcome];
        std::fprintf(stderr, "failed: %s, request %u%s: %s\n", name.c_str(), of.nth,
                     of.later_too ? " and all later ones" : "", text.c_str());
        ++failures;
        break;
    }
    return of.nth - 1;
}

}  // namespace

int main()
{
    std::uint32_t counts[3] = {};
    static const char* const kResources[] = {"allocations", "mappings", "threads"};
    for (const Resource resource : {Resource::allocation, Resource::mapping, Resource::thread})
        for (const auto& [kind, name] : kKinds)
            for (const bool in_arena : {false, true})
                for (const bool later_too : {false, true}) {
                    // Where malloc gives nothing any more, oneTBB ends the process: it has no memory for the exception
                    // that it hands on. Its own memory ends with mappings, and then it does not.
                    if (later_too && resource != Resource::mapping) continue;
                    const std::string what = std::string(name) + (in_arena ? ", in an arena, " : ", ") +
                                             kResources[static_cast<int>(resource)];
                    const std::uint32_t n = run_all({kind, resource, 1, later_too, in_arena}, what);
                    if (!later_too) std::printf("%s: %u\n", what.c_str(), n);
                    counts[static_cast<int>(resource)] += n;
                }
    for (const std::uint32_t count : counts)
        if (count == 0) ++failures;
    int late = 0;
    for (const Kind kind : {Kind::step_limited, Kind::pose_in_place})
        for (int n = 0; n < 10; ++n) {
            const int outcome = run_apart([&] { return run_late(kind); });
            late += outcome == held;
            if (outcome == held || outcome == nothing_failed) continue;
            std::fprintf(stderr, "failed: one of oneTBB's threads, late: %d\n", outcome);
            ++failures;
        }
    std::printf("late: %d\n", late);
    if (late == 0) ++failures;
    return failures != 0;
}
