// SPDX-License-Identifier: MIT
//
// The promise: if oneTBB finds no memory or cannot start a thread, swivel_solve() says SWIVEL_OK and gives every limb
// its bits. What a solve reads and writes, such as the last normal, takes one step and not two.
//
// Each case has a process of its own, because oneTBB takes most of what it needs in the first solve.
#include <dlfcn.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "tests/allocation_count.h"
#include "tests/test_arm.h"
#include "tests/test_crowd.h"
#include "tests/test_random.h"

using namespace swivel;
using namespace swivel::test;

namespace {

// Below, this program replaces mmap, pthread_create and dlopen, and lets allocations fail (allocation_count.h), so that
// it runs out of one of these.
enum class Resource { allocation, mapping, thread, allocation_elsewhere };

Resource wanted;
std::uint32_t first, request_count;
bool is_lasting;
thread_local bool is_armed = false;   // for memory
std::atomic<bool> is_limited{false};  // for threads
std::atomic<std::uint32_t> thread_count, failure_count;
std::atomic<const volatile float*> watched{nullptr};
float watched_before;
thread_local bool is_watcher = false;
std::atomic<bool> is_hidden{false};  // oneTBB's own memory

bool fails_elsewhere(Resource resource)
{
    const volatile float* const word = watched;
    if (!word || is_watcher || resource != Resource::allocation) return false;
    for (int n = 0; n < 100000 && std::memcmp(&watched_before, const_cast<const float*>(word), sizeof(float)) == 0; ++n)
        sched_yield();
    if (!watched.exchange(nullptr)) return false;
    ++failure_count;
    errno = ENOMEM;
    return true;
}
bool fails(Resource resource)
{
    if (fails_elsewhere(resource)) return true;
    if (!is_armed || resource != wanted) return false;
    const std::uint32_t n = ++request_count;
    if (n < first || (n > first && !is_lasting)) return false;
    ++failure_count;
    errno = ENOMEM;
    return true;
}

// A thread that is counted while it runs.
struct Counted {
    void* (*run)(void*);
    void* argument;
};
void* run_counted(void* data)
{
    const Counted thread = *static_cast<Counted*>(data);
    std::free(data);
    void* const result = thread.run(thread.argument);
    --thread_count;
    return result;
}

template <class Function>
Function* next(const char* name)
{
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

// From now on this fails, until stop_failing():
// - of allocations and mappings the nth request of the calling thread, counted from 1. With later_too, all later ones
//   fail as well.
// - every start of a thread, on any thread, while nth - 1 of those that were started from now on are still there.
// - of allocations elsewhere, on another thread, the first one, which waits until this word changes.
void let_fail(Resource resource, std::uint32_t nth, bool later_too, const volatile float* word)
{
    wanted = resource;
    first = nth;
    is_lasting = later_too;
    request_count = thread_count = failure_count = 0;
    allocation_fails = [] { return fails(Resource::allocation); };
    is_limited = resource == Resource::thread;
    is_watcher = resource == Resource::allocation_elsewhere;
    is_armed = !is_limited && !is_watcher;
    if (!is_watcher) return;
    watched_before = *word;
    watched = word;
}
// From now on oneTBB does not find Debian's library that gives it memory, and takes all from malloc and its relatives.
void hide_own_memory() { is_hidden = true; }
// Returns how many requests have failed.
std::uint32_t stop_failing()
{
    watched = nullptr;
    is_armed = is_limited = false;
    return failure_count;
}

}  // namespace

// Visible, so that libraries take these, too.
#pragma GCC visibility push(default)
extern "C" {
void* mmap(void* address, std::size_t bytes, int protection, int flags, int file, off_t offset) noexcept
{
    static auto* const real = next<decltype(mmap)>("mmap");
    return fails(Resource::mapping) ? MAP_FAILED : real(address, bytes, protection, flags, file, offset);
}
int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*), void* argument) noexcept
{
    static auto* const real = next<decltype(pthread_create)>("pthread_create");
    if (!is_limited) return real(thread, attributes, run, argument);
    if (++thread_count >= first) {
        --thread_count;
        ++failure_count;
        return EAGAIN;
    }
    void* const data = std::malloc(sizeof(Counted));
    std::memcpy(data, &static_cast<const Counted&>(Counted{run, argument}), sizeof(Counted));
    return real(thread, attributes, run_counted, data);
}
void* dlopen(const char* file, int mode) noexcept
{
    static auto* const real = next<decltype(dlopen)>("dlopen");
    return is_hidden && file && std::strstr(file, "tbbmalloc") ? nullptr : real(file, mode);
}
}
#pragma GCC visibility pop

namespace {

constexpr int kThreads = 4;  // on any machine

// A crowd of which each solve changes all results, so that limbs that are solved twice show: their swivel takes steps,
// or their pose is read and written in place.
struct Stage {
    struct Pose {
        Float4 shoulder{0, 0, 0, 1}, elbow{0, 0, 0, 1};
    };
    bool is_in_place;
    Crowd crowd;
    std::vector<Pose> poses;

    Stage(bool in_place, std::uint32_t count)
        : is_in_place(in_place),
          crowd(crowd_of(in_place ? SWIVEL_JOINTS | SWIVEL_WITH_INCOMING | SWIVEL_WITH_WEIGHTS
                                  : swivel_features{SWIVEL_WITH_MAX_SWIVEL},
                         count, group_of(1).binding)),
          poses(count)
    {
        std::vector<Float3> targets(count), poles(count);
        Random random{1};
        for (Float3& target : targets) target = floats(random.vector(0, 2.2));
        const auto write_poles = [&] {
            for (Float3& pole : poles) pole = floats(random.direction());
            crowd.write(SWIVEL_POLE, 0, poles);
        };
        crowd.write(SWIVEL_TARGET, 0, targets);
        write_poles();
        if (in_place) crowd.write_all(SWIVEL_WEIGHTS, 0, Float3{0.5f, 0.5f, 0.5f});
        if (in_place) return;
        crowd.write_all(SWIVEL_MAX_SWIVEL, 0, cos_sin(0.1));
        solve(true);
        write_poles();  // now steps away
    }
    swivel_status solve(bool on_this_thread)
    {
        const swivel_stream fields[] = {{SWIVEL_INCOMING_SHOULDER, &poses[0].shoulder, sizeof(Pose)},
                                        {SWIVEL_INCOMING_ELBOW, &poses[0].elbow, sizeof(Pose)},
                                        {SWIVEL_SHOULDER, &poses[0].shoulder, sizeof(Pose)},
                                        {SWIVEL_ELBOW, &poses[0].elbow, sizeof(Pose)}};
        swivel_streams frame = swivel_default_streams();
        frame.fields = fields;
        frame.field_count = std::size(fields);
        swivel_job job = swivel_default_job();
        job.on_this_thread = on_this_thread;
        if (is_in_place) job.streams = &frame;
        return swivel_solve(crowd.get(), &job);
    }
    bool operator==(const Stage& other) const
    {
        return all_words(crowd) == all_words(other.crowd) &&
               std::memcmp(poses.data(), other.poses.data(), poses.size() * sizeof(Pose)) == 0;
    }
};

struct Case {
    bool in_place;
    Resource resource;
    std::uint32_t nth;
    bool later_too, in_arena;
};

// All threads are there, but none has memory for tasks.
void start_threads()
{
    std::atomic<int> there{0};
    oneapi::tbb::task_group group;
    for (int n = 0; n < kThreads; ++n)
        group.run([&] {
            ++there;
            for (int waited = 0; there < kThreads && waited < 10000; ++waited) ::usleep(10);
        });
    group.wait();
}

// What a case's process says. nothing_failed: there are fewer requests.
enum Outcome { held, nothing_failed, bad_status, other_bits, other_bits_later };

Outcome run(const Case& trial)
{
    const bool is_late = trial.resource == Resource::allocation_elsewhere;
    const std::uint32_t limbs = is_late ? 120000 : 6000;  // some chunks
    Stage expected(trial.in_place, limbs), tried(trial.in_place, limbs);
    expected.solve(true);
    if (is_late) hide_own_memory();
    std::uint32_t failed = 0;
    swivel_status status = SWIVEL_OK;
    const auto try_it = [&] {
        if (is_late) start_threads();
        let_fail(trial.resource, trial.nth, trial.later_too, swivel_result_rows(tried.crowd.get(), 0).base);
        status = tried.solve(false);
        failed = stop_failing();
    };
    if (trial.in_arena) {
        using Control = oneapi::tbb::global_control;
        const Control control(Control::max_allowed_parallelism, kThreads);
        oneapi::tbb::task_arena arena(kThreads);
        arena.execute(try_it);
    } else {
        try_it();  // oneTBB itself hangs when this process uses it again, so nothing here does
    }
    if (status != SWIVEL_OK) return bad_status;
    if (!(tried == expected)) return other_bits;
    for (int n = 0; n < 2 && !is_late; ++n) {
        expected.solve(true);
        if (tried.solve(false) != SWIVEL_OK || !(tried == expected)) return other_bits_later;
    }
    return failed ? held : nothing_failed;
}

// Runs a case in a process of its own. Returns its outcome, or a signal's number above 100.
int run_apart(const Case& trial)
{
    std::fflush(stdout);
    const pid_t child = ::fork();
    if (child == 0) {
        ::alarm(20);  // if it waits for ever
        std::exit(run(trial));
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFSIGNALED(status) ? 100 + WTERMSIG(status) : WEXITSTATUS(status);
}

int failures = 0;

// Whether a request failed, and the promise held.
bool holds(const Case& trial)
{
    static const char* const kResources[] = {"allocation", "mapping", "thread", "allocation elsewhere"};
    const int outcome = run_apart(trial);
    if (outcome == held || outcome == nothing_failed) return outcome == held;
    std::fprintf(stderr, "failed: %s%s, %s %u%s: outcome %d\n", trial.in_place ? "pose in place" : "steps",
                 trial.in_arena ? " in an arena" : "", kResources[static_cast<int>(trial.resource)], trial.nth,
                 trial.later_too ? " and all later ones" : "", outcome);
    ++failures;
    return false;
}

}  // namespace

int main()
{
    for (const Resource resource : {Resource::allocation, Resource::mapping, Resource::thread}) {
        std::uint32_t count = 0;
        for (const bool in_place : {false, true})
            for (const bool in_arena : {false, true})
                for (const bool later_too : {false, true}) {
                    // Where malloc gives nothing any more, oneTBB ends the process: it has no memory for the exception
                    // that it hands on. Its own memory ends with mappings, and then it does not.
                    if (later_too && resource != Resource::mapping) continue;
                    // The first request fails, then the second, and so on, until there are no more.
                    for (std::uint32_t nth = 1; nth < 1000 && holds({in_place, resource, nth, later_too, in_arena});
                         ++nth)
                        ++count;
                }
        std::printf("requests of kind %d: %u\n", static_cast<int>(resource), count);
        if (count == 0) ++failures;
    }
    // One of oneTBB's threads fails after the calling thread has solved its first limbs. These must not step again.
    int late = 0;
    for (const bool in_place : {false, true})
        for (int n = 0; n < 10; ++n) late += holds({in_place, Resource::allocation_elsewhere, 1, false, true});
    std::printf("late: %d\n", late);
    return failures != 0 || late == 0;
}
