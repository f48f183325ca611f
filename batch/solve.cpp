// SPDX-License-Identifier: MIT
//
// One run of blocks: which kernel, on which rows, with which binding.
#include "batch/solve.h"

#include <algorithm>
#include <bit>
#include <iterator>

#include "batch/lane_mask.h"
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
constexpr std::uint32_t kMostResultRows = result_row_count(feature::joints | feature::hand),
                        kMostWordRows = result_row_count(feature::joints | feature::hand | feature::compact);

SolveRun run_of(const swivel_crowd& crowd, const Group& group, std::uint32_t first_block, std::uint32_t block_count,
                bool from_memory, const std::uint32_t* mask)
{
    const std::size_t limb = std::size_t{first_block} * SWIVEL_LANES;
    return {crowd.input + row_offset(limb, crowd.input_row_count, 0),
            crowd.words ? nullptr : crowd.results + row_offset(limb, crowd.result_row_count, 0),
            crowd.input_row_count,
            result_row_count(crowd.features & ~feature::compact),
            std::size_t{block_count} * SWIVEL_LANES,
            crowd.features,
            static_cast<std::uint32_t>(crowd.shoulder_order),
            static_cast<std::uint32_t>(crowd.wrist_order),
            &group.frames,
            crowd.first_row,
            from_memory,
            mask,
            limb,
            group.limb_count - (limb - std::size_t{group.first_block} * SWIVEL_LANES)};
}

void solve_run(const Kernels& kernels, const SolveRun& run)
{
    if (run.features & kLimbFeatures)
        kernels.limbs.solve(run);
    else
        kernels.arms.solve[run.features & kFormulaFeatures](run);
}

// Packs a block's results into words and copies those of some lanes to where they belong.
void pack_lanes(const swivel_crowd& crowd, void (*pack)(const PackRun&), const float* results, LaneMask lanes,
                std::uint16_t* to)
{
    std::uint16_t words[kMostWordRows * SWIVEL_LANES];
    pack({results, words, 1});
    for (; lanes != 0; lanes &= lanes - 1) {
        const int lane = std::countr_zero(lanes);
        copy_lane(crowd.result_row_count, words + lane, to + lane);
    }
}

void solve_compact(const swivel_crowd& crowd, const Kernels& kernels, const Group& group, std::uint32_t first_block,
                   std::uint32_t block_count, bool from_memory, const std::uint32_t* mask)
{
    alignas(64) float results[kPackBlocks * kMostResultRows * SWIVEL_LANES];
    if (mask) std::fill_n(results, std::size(results), 0.0f);  // lanes that are not chosen are packed, too
    void (*const pack)(const PackRun&) =
        kernels.arms.pack[(crowd.features & (feature::joints | feature::hand)) / feature::joints];
    for (std::uint32_t done = 0; done < block_count; done += kPackBlocks) {
        const std::uint32_t block = first_block + done, count = std::min(kPackBlocks, block_count - done);
        SolveRun run = run_of(crowd, group, block, count, from_memory, mask);
        run.results = results;
        solve_run(kernels, run);
        const auto words = [&](std::uint32_t of) {
            return crowd.words + row_offset(std::size_t{of} * SWIVEL_LANES, crowd.result_row_count, 0);
        };
        if (!mask) {
            pack({results, words(block), count});
            continue;
        }
        for (std::uint32_t n = 0; n < count; ++n)
            if (const LaneMask lanes = lanes_of(mask, block + n) & lanes_of_limbs(group, block + n))
                pack_lanes(crowd, pack, results + row_offset(std::size_t{n} * SWIVEL_LANES, run.result_row_count, 0),
                           lanes, words(block + n));
    }
}

}  // namespace

void solve_group(const swivel_crowd& crowd, const Kernels& kernels, const Group& group, std::uint32_t first_block,
                 std::uint32_t block_count, bool from_memory, const std::uint32_t* mask)
{
    if (crowd.words) return solve_compact(crowd, kernels, group, first_block, block_count, from_memory, mask);
    solve_run(kernels, run_of(crowd, group, first_block, block_count, from_memory, mask));
}

void solve_chosen_group(const swivel_crowd& crowd, const Kernels& kernels, const Group& group,
                        const std::uint32_t* mask, std::uint32_t first_block, std::uint32_t block_count,
                        bool from_memory)
{
    const std::uint32_t end = first_block + block_count;
    // Blocks from one on that are all chosen whole, or all not.
    const auto run_from = [&](std::uint32_t block, bool whole) {
        std::uint32_t count = 0;
        for (; block < end; ++block, ++count) {
            const LaneMask all = lanes_of_limbs(group, block);
            if (((lanes_of(mask, block) & all) == all) != whole) break;
        }
        return count;
    };
    for (std::uint32_t block = first_block; block < end;) {
        const std::uint32_t whole = run_from(block, true);
        if (whole > 0) solve_group(crowd, kernels, group, block, whole, from_memory);
        block += whole;
        const std::uint32_t part = run_from(block, false);
        if (part > 0) solve_group(crowd, kernels, group, block, part, from_memory, mask);
        block += part;
    }
}

bool is_from_memory(const swivel_crowd& crowd, std::uint32_t block_count)
{
    return block_count * block_bytes(crowd) > kCachedBytes;
}

std::uint32_t allowed_arcs(const swivel_crowd& crowd, const Kernels& scalar, const Group& group, std::uint32_t limb,
                           swivel_arc* arcs, std::uint32_t capacity)
{
    ArcEnds ends[kMostArcs];
    const std::uint32_t count = scalar.limbs.allowed_arcs(
        run_of(crowd, group, group.first_block, group.block_count, false, nullptr), limb, ends);
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
            solve_chosen_group(crowd, kernels, group, work.mask, first, count, work.from_memory);
        else
            solve_group(crowd, kernels, group, first, count, work.from_memory);
    });
}

}  // namespace swivel
