// SPDX-License-Identifier: MIT
//
// One run of blocks: which kernel, on which rows, with which binding.
#include "batch/solve.h"

#include <algorithm>

#include "simd/float_env.h"
#include "simd/rows.h"

namespace swivel {

namespace {

constexpr FeatureSet kFormulaFeatures = feature::world | feature::joints | feature::hand;

// With any of these features, a crowd's limbs are whole limbs, which have one kernel (simd/limb_run.h).
constexpr FeatureSet kLimbFeatures = ~(kFormulaFeatures | feature::pole_direction | feature::compact | feature::budget);

// Rows of more bytes than this are not in the caches from one solve to the next. It is a common size of level 3 caches.
constexpr std::size_t kCachedBytes = std::size_t{32} << 20;

// Result rows of a compact crowd are on the stack until they are packed. Those of so many blocks stay in the nearest
// cache.
constexpr std::uint32_t kPackBlocks = 4;
constexpr std::uint32_t kMostResultRows = result_row_count(feature::joints | feature::hand);

SolveRun run_of(const swivel_crowd& crowd, const Group& group, const float* input, float* results,
                std::uint32_t block_count, bool from_memory)
{
    return {input,
            results,
            crowd.input_row_count,
            result_row_count(crowd.features & ~feature::compact),
            std::size_t{block_count} * SWIVEL_LANES,
            crowd.features,
            static_cast<std::uint32_t>(crowd.shoulder_order),
            static_cast<std::uint32_t>(crowd.wrist_order),
            &group.frames,
            crowd.first_row,
            from_memory};
}

void solve_compact(const swivel_crowd& crowd, const Kernels& kernels, const Group& group, std::uint32_t first_block,
                   std::uint32_t block_count, bool from_memory)
{
    alignas(64) float results[kPackBlocks * kMostResultRows * SWIVEL_LANES];
    for (std::uint32_t done = 0; done < block_count; done += kPackBlocks) {
        const std::uint32_t block = first_block + done, count = std::min(kPackBlocks, block_count - done);
        const std::size_t limb = std::size_t{block} * SWIVEL_LANES;
        solve_rows(crowd, kernels, group, crowd.input + row_offset(limb, crowd.input_row_count, 0), results, count,
                   from_memory);
        pack_rows(crowd, kernels, results, crowd.words + row_offset(limb, crowd.result_row_count, 0), count);
    }
}

}  // namespace

void solve_rows(const swivel_crowd& crowd, const Kernels& kernels, const Group& group, const float* input,
                float* results, std::uint32_t block_count, bool from_memory)
{
    const SolveRun run = run_of(crowd, group, input, results, block_count, from_memory);
    if (crowd.features & kLimbFeatures)
        kernels.limbs.solve(run);
    else
        kernels.arms.solve[crowd.features & kFormulaFeatures](run);
}

void pack_rows(const swivel_crowd& crowd, const Kernels& kernels, const float* results, std::uint16_t* words,
               std::uint32_t block_count)
{
    kernels.arms.pack[(crowd.features & (feature::joints | feature::hand)) / feature::joints](
        {results, words, block_count});
}

void solve_group(const swivel_crowd& crowd, const Kernels& kernels, const Group& group, std::uint32_t first_block,
                 std::uint32_t block_count, bool from_memory)
{
    if (crowd.features & feature::compact)
        return solve_compact(crowd, kernels, group, first_block, block_count, from_memory);
    const std::size_t limb = std::size_t{first_block} * SWIVEL_LANES;
    solve_rows(crowd, kernels, group, crowd.input + row_offset(limb, crowd.input_row_count, 0),
               crowd.results + row_offset(limb, crowd.result_row_count, 0), block_count, from_memory);
}

bool is_from_memory(const swivel_crowd& crowd, std::uint32_t block_count)
{
    return block_count * block_bytes(crowd) > kCachedBytes;
}

std::uint32_t allowed_arcs(const swivel_crowd& crowd, const Kernels& scalar, const Group& group, std::uint32_t limb,
                           swivel_arc* arcs, std::uint32_t capacity)
{
    const std::size_t first = std::size_t{group.first_block} * SWIVEL_LANES;
    // The normal of the last solve counts; compact crowds have none.
    float* const results = crowd.words ? nullptr : crowd.results + row_offset(first, crowd.result_row_count, 0);
    const float* const input = crowd.input + row_offset(first, crowd.input_row_count, 0);
    ArcEnds ends[kMostArcs];
    const std::uint32_t count =
        scalar.limbs.allowed_arcs(run_of(crowd, group, input, results, group.block_count, false), limb, ends);
    for (std::uint32_t n = 0; n < std::min(count, capacity); ++n)
        arcs[n] = {{ends[n].from[0], ends[n].from[1]}, {ends[n].to[0], ends[n].to[1]}};
    return count;
}

void solve_here(const swivel_crowd& crowd, const Kernels& kernels, const Work& work, swivel_blocks blocks)
{
    if (work.frames) return solve_rounds(crowd, kernels, work, blocks, 0, ~0u);
    const FloatEnv env;
    for_each_group(crowd, blocks, [&](std::uint32_t g, std::uint32_t first, std::uint32_t count) {
        const Group& group = crowd.groups[g];
        if (work.mask)
            solve_chosen_group(crowd, kernels, group, work.mask, first, count);
        else
            solve_group(crowd, kernels, group, first, count, work.from_memory);
    });
}

}  // namespace swivel
