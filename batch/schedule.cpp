// SPDX-License-Identifier: MIT
//
// Cuts a crowd's blocks into chunks and runs them on oneTBB. A chunk runs on the thread that had it before, if that
// thread is free. So its rows are in the cache of that core. This is the only file that knows oneTBB.
#include "batch/solve.h"

#include <algorithm>
#include <new>

#include "simd/float_env.h"
#include "simd/rows.h"

#ifdef SWIVEL_WITH_TBB
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>
#endif

namespace swivel {

namespace {

#ifdef SWIVEL_WITH_TBB
using Partitioner = oneapi::tbb::affinity_partitioner;
static_assert(sizeof(Partitioner) <= sizeof(swivel_crowd::schedule) && alignof(Partitioner) <= 16);
Partitioner& partitioner_of(swivel_crowd& crowd)
{
    return *std::launder(reinterpret_cast<Partitioner*>(crowd.schedule));
}
#endif

#ifdef SWIVEL_WITH_TBB
// How many blocks have something to do, or one more.
std::uint32_t busy_block_count(const Work& work, swivel_blocks blocks)
{
    if (!work.mask || blocks.count == 0) return blocks.count;
    const std::uint32_t* const first = work.mask + blocks.first / 2;
    const std::uint32_t* const end = work.mask + (blocks.first + blocks.count - 1) / 2 + 1;
    return 2 * static_cast<std::uint32_t>(std::count_if(first, end, [](std::uint32_t word) { return word > 0; }));
}
#endif

}  // namespace

void solve_in_chunks(swivel_crowd& crowd, const Kernels& kernels, const Work& work, swivel_blocks blocks)
{
#ifdef SWIVEL_WITH_TBB
    // The rows of a chunk fill a quarter of a level 2 cache of 512 KiB, which is some microseconds of work. A crowd of
    // one chunk stays on one thread. Up to 2,000 arms, two threads were no faster than one, with chunks of any size.
    constexpr std::size_t kChunkBytes = 128 * 1024;
    const auto chunk = static_cast<std::uint32_t>(kChunkBytes / block_bytes(crowd));
    if (busy_block_count(work, blocks) > chunk) {
        const FloatEnv env;  // oneTBB sets the caller's control word anew, and clears its flags
        using Range = oneapi::tbb::blocked_range<std::uint32_t>;
        // This context is isolated, because a cancelled context of the caller must not leave blocks out.
        oneapi::tbb::task_group_context context(oneapi::tbb::task_group_context::isolated);
        // Threads take rounds of frames, so that one thread has the same characters of all groups; or else blocks.
        const bool in_rounds = work.frames != nullptr;
        const std::uint32_t first = in_rounds ? 0 : blocks.first;
        const std::uint32_t count = in_rounds ? round_count(crowd, work, blocks) : blocks.count;
        const Range all(first, first + count, std::max(1u, chunk / (blocks.count / count)));
        const auto on_range = [&](const Range& range) {
            if (in_rounds)
                solve_rounds(crowd, kernels, work, blocks, range.begin(), range.end());
            else
                solve_here(crowd, kernels, work, {range.begin(), range.end() - range.begin()});
        };
        // While this thread waits for the others, it runs none of the caller's other tasks, which may be long.
        oneapi::tbb::this_task_arena::isolate(
            [&] { oneapi::tbb::parallel_for(all, on_range, partitioner_of(crowd), context); });
        return;
    }
#endif
    solve_here(crowd, kernels, work, blocks);
}

void begin_schedule([[maybe_unused]] swivel_crowd& crowd)
{
#ifdef SWIVEL_WITH_TBB
    new (crowd.schedule) Partitioner;
#endif
}
void end_schedule([[maybe_unused]] swivel_crowd& crowd)
{
#ifdef SWIVEL_WITH_TBB
    partitioner_of(crowd).~Partitioner();
#endif
}

}  // namespace swivel
