// SPDX-License-Identifier: MIT
//
// The whole frame, round after round. A round is a run of blocks of each of some groups. These are copied in, solved
// and copied out, while their rows are in the nearest cache. If limbs are chosen, only these are.
#include "batch/frame.h"

#include <algorithm>
#include <bit>

#include "batch/lane_mask.h"
#include "batch/solve.h"
#include "batch/streams.h"
#include "simd/rows.h"

namespace swivel {

namespace {

// The rows of a run stay in a level 1 cache of 32 KiB. A run is so long that loading the kernels' constants does not
// count, nor starting the copies. 8 and 16 blocks took the same time, 4 took 1.02 of it.
constexpr std::uint32_t kRunBlocks = 8;
// With chosen limbs, a run is longer, so that single limbs of several blocks are solved together.
constexpr std::uint32_t kChosenRunBlocks = 64;
// The fields of a limb often share cache lines. If values are a multiple of half a kilobyte apart, they fall on so few
// places of a cache that the lines of a whole run do not stay. Then two blocks of all fields are copied at a time. That
// took 0.8 of the time there, and 1.06 where it is not needed.
constexpr std::size_t kCrowdedStride = 512;
constexpr std::uint32_t kCrowdedBlocks = 2;
// So many successive groups are solved together. Characters with more limbs are rare.
constexpr std::uint32_t kGroupsTogether = 8;

std::uint32_t run_blocks(const Work& work) { return work.mask ? kChosenRunBlocks : kRunBlocks; }

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
struct Blocks {
    std::uint32_t group, first, count;
};

// Calls take(blocks, group_count, round_count) for the groups that a job's blocks touch, kGroupsTogether at a time. So
// a group that is much longer than many others does not look through all of these again and again.
template <class Take>
void for_each_bundle(const swivel_crowd& crowd, swivel_blocks all, std::uint32_t run, const Take& take)
{
    Blocks blocks[kGroupsTogether];
    std::uint32_t count = 0, most = 0;
    const auto flush = [&] {
        if (count > 0) take(blocks, count, (most + run - 1) / run);
        count = most = 0;
    };
    for_each_group(crowd, all, [&](std::uint32_t g, std::uint32_t first, std::uint32_t block_count) {
        blocks[count++] = {g, first, block_count};
        most = std::max(most, block_count);
        if (count == kGroupsTogether) flush();
    });
    flush();
}

// One group's share of the rounds: its blocks, and the copies of its frame, null members left out.
struct Share {
    const Group* group;
    Blocks blocks;
    const Stream *in_end, *out_end;
    Stream in[kMostStreams], out[kMostStreams];

    void set(const swivel_crowd& crowd, const swivel_frame& frame, const Blocks& of)
    {
        group = crowd.groups + of.group;
        blocks = of;
        Stream* to = in;
        for (const auto& [field, member] : kFrameInputs) {
            const swivel_in& values = frame.*member;
            if (!values.data) continue;
            const FieldRows rows = rows_of(crowd, *group, field);
            const bool has_doubles = frame.origin.data && is_position(field);
            to = has_doubles ? streams_of_doubles(rows, 0, values,
                                                  has_origin(crowd.features, field) ? frame.origin : swivel_in{}, to)
                             : streams_in(rows, 0, values, to);
        }
        in_end = to;
        to = out;
        for (const auto& [field, member] : kFrameOutputs)
            if (const swivel_out& values = frame.*member; values.data)
                to = streams_out(rows_of(crowd, *group, field), 0, values, to);
        out_end = to;
    }
    bool is_crowded() const
    {
        const auto is_so = [](const Stream& stream) {
            return stream.stride > 0 && stream.stride % kCrowdedStride == 0;
        };
        return std::any_of(in, in_end, is_so) || std::any_of(out, out_end, is_so);
    }
};

void copy_all(const Stream* stream, const Stream* end, std::size_t first, std::size_t limb_count)
{
    for (; stream != end; ++stream) stream->copy(first, limb_count);
}

// Groups whose runs make the same rounds.
struct Bundle {
    const swivel_crowd& crowd;
    const Kernels& kernels;
    const Work& work;
    const std::uint32_t run = run_blocks(work);
    std::uint32_t count = 0, few = 0;  // how many groups, and how many blocks of each are copied at a time
    Share shares[kGroupsTogether];

    Bundle(const swivel_crowd& of, const Kernels& with, const Work& todo) : crowd(of), kernels(with), work(todo) {}

    void set(const Blocks* blocks, std::uint32_t group_count)
    {
        count = group_count;
        few = run;
        for (std::uint32_t n = 0; n < count; ++n) {
            swivel_frame filled;
            shares[n].set(crowd, frame_at(work.frames, blocks[n].group, filled), blocks[n]);
            if (shares[n].is_crowded()) few = kCrowdedBlocks;
        }
    }
    void solve(std::uint32_t round) const
    {
        const std::uint32_t first = round * run;
        for (std::uint32_t n = 0; n < run; n += few)
            for_each_share(first + n, few, [&](const Share& share, std::uint32_t block, std::uint32_t block_count) {
                for_each_limbs(*share.group, work.mask, block, block_count,
                               [&](std::size_t limb, std::size_t limb_count) {
                                   copy_all(share.in, share.in_end, limb, limb_count);
                               });
            });
        for_each_share(first, run, [&](const Share& share, std::uint32_t block, std::uint32_t block_count) {
            if (work.mask)
                solve_chosen_group(crowd, kernels, *share.group, work.mask, block, block_count);
            else
                solve_group(crowd, kernels, *share.group, block, block_count);
        });
        for (std::uint32_t n = 0; n < run; n += few)
            for_each_share(first + n, few, [&](const Share& share, std::uint32_t block, std::uint32_t block_count) {
                for_each_limbs(*share.group, work.mask, block, block_count,
                               [&](std::size_t limb, std::size_t limb_count) {
                                   copy_all(share.out, share.out_end, limb, limb_count);
                               });
            });
    }

private:
    // Calls take(share, block, block_count) for up to `most` blocks of each group from its block `first` of the job on.
    template <class Take>
    void for_each_share(std::uint32_t first, std::uint32_t most, const Take& take) const
    {
        for (const Share* share = shares; share != shares + count; ++share)
            if (const Blocks& blocks = share->blocks; first < blocks.count)
                take(*share, blocks.first + first, std::min(most, blocks.count - first));
    }
};

}  // namespace

std::uint32_t round_count(const swivel_crowd& crowd, const Work& work, swivel_blocks blocks)
{
    std::uint32_t all = 0;
    for_each_bundle(crowd, blocks, run_blocks(work),
                    [&](const Blocks*, std::uint32_t, std::uint32_t rounds) { all += rounds; });
    return all;
}

void solve_rounds(const swivel_crowd& crowd, const Kernels& kernels, const Work& work, swivel_blocks blocks,
                  std::uint32_t first, std::uint32_t end)
{
    Bundle bundle(crowd, kernels, work);
    std::uint32_t before = 0;  // rounds of earlier bundles
    for_each_bundle(crowd, blocks, bundle.run,
                    [&](const Blocks* of_groups, std::uint32_t group_count, std::uint32_t rounds) {
                        const std::uint32_t from = std::max(first, before), to = std::min(end, before + rounds);
                        if (from < to) bundle.set(of_groups, group_count);
                        for (std::uint32_t round = from; round < to; ++round) bundle.solve(round - before);
                        before += rounds;
                    });
}

}  // namespace swivel
