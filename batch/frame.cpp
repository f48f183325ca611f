// SPDX-License-Identifier: MIT
//
// The whole frame. A few blocks at a time are copied in, solved and copied out, while their rows are in the nearest
// cache. If limbs are chosen, only these are.
#include "batch/frame.h"

#include <algorithm>
#include <bit>

#include "batch/lane_mask.h"
#include "batch/sized.h"
#include "batch/solve.h"
#include "batch/streams.h"
#include "simd/rows.h"

namespace swivel {

namespace {

// The rows of a run stay in a level 1 cache of 32 KiB. A run is so long that loading the kernels' constants does not
// count. 4 to 16 blocks took the same time within 3 %.
constexpr std::uint32_t kRunBlocks = 8;
// With chosen limbs, a run is longer, so that single limbs of several blocks are solved together.
constexpr std::uint32_t kChosenRunBlocks = 64;
// Copies field after field and group after group, for two blocks at a time: their lines stay in the nearest cache.
constexpr std::uint32_t kCopyBlocks = 2;
// So many successive groups are solved together. Characters with more limbs are rare.
constexpr std::uint32_t kGroupsTogether = 8;

std::uint32_t run_blocks(const Work& work) { return work.mask ? kChosenRunBlocks : kRunBlocks; }

// Values from limb first on.
swivel_in from(const swivel_in& values, std::size_t first)
{
    if (!values.data) return values;
    return {static_cast<const char*>(values.data) + first * values.stride, values.stride};
}

// The copies of one group's frame, its null members left out.
struct Copies {
    struct In {
        FieldRows rows;
        swivel_in values, origin;
        bool doubles;
    } in[kInputCount];
    struct Out {
        FieldRows rows;
        swivel_out values;
    } out[kFieldCount - kInputCount];
    std::size_t in_count, out_count;

    void set(const swivel_crowd& crowd, const Group& group, const swivel_frame& frame)
    {
        in_count = out_count = 0;
        for (const FrameInput& input : kFrameInputs)
            if (const swivel_in& values = frame.*input.member; values.data)
                in[in_count++] = {rows_of(crowd, group, input.field), values,
                                  has_origin(crowd.features, input.field) ? frame.origin : swivel_in{},
                                  frame.origin.data && is_position(input.field)};
        for (const FrameOutput& output : kFrameOutputs)
            if (const swivel_out& values = frame.*output.member; values.data)
                out[out_count++] = {rows_of(crowd, group, output.field), values};
    }

    void read(std::size_t first, std::size_t limb_count) const
    {
        for (std::size_t n = 0; n < in_count; ++n) {
            const swivel_in values = from(in[n].values, first);
            if (in[n].doubles)
                copy_doubles_in(in[n].rows, first, limb_count, values, from(in[n].origin, first));
            else
                copy_in(in[n].rows, first, limb_count, values);
        }
    }
    void write(std::size_t first, std::size_t limb_count) const
    {
        for (std::size_t n = 0; n < out_count; ++n) {
            const auto& [data, stride] = out[n].values;
            copy_out(out[n].rows, first, limb_count, {static_cast<char*>(data) + first * stride, stride});
        }
    }
};

// Calls copy(first, limb_count) for a group's limbs in some blocks, counted within the group: all of them, or those of
// the mask.
template <class Copy>
void for_each_limbs(const Group& group, const std::uint32_t* mask, std::uint32_t block, std::uint32_t block_count,
                    const Copy& copy)
{
    const std::size_t first = std::size_t{block - group.first_block} * SWIVEL_LANES;
    if (!mask) {
        const std::size_t end = first + std::size_t{block_count} * SWIVEL_LANES;
        return copy(first, std::min(end, std::size_t{group.limb_count}) - first);
    }
    for (std::uint32_t k = 0; k < block_count; ++k) {
        LaneMask lanes = lanes_of(mask, block + k) & lanes_of_limbs(group, block + k);
        for (std::size_t lane = first + std::size_t{k} * SWIVEL_LANES; lanes != 0;) {
            const int skipped = std::countr_zero(lanes), taken = std::countr_one(lanes >> skipped);
            copy(lane + static_cast<std::size_t>(skipped), static_cast<std::size_t>(taken));
            lane += static_cast<std::size_t>(skipped + taken);
            lanes >>= skipped + taken;
        }
    }
}

// A group's blocks among those of the job.
struct Share {
    std::uint32_t group, first, count;
};

// Calls take(shares, count, round_count) for the groups that the blocks touch, kGroupsTogether at a time. Round n is
// run n of each share that has so many.
template <class Take>
void for_each_bundle(const swivel_crowd& crowd, swivel_blocks blocks, std::uint32_t run, const Take& take)
{
    Share shares[kGroupsTogether];
    std::uint32_t count = 0, most = 0;
    const auto flush = [&] {
        if (count > 0) take(shares, count, (most + run - 1) / run);
        count = most = 0;
    };
    for_each_group(crowd, blocks, [&](std::uint32_t g, std::uint32_t first, std::uint32_t block_count) {
        shares[count++] = {g, first, block_count};
        most = std::max(most, block_count);
        if (count == kGroupsTogether) flush();
    });
    flush();
}

// The shares that are solved together.
struct Bundle {
    const swivel_crowd& crowd;
    const Kernels& kernels;
    const std::uint32_t* mask;
    const std::uint32_t run;
    std::uint32_t count;
    Share shares[kGroupsTogether];
    Copies copies[kGroupsTogether];

    Bundle(const swivel_crowd& of, const Kernels& with, const Work& work)
        : crowd(of), kernels(with), mask(work.mask), run(run_blocks(work))
    {
    }

    const Group& group(std::uint32_t n) const { return crowd.groups[shares[n].group]; }

    void read_solve_write(std::uint32_t round) const
    {
        for_each_part(round, kCopyBlocks, [&](std::uint32_t n, std::uint32_t block, std::uint32_t blocks) {
            for_each_limbs(group(n), mask, block, blocks,
                           [&](std::size_t first, std::size_t limb_count) { copies[n].read(first, limb_count); });
        });
        for_each_part(round, run, [&](std::uint32_t n, std::uint32_t block, std::uint32_t blocks) {
            if (mask)
                solve_chosen_group(crowd, kernels, group(n), mask, block, blocks);
            else
                solve_group(crowd, kernels, group(n), block, blocks);
        });
        for_each_part(round, kCopyBlocks, [&](std::uint32_t n, std::uint32_t block, std::uint32_t blocks) {
            for_each_limbs(group(n), mask, block, blocks,
                           [&](std::size_t first, std::size_t limb_count) { copies[n].write(first, limb_count); });
        });
    }

private:
    // Calls take(n, first_block, block_count) for the blocks of a round, a few of each share in turn.
    template <class Take>
    void for_each_part(std::uint32_t round, std::uint32_t few, const Take& take) const
    {
        for (std::uint32_t from = round * run, end = from + run; from < end; from += few)
            for (std::uint32_t n = 0; n < count; ++n)
                if (from < shares[n].count) take(n, shares[n].first + from, std::min(few, shares[n].count - from));
    }
};

}  // namespace

std::uint32_t round_count(const swivel_crowd& crowd, const Work& work, swivel_blocks blocks)
{
    std::uint32_t all = 0;
    for_each_bundle(crowd, blocks, run_blocks(work),
                    [&](const Share*, std::uint32_t, std::uint32_t rounds) { all += rounds; });
    return all;
}

void solve_rounds(const swivel_crowd& crowd, const Kernels& kernels, const Work& work, swivel_blocks blocks,
                  std::uint32_t first, std::uint32_t count)
{
    Bundle bundle(crowd, kernels, work);
    std::uint32_t before = 0;  // rounds of earlier bundles
    const auto solve = [&](const Share* shares, std::uint32_t share_count, std::uint32_t rounds) {
        const std::uint32_t from = std::max(first, before), to = std::min(first + count, before + rounds);
        if (from < to) {
            bundle.count = share_count;
            for (std::uint32_t n = 0; n < share_count; ++n) {
                bundle.shares[n] = shares[n];
                bundle.copies[n].set(crowd, crowd.groups[shares[n].group],
                                     element(work.frames, shares[n].group, swivel_default_frame()));
            }
            for (std::uint32_t round = from; round < to; ++round) bundle.read_solve_write(round - before);
        }
        before += rounds;
    };
    for_each_bundle(crowd, blocks, bundle.run, solve);
}

}  // namespace swivel
