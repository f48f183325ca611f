// SPDX-License-Identifier: MIT
//
// Cuts a crowd's blocks into chunks and runs them on oneTBB. The only file that knows oneTBB.
#include "batch/solve.h"

#include "simd/float_env.h"

#ifdef SWIVEL_WITH_TBB
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_group.h>
#endif

namespace swivel {

namespace {

// Calls work(first_block, block_count) until all blocks are done.
template <class Work>
void in_chunks(const swivel_crowd& crowd, const Work& work)
{
#ifdef SWIVEL_WITH_TBB
    // Rows of an eighth of a level 2 cache of 1 MiB: some microseconds of work, several times what handing it over
    // costs.
    constexpr std::size_t kChunkBytes = 128 * 1024;
    const std::size_t block_bytes = (crowd.input_row_count + crowd.result_row_count) * SWIVEL_LANES * sizeof(float);
    const auto chunk = static_cast<std::uint32_t>(kChunkBytes / block_bytes);
    if (crowd.block_count > chunk) {
        const FloatEnv env;  // oneTBB sets the caller's control word anew, and clears its flags
        using Range = oneapi::tbb::blocked_range<std::uint32_t>;
        // Of its own: a cancelled context of the caller's must not leave blocks out.
        oneapi::tbb::task_group_context context(oneapi::tbb::task_group_context::isolated);
        const auto on_range = [&](const Range& blocks) { work(blocks.begin(), blocks.end() - blocks.begin()); };
        oneapi::tbb::parallel_for(Range(0, crowd.block_count, chunk), on_range, oneapi::tbb::auto_partitioner{},
                                  context);
        return;
    }
#endif
    work(std::uint32_t{0}, crowd.block_count);
}

}  // namespace

void solve_all(const swivel_crowd& crowd, const Kernels& kernels)
{
    in_chunks(crowd, [&](std::uint32_t first, std::uint32_t count) { solve_blocks(crowd, kernels, first, count); });
}

void solve_frame_all(const swivel_crowd& crowd, const Kernels& kernels, const swivel_frame* frames)
{
    in_chunks(crowd, [&](std::uint32_t first, std::uint32_t count) {
        solve_frame_blocks(crowd, kernels, frames, first, count);
    });
}

}  // namespace swivel
