// SPDX-License-Identifier: MIT
//
// swivel_solve() on 1, 2, 4... and all cores: small crowds, which must not lose by it, to large ones. By the clock on
// the wall, in arenas of their own.
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>

#include "bench/suite.h"

namespace bench {

void add_threads(Suite& suite)
{
    const int cores = oneapi::tbb::info::default_concurrency();
    std::vector<int> thread_counts;
    for (int threads = 1; threads < cores; threads *= 2) thread_counts.push_back(threads);
    thread_counts.push_back(cores);
    for (const int threads : thread_counts) {
        const auto arena = std::make_shared<oneapi::tbb::task_arena>(threads);
        for (const std::size_t arm_count : {64, 1024, 16384, 262144}) {
            const auto prepare = [&suite, arena, arm_count]() -> Work {
                swivel::check(swivel_use_isa(suite.best_isa().c_str()));
                swivel::Crowd& crowd = suite.crowds.get(0, arm_count);
                return [&crowd, arena] { arena->execute([&crowd] { crowd.solve(); }); };
            };
            add("threads/" + std::to_string(threads) + "/" + std::to_string(arm_count), arm_count, Clock::wall,
                prepare);
        }
    }
}

}  // namespace bench
