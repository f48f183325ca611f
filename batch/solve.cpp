// SPDX-License-Identifier: MIT
//
// One run of blocks: which kernel, on which rows, with which binding.
#include "batch/solve.h"

#include <algorithm>

#include "batch/sized.h"
#include "simd/float_env.h"
#include "simd/rows.h"

namespace swivel {

namespace {

constexpr std::uint32_t kFormulaFeatures = SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND;

// With any of these features, a crowd's limbs are whole limbs, which have one kernel (simd/limb_run.h).
constexpr std::uint32_t kLimbFeatures = ~std::uint32_t{SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND |
                                                       SWIVEL_POLE_DIRECTION | SWIVEL_COMPACT | SWIVEL_BUDGET};

// Rows of more bytes than this come from memory at each solve, because this is a common size of level 3 caches.
// Prefetching costs up to 3 % if rows come from a cache. It saves 5 to 15 % if they come from memory.
constexpr std::size_t kCachedBytes = std::size_t{32} << 20;

// Result rows of a compact crowd are on the stack until they are packed. Those of so many blocks stay in the nearest
// cache.
constexpr std::uint32_t kPackBlocks = 8;
constexpr std::uint32_t kMostResultRows = result_row_count(SWIVEL_JOINTS | SWIVEL_WITH_HAND);

LimbRun limb_run(const swivel_crowd& crowd, const Group& group, const float* input, float* results,
                 std::uint32_t block_count)
{
    return {input,
            results,
            block_count,
            crowd.input_row_count,
            result_row_count(crowd.features & ~std::uint32_t{SWIVEL_COMPACT}),
            crowd.features,
            crowd.shoulder_order,
            crowd.wrist_order,
            &group.binding,
            crowd.first_row};
}

void solve_compact(const swivel_crowd& crowd, const Kernels& kernels, const Group& group, std::uint32_t first_block,
                   std::uint32_t block_count)
{
    alignas(64) float results[kPackBlocks * kMostResultRows * SWIVEL_LANES];
    const bool prefetch = crowd.arena_bytes > kCachedBytes;
    for (std::uint32_t done = 0; done < block_count; done += kPackBlocks) {
        const std::uint32_t block = first_block + done, count = std::min(kPackBlocks, block_count - done);
        const std::size_t limb = std::size_t{block} * SWIVEL_LANES;
        solve_rows(crowd, kernels, group, crowd.input + row_offset(limb, crowd.input_row_count, 0), results, count,
                   prefetch);
        pack_rows(crowd, kernels, results, crowd.words + row_offset(limb, crowd.result_row_count, 0), count, prefetch);
    }
}

}  // namespace

void solve_rows(const swivel_crowd& crowd, const Kernels& kernels, const Group& group, const float* input,
                float* results, std::uint32_t block_count, bool prefetch)
{
    if (crowd.features & kLimbFeatures) return kernels.limbs.solve(limb_run(crowd, group, input, results, block_count));
    const float pole_is_point = crowd.features & SWIVEL_POLE_DIRECTION ? 0.0f : 1.0f;
    kernels.arms.solve[crowd.features & kFormulaFeatures](
        {input, results, block_count, pole_is_point, &group.binding, prefetch});
}

void pack_rows(const swivel_crowd& crowd, const Kernels& kernels, const float* results, std::uint16_t* words,
               std::uint32_t block_count, bool prefetch)
{
    kernels.arms.pack[(crowd.features & (SWIVEL_JOINTS | SWIVEL_WITH_HAND)) / SWIVEL_JOINTS](
        {results, words, block_count, prefetch});
}

void solve_group(const swivel_crowd& crowd, const Kernels& kernels, const Group& group, std::uint32_t first_block,
                 std::uint32_t block_count)
{
    if (crowd.features & SWIVEL_COMPACT) return solve_compact(crowd, kernels, group, first_block, block_count);
    const std::size_t limb = std::size_t{first_block} * SWIVEL_LANES;
    solve_rows(crowd, kernels, group, crowd.input + row_offset(limb, crowd.input_row_count, 0),
               crowd.results + row_offset(limb, crowd.result_row_count, 0), block_count,
               crowd.arena_bytes > kCachedBytes);
}

std::uint32_t allowed_arcs(const swivel_crowd& crowd, const Kernels& scalar, const Group& group, std::uint32_t limb,
                           swivel_arc* arcs, std::uint32_t capacity)
{
    const FloatEnv env;
    const std::size_t first = std::size_t{group.first_block} * SWIVEL_LANES;
    // The normal of the last solve counts; compact crowds have none.
    float* const results = crowd.words ? nullptr : crowd.results + row_offset(first, crowd.result_row_count, 0);
    const float* const input = crowd.input + row_offset(first, crowd.input_row_count, 0);
    return scalar.limbs.allowed_arcs(limb_run(crowd, group, input, results, group.block_count), limb, arcs, capacity);
}

void solve_here(const swivel_crowd& crowd, const Kernels& kernels, const Work& work, swivel_blocks blocks)
{
    const FloatEnv env;
    for_each_group(crowd, blocks, [&](std::uint32_t g, std::uint32_t first, std::uint32_t count) {
        const Group& group = crowd.groups[g];
        if (work.frames)
            solve_frame_group(crowd, kernels, group, element(work.frames, g, swivel_default_frame()), work.mask, first,
                              count);
        else if (work.mask)
            solve_chosen_group(crowd, kernels, group, work.mask, first, count);
        else
            solve_group(crowd, kernels, group, first, count);
    });
}

}  // namespace swivel
