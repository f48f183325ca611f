// SPDX-License-Identifier: MIT
//
// Problem P and whole frames on 1, 2, 4... and all cores: small crowds, which must not lose by it, to large ones, and
// crowds in memory. Beside them copies of the same rows and bare loops over the same structures. By the clock on the
// wall. swivel runs in an arena of oneTBB, or without oneTBB as own jobs; copies and loops divide their work evenly.
#ifdef SWIVEL_BENCH_TBB
#include <oneapi/tbb/task_arena.h>
#endif

#include "bench/rivals/probe.h"
#include "bench/rivals/whole_frame.h"
#include "bench/suite.h"
#include "bench/team.h"

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

Work copy_on(int threads, const swivel::Crowd& crowd, const Probe& probe)
{
    const auto team = std::make_shared<Team>(threads);
    const swivel_rows in = swivel_input_rows(crowd.get(), 0), out = swivel_result_rows(crowd.get(), 0);
    return [team, in, out, &probe] {
        team->run([&](int part) {
            const auto [first, end] = share_of(in.block_count, part, team->size());
            const std::size_t from = first * in.row_count * SWIVEL_LANES, to = first * out.row_count * SWIVEL_LANES;
            probe.copy_rows(in.base + from, in.row_count, out.base + to, out.row_count, end - first);
        });
    };
}

Work touch_on(int threads, WholeFrame& frame, const Level& level)
{
    const auto team = std::make_shared<Team>(threads);
    return [team, view = frame.view(), touch = level.touch_frame] {
        team->run([&](int part) {
            const auto [first, end] = share_of(view.character_count, part, team->size());
            touch({view.world + first, view.goals + first, view.local + first, view.rigs, end - first});
        });
    };
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
    const Probe& probe = probe_of(suite.best_isa().c_str());
    add_family(suite, "threads", name + "/memory", arm_count, [&suite, features, arm_count](int threads) {
        return solve_on(threads, suite.crowds.get(features, arm_count), {});
    });
    add_family(suite, "copy_threads", name + "/memory", arm_count, [&, features, arm_count](int threads) {
        return copy_on(threads, suite.crowds.get(features, arm_count), probe);
    });
}

}  // namespace

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
            return solve_on(threads, frame->framed().crowd(), {.frames = frame->framed().frames()});
        });
        const Level* const level = level_for(suite.best_isa());
        if (!level || arm_count < 16384) continue;
        add_family(suite, "bare_threads", arms, arm_count,
                   [frame, level](int threads) { return touch_on(threads, *frame, *level); });
    }
    add_memory(suite, "P", 0);
    add_memory(suite, "resident", kResident);
}

}  // namespace bench
