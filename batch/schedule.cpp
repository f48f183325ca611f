// SPDX-License-Identifier: MIT
//
// Cuts a crowd's blocks into chunks and runs them on oneTBB, each on the thread that had it before where that is free,
// so that its rows are in that core's cache. The only file that knows oneTBB.
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

// Calls work(first_block, block_count) until all blocks are done, of which busy_block_count have something to do.
template <class Work>
void in_chunks([[maybe_unused]] swivel_crowd& crowd, [[maybe_unused]] std::uint32_t busy_block_count, const Work& work)
{
#ifdef SWIVEL_WITH_TBB
    // Rows of a quarter of a level 2 cache of 512 KiB: some microseconds of work. Crowds of one chunk would only lose
    // by being shared: up to 2,000 arms two threads were no faster than one, with chunks of any size.
    constexpr std::size_t kChunkBytes = 128 * 1024;
    const auto chunk = static_cast<std::uint32_t>(kChunkBytes / block_bytes(crowd.features));
    if (busy_block_count > chunk) {
        const FloatEnv env;  // oneTBB sets the caller's control word anew, and clears its flags
        using Range = oneapi::tbb::blocked_range<std::uint32_t>;
        // Of its own: a cancelled context of the caller's must not leave blocks out.
        oneapi::tbb::task_group_context context(oneapi::tbb::task_group_context::isolated);
        const auto on_range = [&](const Range& blocks) { work(blocks.begin(), blocks.end() - blocks.begin()); };
        // While this thread waits for the others it takes up none of the caller's other tasks, which may be long.
        oneapi::tbb::this_task_arena::isolate([&] {
            oneapi::tbb::parallel_for(Range(0, crowd.block_count, chunk), on_range, partitioner_of(crowd), context);
        });
        return;
    }
#endif
    work(std::uint32_t{0}, crowd.block_count);
}

}  // namespace

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

void solve_all(swivel_crowd& crowd, const Kernels& kernels)
{
    in_chunks(crowd, crowd.block_count,
              [&](std::uint32_t first, std::uint32_t count) { solve_blocks(crowd, kernels, first, count); });
}

void solve_chosen_all(swivel_crowd& crowd, const Kernels& kernels, const std::uint32_t* words)
{
    const auto is_busy = [](std::uint32_t word) { return word > 0; };
    const auto busy = std::count_if(words, words + mask_word_count(crowd.block_count), is_busy);
    in_chunks(crowd, 2 * static_cast<std::uint32_t>(busy), [&](std::uint32_t first, std::uint32_t count) {
        solve_chosen_blocks(crowd, kernels, words, first, count);
    });
}

void solve_frame_all(swivel_crowd& crowd, const Kernels& kernels, const swivel_frame* frames)
{
    in_chunks(crowd, crowd.block_count, [&](std::uint32_t first, std::uint32_t count) {
        solve_frame_blocks(crowd, kernels, frames, first, count);
    });
}

}  // namespace swivel
