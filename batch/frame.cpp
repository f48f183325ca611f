// SPDX-License-Identifier: MIT
//
// The whole frame, round after round. A round has a run of blocks of each of a few groups. A run is copied in, solved
// and copied out, while its rows are in a near cache. If limbs are chosen, only these are.
#include "batch/frame.h"

#include <algorithm>
#include <bit>

#include "batch/lane_mask.h"
#include "batch/solve.h"
#include "batch/streams.h"
#include "simd/float_env.h"
#include "simd/rows.h"

namespace swivel {

namespace {

// So many successive groups share rounds, or fewer if their frames have many values: the copies of all of them lie on
// the stack. Characters with more limbs are rare.
constexpr std::uint32_t kGroupsTogether = 4;
// The blocks of a round. With fewer, more time goes into starting loops; with more, fewer rows stay in the nearest
// cache. 16 and 64 blocks took 1.02 to 1.04 times as long.
constexpr std::uint32_t kRoundBlocks = 32;
// The fields of a limb often share cache lines. Values that are a multiple of half a kilobyte apart fall on few places
// of a cache. The lines of a whole run then do not stay there, so two blocks of all fields are copied at a time. That
// took 0.8 of the time there, and 1.06 where it is not needed.
constexpr std::size_t kCrowdedStride = 512;
constexpr std::uint32_t kCrowdedBlocks = 2;

// Blocks of each group in a round.
std::uint32_t run_blocks(std::uint32_t group_count) { return kRoundBlocks / group_count; }

// Streams of a frame that has every field, or of four ordinary ones.
constexpr std::uint32_t kMostStreams = [] {
    std::uint32_t count = 0;
    for (std::size_t n = 0; n < kFieldCount; ++n)
        count += stream_count(field_row_count(kEveryFeature, static_cast<Field>(n)));
    return count;
}();

// Streams of a group's frame. This and Share::set() are functions of their own, so that the copy of a frame takes no
// stack while limbs are solved.
[[gnu::noinline]] std::uint32_t stream_count_of(const swivel_crowd& crowd, const Work& work, std::uint32_t g)
{
    swivel_frame filled;
    const swivel_frame& frame = frame_at(work.frames, g, filled);
    std::uint32_t count = 0;
    const auto add = [&](Field field, const void* data) {
        if (data) count += stream_count(field_row_count(crowd.features, field));
    };
    for (const auto& [field, member] : kFrameInputs) add(field, (frame.*member).data);
    for (const auto& [field, member] : kFrameOutputs) add(field, (frame.*member).data);
    return count;
}

// Calls copy(first, limb_count) for a group's limbs in some blocks, counted within the group: all of them, or those of
// the mask.
template <class Copy>
void for_each_limbs(const Group& group, const std::uint32_t* mask, std::uint32_t block, std::uint32_t block_count,
                    const Copy& copy)
{
    std::size_t first = std::size_t{block - group.first_block} * SWIVEL_LANES;
    if (!mask) {
        const std::size_t end = first + std::size_t{block_count} * SWIVEL_LANES;
        return copy(first, std::min(end, std::size_t{group.limb_count}) - first);
    }
    std::size_t from = first, to = first;  // chosen limbs that lie side by side, not yet copied
    for (const std::uint32_t end = block + block_count; block < end; ++block, first += SWIVEL_LANES) {
        LaneMask lanes = lanes_of(mask, block) & lanes_of_limbs(group, block);
        for (std::size_t limb = first; lanes != 0;) {
            const int skipped = std::countr_zero(lanes), taken = std::countr_one(lanes >> skipped);
            limb += static_cast<std::size_t>(skipped);
            if (limb > to) {
                if (from < to) copy(from, to - from);
                from = limb;
            }
            to = limb += static_cast<std::size_t>(taken);
            lanes >>= skipped + taken;
        }
    }
    if (from < to) copy(from, to - from);
}

// A group's blocks among those of the job.
struct Blocks {
    std::uint32_t group, first, count;
};

// Calls take(blocks, group_count, round_count) for the groups that a job's blocks touch, a few at a time.
template <class Take>
void for_each_bundle(const swivel_crowd& crowd, const Work& work, swivel_blocks all, const Take& take)
{
    Blocks blocks[kGroupsTogether];
    std::uint32_t count = 0, most = 0, streams = 0;
    const auto flush = [&] {
        if (count == 0) return;
        const std::uint32_t run = run_blocks(count);
        take(blocks, count, (most + run - 1) / run);
        count = most = streams = 0;
    };
    for_each_group(crowd, all, [&](std::uint32_t g, std::uint32_t first, std::uint32_t block_count) {
        const std::uint32_t more = stream_count_of(crowd, work, g);
        if (count == kGroupsTogether || streams + more > kMostStreams) flush();
        blocks[count++] = {g, first, block_count};
        most = std::max(most, block_count);
        streams += more;
    });
    flush();
}

// One group's share of the rounds: its blocks, and the copies of its frame, null members left out.
struct Share {
    const Group* group;
    Blocks blocks;
    std::uint32_t copied_blocks;         // at a time
    Stream *streams, *in_end, *out_end;  // inputs come first

    // Stores the streams from `to` on, and returns their end.
    [[gnu::noinline]] Stream* set(const swivel_crowd& crowd, const Work& work, const Blocks& of, std::uint32_t run,
                                  Stream* to)
    {
        swivel_frame filled;
        const swivel_frame& frame = frame_at(work.frames, of.group, filled);
        group = crowd.groups + of.group;
        blocks = of;
        streams = in_end = to;
        for (const auto& [field, member] : kFrameInputs) {
            const swivel_in& values = frame.*member;
            if (!values.data) continue;
            const FieldRows rows = rows_of(crowd, *group, field);
            const swivel_in origin = has_origin(crowd.features, field) ? frame.origin : swivel_in{};
            const bool has_doubles = frame.origin.data && is_position(field);
            in_end =
                has_doubles ? streams_of_doubles(rows, 0, values, origin, in_end) : streams_in(rows, 0, values, in_end);
        }
        out_end = in_end;
        for (const auto& [field, member] : kFrameOutputs)
            if (const swivel_out& values = frame.*member; values.data)
                out_end = streams_out(rows_of(crowd, *group, field), 0, values, out_end);
        const bool is_crowded = std::any_of(streams, out_end, [](const Stream& stream) {
            return stream.stride > 0 && stream.stride % kCrowdedStride == 0;
        });
        copied_blocks = is_crowded ? kCrowdedBlocks : run;
        return out_end;
    }
    void read(std::size_t first, std::size_t limb_count) const { copy(streams, in_end, first, limb_count); }
    void write(std::size_t first, std::size_t limb_count) const { copy(in_end, out_end, first, limb_count); }
};

// Groups whose runs make the same rounds.
struct Bundle {
    const swivel_crowd& crowd;
    const Kernels& kernels;
    const Work& work;
    std::uint32_t count, run;  // how many groups, and how many blocks of each in a round
    Share shares[kGroupsTogether];
    Stream streams[kMostStreams];  // of all shares

    Bundle(const swivel_crowd& of, const Kernels& with, const Work& todo) : crowd(of), kernels(with), work(todo) {}

    void set(const Blocks* blocks, std::uint32_t group_count)
    {
        count = group_count;
        run = run_blocks(count);
        Stream* to = streams;
        for (std::uint32_t n = 0; n < count; ++n) to = shares[n].set(crowd, work, blocks[n], run, to);
    }
    void solve(std::uint32_t round) const
    {
        for (const Share* share = shares; share != shares + count; ++share)
            if (const std::uint32_t first = round * run; first < share->blocks.count)
                solve_run(*share, share->blocks.first + first, std::min(run, share->blocks.count - first));
    }

private:
    void solve_run(const Share& share, std::uint32_t block, std::uint32_t block_count) const
    {
        copy_run(share, block, block_count, &Share::read);
        if (work.mask)
            solve_chosen_group(crowd, kernels, *share.group, work.mask, block, block_count);
        else
            solve_group(crowd, kernels, *share.group, block, block_count);
        copy_run(share, block, block_count, &Share::write);
    }
    void copy_run(const Share& share, std::uint32_t block, std::uint32_t block_count,
                  void (Share::*copy)(std::size_t, std::size_t) const) const
    {
        for (std::uint32_t done = 0; done < block_count; done += share.copied_blocks)
            for_each_limbs(*share.group, work.mask, block + done, std::min(share.copied_blocks, block_count - done),
                           [&](std::size_t limb, std::size_t limb_count) { (share.*copy)(limb, limb_count); });
    }
};

}  // namespace

std::uint32_t round_count(const swivel_crowd& crowd, const Work& work, swivel_blocks blocks)
{
    std::uint32_t all = 0;
    for_each_bundle(crowd, work, blocks, [&](const Blocks*, std::uint32_t, std::uint32_t rounds) { all += rounds; });
    return all;
}

void solve_rounds(const swivel_crowd& crowd, const Kernels& kernels, const Work& work, swivel_blocks blocks,
                  std::uint32_t first, std::uint32_t end)
{
    const FloatEnv env;
    Bundle bundle(crowd, kernels, work);
    std::uint32_t before = 0;  // rounds of earlier bundles
    const auto solve = [&](const Blocks* of_groups, std::uint32_t group_count, std::uint32_t rounds) {
        const std::uint32_t from = std::max(first, before), to = std::min(end, before + rounds);
        if (from < to) bundle.set(of_groups, group_count);
        for (std::uint32_t round = from; round < to; ++round) bundle.solve(round - before);
        before += rounds;
    };
    for_each_bundle(crowd, work, blocks, solve);
}

}  // namespace swivel
