// SPDX-License-Identifier: MIT
//
// One run of blocks: which kernel, on which rows, with which binding.
#include "batch/solve/solve.h"

#include <algorithm>
#include <iterator>

#include "batch/crowd/lane_mask.h"
#include "simd/dispatch.h"
#include "simd/float_env.h"
#include "simd/rows.h"

namespace swivel {

namespace {

// Rows of more bytes than this are not in the caches from one solve to the next. It is a common size of level 3 caches.
constexpr std::size_t kCachedBytes = std::size_t{32} << 20;

SolveRun run_of(const Group& group, GroupBlocks blocks, StripMemory strip, bool from_memory, const std::uint32_t* mask)
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
            .from_memory = from_memory,
            .keeps = group.keeps,
            .mask = mask,
            .first_lane = std::size_t{group.first_block} * SWIVEL_LANES + limb,
            .padding = group.limb_count - limb,
            .stages = &group.stages[static_cast<std::size_t>(Pass::solve)],
            .strip = strip,
            .limb = &group.limb,
            .body_block_floats = group.body_block_floats,
            .region = group.region};
}

}  // namespace

void solve_group(const Kernels& kernels, const Group& group, GroupBlocks blocks, StripMemory strip, bool from_memory,
                 const std::uint32_t* mask)
{
    const SolveRun run = run_of(group, blocks, strip, from_memory, mask);
    if (run.features & kLimbFeatures)
        kernels.limbs.solve(run);
    else
        kernels.arms.solve[run.features & kFormulaFeatures](run);
}

void prepare_group(const Kernels& kernels, const Group& group, Pass pass, GroupBlocks blocks, StripMemory strip,
                   const std::uint32_t* mask)
{
    const StageList& stages = group.stages[static_cast<std::size_t>(pass)];
    if (stages.count == 0) return;
    SolveRun run = run_of(group, blocks, strip, false, mask);
    run.stages = &stages;
    kernels.limbs.solve(run);
}

void solve_chosen_group(const Kernels& kernels, const Group& group, const std::uint32_t* mask, GroupBlocks blocks,
                        StripMemory strip, bool from_memory)
{
    if (group.features & kLimbFeatures) return solve_group(kernels, group, blocks, strip, from_memory, mask);
    const std::uint32_t end = blocks.first + blocks.count;
    // Blocks from one on that are all chosen whole, or all not.
    const auto run_from = [&](std::uint32_t block, bool whole) {
        std::uint32_t count = 0;
        for (; block < end; ++block, ++count)
            if ((chosen_limbs(group, block, mask) == lanes_of_limbs(group, block)) != whole) break;
        return count;
    };
    for (std::uint32_t block = blocks.first; block < end;) {
        const std::uint32_t whole = run_from(block, true);
        if (whole > 0) solve_group(kernels, group, {block, whole}, strip, from_memory);
        block += whole;
        const std::uint32_t part = run_from(block, false);
        if (part > 0) solve_group(kernels, group, {block, part}, strip, from_memory, mask);
        block += part;
    }
}

bool is_from_memory(const swivel_crowd& crowd, std::uint32_t block_count)
{
    return block_count * crowd.block_bytes > kCachedBytes;
}

std::uint32_t allowed_arcs(const Group& group, std::uint32_t limb, swivel_arc* arcs, std::uint32_t capacity)
{
    alignas(64) float strip[kStripBlockFloats];
    const SolveRun run = run_of(group, {0, group.block_count}, {strip, 1}, false, nullptr);
    ArcEnds ends[kMaxArcs];
    const std::uint32_t count = single_limb_kernels().limbs.allowed_arcs(run, limb, ends);
    for (std::uint32_t n = 0; n < std::min(count, capacity); ++n)
        arcs[n] = {{ends[n].from[0], ends[n].from[1]}, {ends[n].to[0], ends[n].to[1]}};
    return count;
}

void solve_here(const Work& work)
{
    if (work.pose) return solve_runs(work, 0, run_count(work));
    if (work.streams) return solve_rounds(work, 0, ~0u);
    const FloatEnv env;
    for_each_group(work.crowd, work.groups, work.blocks, [&](const Group& group, GroupBlocks part, std::uint32_t) {
        if (work.mask)
            solve_chosen_group(work.kernels, group, work.mask, part, work.strip, work.from_memory);
        else
            solve_group(work.kernels, group, part, work.strip, work.from_memory);
    });
}

}  // namespace swivel
