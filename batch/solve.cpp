// SPDX-License-Identifier: MIT
//
// One run of blocks: which kernel, on which rows, with which binding.
#include "batch/solve.h"

#include "simd/float_env.h"
#include "simd/rows.h"

namespace swivel {

namespace {

constexpr std::uint32_t kFormulaFeatures = SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND;

// Rows of more bytes than this come from memory at each solve: it is a common size of level 3 caches. Where they come
// from a cache, prefetching costs up to 3 %; where from memory, it takes 5 to 15 % off.
constexpr std::size_t kCachedBytes = std::size_t{32} << 20;

SolveRun run_of(const swivel_crowd& crowd, const Group& group, std::uint32_t first_block, std::uint32_t block_count)
{
    const std::size_t limb = std::size_t{first_block} * SWIVEL_LANES;
    return {crowd.input + row_offset(limb, crowd.input_row_count, 0),
            crowd.results + row_offset(limb, crowd.result_row_count, 0),
            block_count,
            crowd.features & SWIVEL_POLE_DIRECTION ? 0.0f : 1.0f,
            &group.binding,
            crowd.arena_bytes > kCachedBytes};
}

}  // namespace

void solve_group(const swivel_crowd& crowd, const Kernels& kernels, const Group& group, std::uint32_t first_block,
                 std::uint32_t block_count)
{
    kernels.solve[crowd.features & kFormulaFeatures](run_of(crowd, group, first_block, block_count));
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
