// SPDX-License-Identifier: MIT
//
// Problem P and whole frames on 1, 2, 4... and all cores: small crowds, which must not lose by it, to large ones. By
// the clock on the wall, in arenas of their own.
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>

#include "bench/rivals/whole_frame.h"
#include "bench/suite.h"

namespace bench {

namespace {

std::vector<int> thread_counts()
{
    const int cores = oneapi::tbb::info::default_concurrency();
    std::vector<int> counts;
    for (int threads = 1; threads < cores; threads *= 2) counts.push_back(threads);
    counts.push_back(cores);
    return counts;
}

// family/threads/arm_count: what prepare() returns, called in an arena of that many.
void add_family(Suite& suite, const std::string& family, std::size_t arm_count, const std::function<Work()>& prepare)
{
    for (const int threads : thread_counts()) {
        const auto arena = std::make_shared<oneapi::tbb::task_arena>(threads);
        const std::string name = family + "/" + std::to_string(threads) + "/" + std::to_string(arm_count);
        add(name, arm_count, Clock::wall, [&suite, arena, prepare]() -> Work {
            swivel::check(swivel_use_isa(suite.best_isa().c_str()));
            return [arena, work = prepare()] { arena->execute(work); };
        });
    }
}

}  // namespace

void add_threads(Suite& suite)
{
    for (const std::size_t arm_count : {64, 1024, 16384, 262144}) {
        add_family(suite, "threads", arm_count, [&suite, arm_count]() -> Work {
            swivel::Crowd& crowd = suite.crowds.get(0, arm_count);
            return [&crowd] { crowd.solve(); };
        });
        const auto frame = std::make_shared<WholeFrame>(arm_count / kArms);
        add_family(suite, "frame_threads", arm_count,
                   [frame]() -> Work { return [frame] { frame->solve_on_threads(); }; });
    }
}

}  // namespace bench
