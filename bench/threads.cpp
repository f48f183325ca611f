// SPDX-License-Identifier: MIT
//
// Problem P and whole frames on 1, 2, 4... and all cores: small crowds, which must not lose by it, to large ones, and
// crowds in memory. By the clock on the wall, in an arena of oneTBB, or without oneTBB as own jobs.
#include <algorithm>
#include <thread>
#ifdef __linux__
#include <sched.h>
#endif
#ifdef SWIVEL_BENCH_TBB
#include <oneapi/tbb/task_arena.h>
#else
#include "bench/team.h"
#endif

#include "bench/rivals/whole_frame.h"
#include "bench/suite.h"

namespace bench {

namespace {

std::vector<int> thread_counts()
{
    const int cores = core_count();
    std::vector<int> counts;
    for (int threads = 1; threads < cores; threads *= 2) counts.push_back(threads);
    counts.push_back(cores);
    return counts;
}

// family/threads/what: what prepare(threads) returns.
void add_family(Suite& suite, const std::string& family, const std::string& what, std::size_t arm_count,
                const std::function<Work(int threads)>& prepare)
{
    for (const int threads : thread_counts())
        add(family + "/" + std::to_string(threads) + "/" + what, arm_count, Clock::wall, [&suite, threads, prepare] {
            swivel::check(swivel_use_isa(suite.best_isa().c_str()));
            return prepare(threads);
        });
}

void add_memory(Suite& suite, const std::string& name, swivel_features features)
{
    const std::size_t arm_count = arms_within(3, features);
    add_family(suite, "threads", name + "/memory", arm_count, [&suite, features, arm_count](int threads) {
        return solve_on(threads, suite.crowds.get(features, arm_count), {});
    });
}

}  // namespace

int core_count()
{
#ifdef __linux__
    cpu_set_t allowed;
    if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) return CPU_COUNT(&allowed);
#endif
    return static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u));
}

#ifdef SWIVEL_BENCH_TBB
Work solve_on(int threads, swivel::Crowd& crowd, const swivel::Job& job)
{
    const auto arena = std::make_shared<oneapi::tbb::task_arena>(threads);
    return [arena, &crowd, job] { arena->execute([&] { crowd.solve(job); }); };
}
#else
Work solve_on(int threads, swivel::Crowd& crowd, const swivel::Job& job)
{
    const auto team = std::make_shared<Team>(threads);
    return [team, &crowd, job] {
        team->run([&](int part) {
            swivel::Job own = job;
            const auto [first, end] = share_of(swivel_block_count(crowd.get()), part, team->size());
            own.blocks = {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end - first)};
            own.on_this_thread = true;
            crowd.solve(own);
        });
    };
}
#endif

void add_threads(Suite& suite)
{
    for (const std::size_t arm_count : {64, 1024, 16384, 262144}) {
        const std::string arms = std::to_string(arm_count);
        add_family(suite, "threads", arms, arm_count,
                   [&suite, arm_count](int threads) { return solve_on(threads, suite.crowds.get(0, arm_count), {}); });
        const auto frame = std::make_shared<WholeFrame>(arm_count / kArms);
        add_family(suite, "frame_threads", arms, arm_count, [frame](int threads) {
            return solve_on(threads, frame->framed().crowd(), {.streams = frame->framed().frames()});
        });
    }
    add_memory(suite, "P", 0);
    add_memory(suite, "resident", kResident);
}

}  // namespace bench
