// SPDX-License-Identifier: MIT
//
// The whole frame, round after round. A round has a run of blocks of each of a few groups. A run is copied in, solved
// and copied out, while its rows are in a near cache. If limbs are chosen, only these are.
#include "batch/frame.h"

#include <algorithm>
#include <bit>
#include <cstring>

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
    for (const FieldRow& row : kFields) count += stream_count(field_row_count(kEveryFeature, row.field));
    return count;
}();

std::uint32_t stream_count_of(const Group& group, const swivel_frame& frame)
{
    std::uint32_t count = 0;
    for (const swivel_frame_field& each : fields_of(frame))
        if (each.data) count += stream_count(field_row_count(group.features, each.field));
    return count;
}

// Calls copy(first, limb_count) for a group's limbs in some blocks, counted within the group: all of them, or those of
// lanes(block).
template <class Copy>
void for_all_limbs(const Group& group, GroupBlocks blocks, const Copy& copy)
{
    const std::size_t first = std::size_t{blocks.first} * SWIVEL_LANES,
                      end = first + std::size_t{blocks.count} * SWIVEL_LANES;
    copy(first, std::min(end, std::size_t{group.limb_count}) - first);
}
template <class Lanes, class Copy>
void for_some_limbs(GroupBlocks blocks, const Lanes& lanes_in, const Copy& copy)
{
    std::size_t first = std::size_t{blocks.first} * SWIVEL_LANES;
    std::size_t from = first, to = first;  // limbs that lie side by side, not yet copied
    for (std::uint32_t block = blocks.first; block < blocks.first + blocks.count; ++block, first += SWIVEL_LANES) {
        LaneMask lanes = lanes_in(block);
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

// The lanes of a group's block whose limbs have bad input.
LaneMask bad_lanes(const Group& group, std::uint32_t block)
{
    const float* const flags = group.results + row_offset(std::size_t{block} * SWIVEL_LANES, group.result_row_count,
                                                          group.first_row[index_of(SWIVEL_FLAGS)]);
    LaneMask lanes = 0;
    for (std::uint32_t lane = 0; lane < SWIVEL_LANES; ++lane) {
        std::uint32_t word;
        std::memcpy(&word, flags + lane, sizeof word);
        lanes |= (word & SWIVEL_BAD_INPUT ? 1u : 0u) << lane;
    }
    return lanes;
}

// A group's blocks among those of the job, and its frame.
struct GroupFrame {
    const Group* group;
    GroupBlocks blocks;
    swivel_frame frame;
};

// Calls take(frames, group_count, round_count) for the groups that a job touches, a few at a time.
template <class Take>
void for_each_bundle(const Work& work, const Take& take)
{
    GroupFrame frames[kGroupsTogether];
    std::uint32_t count = 0, most = 0, streams = 0;
    const auto flush = [&] {
        if (count == 0) return;
        const std::uint32_t run = run_blocks(count);
        take(frames, count, (most + run - 1) / run);
        count = most = streams = 0;
    };
    for_each_group(work.crowd, work.groups, work.blocks, [&](const Group& group, GroupBlocks blocks, std::uint32_t n) {
        const swivel_frame frame = frame_at(work.frames, n);
        const std::uint32_t more = stream_count_of(group, frame);
        if (count == kGroupsTogether || streams + more > kMostStreams) flush();
        frames[count++] = {&group, blocks, frame};
        most = std::max(most, blocks.count);
        streams += more;
    });
    flush();
}

// One group's share of the rounds: its blocks, and the copies of its frame. Inputs come first; then results, of which
// limbs that keep their pose get only the last, the flags.
struct Share {
    const Group* group;
    GroupBlocks blocks;
    std::uint32_t copied_blocks;  // at a time
    Stream *streams, *in_end, *kept_end, *out_end;

    // Stores the streams from `to` on, and returns their end.
    Stream* set(const GroupFrame& of, std::uint32_t run, Stream* to)
    {
        group = of.group;
        blocks = of.blocks;
        streams = to;
        for (const swivel_frame_field& each : fields_of(of.frame))
            if (each.data && is_input(each.field)) to = add_input(of.frame, each, to);
        in_end = to;
        for (const bool is_flags : {false, true}) {
            for (const swivel_frame_field& each : fields_of(of.frame))
                if (each.data && !is_input(each.field) && (each.field == SWIVEL_FLAGS) == is_flags)
                    to = streams_out(rows_of(*group, each.field), 0, {each.data, each.stride}, to);
            (is_flags ? out_end : kept_end) = to;
        }
        const bool is_crowded = std::any_of(streams, out_end, [](const Stream& stream) {
            return stream.stride > 0 && stream.stride % kCrowdedStride == 0;
        });
        copied_blocks = is_crowded ? kCrowdedBlocks : run;
        return out_end;
    }
    void copy_in(const std::uint32_t* mask, GroupBlocks some) const { copy_chosen(streams, in_end, mask, some); }
    void copy_out(const std::uint32_t* mask, GroupBlocks some) const
    {
        if (!group->keeps) return copy_chosen(in_end, out_end, mask, some);
        const auto good = [&](std::uint32_t block) {
            return (mask ? chosen_limbs(*group, block, mask) : lanes_of_limbs(*group, block)) &
                   ~bad_lanes(*group, block);
        };
        for_some_limbs(some, good,
                       [&](std::size_t limb, std::size_t limb_count) { copy(in_end, kept_end, limb, limb_count); });
        copy_chosen(kept_end, out_end, mask, some);
    }

private:
    Stream* add_input(const swivel_frame& frame, const swivel_frame_field& each, Stream* to) const
    {
        const FieldRows rows = rows_of(*group, each.field);
        const swivel_in values{each.data, each.stride};
        if (!frame.origin.data || !is_position(each.field)) return streams_in(rows, 0, values, to);
        const swivel_in origin = has_origin(group->features, each.field) ? frame.origin : swivel_in{};
        return streams_of_doubles(rows, 0, values, origin, to);
    }
    void copy_chosen(const Stream* from, const Stream* end, const std::uint32_t* mask, GroupBlocks some) const
    {
        const auto copy_limbs = [&](std::size_t limb, std::size_t limb_count) { copy(from, end, limb, limb_count); };
        if (mask)
            for_some_limbs(
                some, [&](std::uint32_t block) { return chosen_limbs(*group, block, mask); }, copy_limbs);
        else
            for_all_limbs(*group, some, copy_limbs);
    }
};

// Groups whose runs make the same rounds.
struct Bundle {
    const Work& work;
    std::uint32_t count, run;  // how many groups, and how many blocks of each in a round
    Share shares[kGroupsTogether];
    Stream streams[kMostStreams];  // of all shares

    explicit Bundle(const Work& todo) : work(todo) {}

    void set(const GroupFrame* frames, std::uint32_t group_count)
    {
        count = group_count;
        run = run_blocks(count);
        Stream* to = streams;
        for (std::uint32_t n = 0; n < count; ++n) to = shares[n].set(frames[n], run, to);
    }
    void solve(std::uint32_t round) const
    {
        for (const Share* share = shares; share != shares + count; ++share)
            if (const std::uint32_t first = round * run; first < share->blocks.count)
                solve_run(*share, {share->blocks.first + first, std::min(run, share->blocks.count - first)});
    }

private:
    void solve_run(const Share& share, GroupBlocks blocks) const
    {
        copy_run(share, blocks, &Share::copy_in);
        if (work.mask)
            solve_chosen_group(work.kernels, *share.group, work.mask, blocks, work.strip);
        else
            solve_group(work.kernels, *share.group, blocks, work.strip);
        copy_run(share, blocks, &Share::copy_out);
    }
    void copy_run(const Share& share, GroupBlocks blocks,
                  void (Share::*copy)(const std::uint32_t* mask, GroupBlocks) const) const
    {
        for (std::uint32_t done = 0; done < blocks.count; done += share.copied_blocks)
            (share.*copy)(work.mask, {blocks.first + done, std::min(share.copied_blocks, blocks.count - done)});
    }
};

}  // namespace

std::uint32_t round_count(const Work& work)
{
    std::uint32_t all = 0;
    for_each_bundle(work, [&](const GroupFrame*, std::uint32_t, std::uint32_t rounds) { all += rounds; });
    return all;
}

void solve_rounds(const Work& work, std::uint32_t first, std::uint32_t end)
{
    const FloatEnv env;
    Bundle bundle(work);
    std::uint32_t before = 0;  // rounds of earlier bundles
    for_each_bundle(work, [&](const GroupFrame* of_groups, std::uint32_t group_count, std::uint32_t rounds) {
        const std::uint32_t from = std::max(first, before), to = std::min(end, before + rounds);
        if (from < to) bundle.set(of_groups, group_count);
        for (std::uint32_t round = from; round < to; ++round) bundle.solve(round - before);
        before += rounds;
    });
}

}  // namespace swivel
