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

SolveRun run_of(const swivel_crowd& crowd, const Group& group, std::uint32_t first_block, std::uint32_t block_count)
{
    const std::size_t limb = std::size_t{first_block} * SWIVEL_LANES;
    return {crowd.input + row_offset(limb, crowd.input_row_count, 0),
            crowd.results + row_offset(limb, crowd.result_row_count, 0), block_count,
            crowd.features & SWIVEL_POLE_DIRECTION ? 0.0f : 1.0f, &group.binding};
}

}  // namespace

void solve_blocks(const swivel_crowd& crowd, const Kernels& kernels, std::uint32_t first_block,
                  std::uint32_t block_count)
{
    const FloatEnv env;
    const auto solve = kernels.solve[crowd.features & kFormulaFeatures];
    const std::uint32_t end_block = first_block + block_count;
    for (std::uint32_t g = 0; g < crowd.group_count; ++g) {
        const Group& group = crowd.groups[g];
        const std::uint32_t from = std::max(first_block, group.first_block);
        const std::uint32_t to = std::min(end_block, group.first_block + group.block_count);
        if (from < to) solve(run_of(crowd, group, from, to - from));
    }
}

}  // namespace swivel
