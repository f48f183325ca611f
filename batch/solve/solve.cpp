// SPDX-License-Identifier: MIT
#include "batch/solve/solve.h"

#include "simd/float_env.h"
#include "simd/rows.h"

namespace swivel {

void solve_here(const Work& work)
{
    const JobParts parts = parts_of(work);
    parts.solve(work, 0, parts.count);
}

JobParts parts_of(const Work& work)
{
    if (work.pose) return {strip_count(work), solve_strips};
    if (work.streams) return {round_count(work), solve_rounds};
    return {work.blocks.count, solve_blocks};
}

void solve_blocks(const Work& work, std::uint32_t first, std::uint32_t end)
{
    const FloatEnv env;
    const swivel_blocks blocks{work.blocks.first + first, end - first};
    for_each_group(work.crowd, work.groups, blocks, [&](const Group& group, GroupBlocks part, std::uint32_t) {
        solve_chosen_group(work.kernels, group, work.mask, part, work.strip, work.exceeds_cache);
    });
}

// Plain arms are solved in simd/kernels/arm_kernels.cpp, whole limbs in simd/kernels/limb_kernels.cpp.
void solve_group(const Kernels& kernels, const Group& group, GroupBlocks blocks, StripMemory strip, bool exceeds_cache,
                 const std::uint32_t* mask)
{
    const SolveRun run = run_of(group, blocks, strip, exceeds_cache, mask);
    if (run.features & kLimbFeatures)
        kernels.limbs.solve_limbs(run);
    else
        kernels.arms.solve_arms[run.features & kFormulaFeatures](run);
}

void solve_chosen_group(const Kernels& kernels, const Group& group, const std::uint32_t* mask, GroupBlocks blocks,
                        StripMemory strip, bool exceeds_cache)
{
    if (!mask || group.features & kLimbFeatures) return solve_group(kernels, group, blocks, strip, exceeds_cache, mask);
    const std::uint32_t end = blocks.first + blocks.count;
    // How many blocks from one on are all chosen whole, or all not.
    const auto count_from = [&](std::uint32_t block, bool whole) {
        std::uint32_t count = 0;
        for (; block < end; ++block, ++count)
            if ((chosen_limbs(group, block, mask) == lanes_of_limbs(group, block)) != whole) break;
        return count;
    };
    for (std::uint32_t block = blocks.first; block < end;) {
        const std::uint32_t whole = count_from(block, true);
        if (whole > 0) solve_group(kernels, group, {block, whole}, strip, exceeds_cache);
        block += whole;
        const std::uint32_t part = count_from(block, false);
        if (part > 0) solve_group(kernels, group, {block, part}, strip, exceeds_cache, mask);
        block += part;
    }
}

void prepare_group(const Kernels& kernels, const Group& group, Pass pass, GroupBlocks blocks, StripMemory strip,
                   const std::uint32_t* mask)
{
    const StageList& stages = group.stages[static_cast<std::size_t>(pass)];
    if (stages.count == 0) return;
    SolveRun run = run_of(group, blocks, strip, false, mask);
    run.stages = &stages;
    kernels.limbs.solve_limbs(run);
}

SolveRun run_of(const Group& group, GroupBlocks blocks, StripMemory strip, bool exceeds_cache,
                const std::uint32_t* mask)
{
    const std::size_t limb = std::size_t{blocks.first} * SWIVEL_LANES;
    return {.input = group.input + row_offset(limb, group.input_row_count, 0),
            .results = group.results + row_offset(limb, group.result_row_count, 0),
            .input_row_count = group.input_row_count,
            .result_row_count = group.result_row_count,
            .limb_count = std::size_t{blocks.count} * SWIVEL_LANES,
            .features = group.features,
            .shoulder_order = static_cast<std::uint32_t>(group.shoulder_order),
            .wrist_order = static_cast<std::uint32_t>(group.wrist_order),
            .binding = &group.binding,
            .first_row = group.first_row,
            .exceeds_cache = exceeds_cache,
            .keeps_pose = group.keeps_pose,
            .mask = mask,
            .first_lane = std::size_t{group.first_block} * SWIVEL_LANES + limb,
            .first_padding = group.limb_count - limb,
            .stages = &group.stages[static_cast<std::size_t>(Pass::solve)],
            .strip = strip,
            .plan = &group.plan,
            .body_block_floats = group.body_block_floats,
            .region = group.region};
}

bool exceeds_cache(const swivel_crowd& crowd, std::uint32_t block_count)
{
    constexpr std::size_t kCachedBytes = std::size_t{32} << 20;  // a common size of level 3 caches
    return block_count * crowd.block_bytes > kCachedBytes;
}

}  // namespace swivel
