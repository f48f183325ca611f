// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "batch/solve/solve.h"
#include "simd/dispatch.h"
#include "simd/float_env.h"
#include "simd/rows.h"

namespace swivel {

namespace {

// Copies the first lane of each row of the first block to all lanes of this row, in all blocks of the run.
void spread(float* rows, std::uint32_t row_count, std::uint32_t block_count)
{
    for (std::uint32_t block = block_count; block-- > 0;)
        for (std::uint32_t row = 0; row < row_count; ++row)
            std::fill_n(rows + (std::size_t{block} * row_count + row) * SWIVEL_LANES, std::size_t{SWIVEL_LANES},
                        rows[std::size_t{row} * SWIVEL_LANES]);
}

// Solves the first block of a group of whole limbs.
[[gnu::noinline]] void solve_block(const Kernels& kernels, const Group& group)
{
    alignas(64) float strip[kStripBlockFloats];
    solve_group(kernels, group, {0, 1}, {strip, 1});
}

// Puts all limbs of a group of bodies into the arm frame's rest pose, without flags.
void rest_in_arm_frame(const Group& group)
{
    for (std::size_t f = kInputCount; f < kFieldCount; ++f)
        for (std::uint32_t c = 0; c < field_row_count(group.features, kFields[f].field); ++c)
            std::fill_n(group.results + (group.first_row[f] + c) * SWIVEL_LANES, std::size_t{SWIVEL_LANES},
                        kFields[f].start_of(c));
    spread(group.results, group.result_row_count, group.block_count);
}

}  // namespace

// Puts a group's free limbs into their rest pose. The kernel gives them that pose because their inputs are bad. Limbs
// that were never solved have no flag.
void rest(Group& group)
{
    const FloatEnv env;
    const bool keeps = std::exchange(group.keeps_pose, false);
    const Kernels& kernels = single_limb_kernels();
    if (group.features & kLimbFeatures)
        solve_block(kernels, group);
    else
        solve_group(kernels, group, {0, 1}, {});
    group.keeps_pose = keeps;
    group.results[std::size_t{group.first_row[index_of(SWIVEL_FLAGS)]} * SWIVEL_LANES] = 0;
    spread(group.results, group.result_row_count, group.block_count);
}

void rest(const swivel_crowd& crowd)
{
    for (std::uint32_t g = 0; g < crowd.group_count; ++g) {
        if (crowd.joint_count > 0)
            rest_in_arm_frame(crowd.groups[g]);
        else
            rest(crowd.groups[g]);
    }
}

}  // namespace swivel
