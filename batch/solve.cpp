// SPDX-License-Identifier: MIT
//
// One run of blocks: which kernel, on which rows, with which binding.
#include "batch/solve.h"

#include <algorithm>

#include "simd/float_env.h"
#include "simd/rows.h"

namespace swivel {

namespace {

constexpr std::uint32_t kFormulaFeatures = SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND;

// With any of these a crowd's limbs are whole ones, for which there is one kernel (simd/limb_step.h).
constexpr std::uint32_t kLimbFeatures =
    ~std::uint32_t{SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND | SWIVEL_POLE_DIRECTION | SWIVEL_COMPACT};

// Rows of more bytes than this come from memory at each solve: it is a common size of level 3 caches. Where they come
// from a cache, prefetching costs up to 3 %; where from memory, it takes 5 to 15 % off.
constexpr std::size_t kCachedBytes = std::size_t{32} << 20;

// Result rows of a compact crowd live on the stack until they are packed: so many blocks' stay in the nearest cache.
constexpr std::uint32_t kPackBlocks = 8;
constexpr std::uint32_t kMostResultRows = result_row_count(SWIVEL_JOINTS | SWIVEL_WITH_HAND);

SolveRun run_of(const swivel_crowd& crowd, const Group& group, float* results, std::uint32_t first_block,
                std::uint32_t block_count)
{
    return {crowd.input + row_offset(std::size_t{first_block} * SWIVEL_LANES, crowd.input_row_count, 0),
            results,
            block_count,
            crowd.features & SWIVEL_POLE_DIRECTION ? 0.0f : 1.0f,
            &group.binding,
            crowd.arena_bytes > kCachedBytes};
}

LimbRun limb_run_of(const swivel_crowd& crowd, const SolveRun& run)
{
    return {run.input,
            run.results,
            run.block_count,
            crowd.input_row_count,
            crowd.words ? result_row_count(crowd.features & ~std::uint32_t{SWIVEL_COMPACT}) : crowd.result_row_count,
            crowd.features,
            crowd.shoulder_order,
            crowd.wrist_order,
            run.binding,
            crowd.first_row};
}

// Solves a run of blocks with the kernel that the crowd's features ask for.
void solve_run(const swivel_crowd& crowd, const Kernels& kernels, const SolveRun& run)
{
    if (crowd.features & kLimbFeatures)
        kernels.solve_limbs(limb_run_of(crowd, run));
    else
        kernels.solve[crowd.features & kFormulaFeatures](run);
}

void solve_compact(const swivel_crowd& crowd, const Kernels& kernels, const Group& group, std::uint32_t first_block,
                   std::uint32_t block_count)
{
    alignas(64) float results[kPackBlocks * kMostResultRows * SWIVEL_LANES];
    const auto pack = kernels.pack[(crowd.features & (SWIVEL_JOINTS | SWIVEL_WITH_HAND)) / SWIVEL_JOINTS];
    for (std::uint32_t done = 0; done < block_count; done += kPackBlocks) {
        const std::uint32_t block = first_block + done, count = std::min(kPackBlocks, block_count - done);
        const SolveRun run = run_of(crowd, group, results, block, count);
        solve_run(crowd, kernels, run);
        pack({results, crowd.words + row_offset(std::size_t{block} * SWIVEL_LANES, crowd.result_row_count, 0), count,
              run.prefetch});
    }
}

}  // namespace

void solve_group(const swivel_crowd& crowd, const Kernels& kernels, const Group& group, std::uint32_t first_block,
                 std::uint32_t block_count)
{
    if (crowd.features & SWIVEL_COMPACT) return solve_compact(crowd, kernels, group, first_block, block_count);
    float* const results =
        crowd.results + row_offset(std::size_t{first_block} * SWIVEL_LANES, crowd.result_row_count, 0);
    solve_run(crowd, kernels, run_of(crowd, group, results, first_block, block_count));
}

std::uint32_t allowed_arcs(const swivel_crowd& crowd, const Kernels& scalar, const Group& group, std::uint32_t limb,
                           swivel_arc* arcs, std::uint32_t capacity)
{
    const FloatEnv env;
    float* const results = crowd.words ? nullptr
                                       : crowd.results + row_offset(std::size_t{group.first_block} * SWIVEL_LANES,
                                                                    crowd.result_row_count, 0);
    const SolveRun run = run_of(crowd, group, results, group.first_block, group.block_count);
    return scalar.allowed_arcs(limb_run_of(crowd, run), limb, arcs, capacity);
}

void solve_blocks(const swivel_crowd& crowd, const Kernels& kernels, std::uint32_t first_block,
                  std::uint32_t block_count)
{
    const FloatEnv env;
    for_each_group(crowd, first_block, block_count, [&](std::uint32_t g, std::uint32_t first, std::uint32_t count) {
        solve_group(crowd, kernels, crowd.groups[g], first, count);
    });
}

}  // namespace swivel
