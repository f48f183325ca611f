// SPDX-License-Identifier: MIT
//
// A round has a run of blocks of each of a few groups. A run is copied in, solved and copied out, while its rows are in
// a near cache. If limbs are chosen, only these are.
#include <algorithm>

#include "batch/solve/group_copies.h"
#include "batch/solve/solve.h"
#include "batch/solve/work.h"
#include "simd/float_env.h"

namespace swivel {

namespace {

// So many successive groups share rounds, or fewer if their streams have many values: the copies of all of them lie on
// the stack. Characters with more limbs are rare.
constexpr std::uint32_t kGroupsTogether = 4;
// The blocks of a round. With fewer, more time goes into starting loops; with more, fewer rows stay in the nearest
// cache. 16 and 64 blocks took 1.02 to 1.04 times as long.
constexpr std::uint32_t kRoundBlocks = 32;
// Blocks of each group in a round.
std::uint32_t blocks_each(std::uint32_t group_count) { return kRoundBlocks / group_count; }

// Calls take(of_groups, group_count, round_count) for the groups that a job touches, a few at a time.
template <class Take>
void for_each_bundle(const Work& work, const Take& take)
{
    GroupStreams of_groups[kGroupsTogether];
    std::uint32_t count = 0, max = 0, streams = 0;
    const auto flush = [&] {
        if (count == 0) return;
        const std::uint32_t run_blocks = blocks_each(count);
        take(of_groups, count, (max + run_blocks - 1) / run_blocks);
        count = max = streams = 0;
    };
    for_each_group(work.crowd, work.groups, work.blocks, [&](const Group& group, GroupBlocks blocks, std::uint32_t n) {
        const swivel_streams given = streams_at(work.streams, n);
        const std::uint32_t more = stream_count_of(group, given);
        if (count == kGroupsTogether || streams + more > kMaxStreams) flush();
        of_groups[count++] = {&group, blocks, given};
        max = std::max(max, blocks.count);
        streams += more;
    });
    flush();
}

// Groups whose runs make the same rounds.
struct Bundle {
    const Work& work;
    std::uint32_t count, run_blocks;  // how many groups, and how many blocks of each in a round
    GroupCopies groups[kGroupsTogether];
    Stream streams[kMaxStreams];  // of all groups

    explicit Bundle(const Work& todo) : work(todo) {}

    void set(const GroupStreams* of_groups, std::uint32_t group_count)
    {
        count = group_count;
        run_blocks = blocks_each(count);
        Stream* next = streams;
        for (std::uint32_t n = 0; n < count; ++n) next = groups[n].set(of_groups[n], run_blocks, next);
    }
    void solve(std::uint32_t round) const
    {
        const std::uint32_t first = round * run_blocks;
        for (const GroupCopies* copies = groups; copies != groups + count; ++copies) {
            if (first >= copies->blocks.count) continue;
            const GroupBlocks run{copies->blocks.first + first, std::min(run_blocks, copies->blocks.count - first)};
            copies->copy_in(work.mask, run);
            solve_chosen_group(work.kernels, *copies->group, work.mask, run, work.strip);
            copies->copy_out(work.mask, run);
        }
    }
};

}  // namespace

std::uint32_t round_count(const Work& work)
{
    std::uint32_t all = 0;
    for_each_bundle(work, [&](const GroupStreams*, std::uint32_t, std::uint32_t rounds) { all += rounds; });
    return all;
}

void solve_rounds(const Work& work, std::uint32_t first, std::uint32_t end)
{
    const FloatEnv env;
    Bundle bundle(work);
    std::uint32_t before = 0;  // rounds of earlier bundles
    for_each_bundle(work, [&](const GroupStreams* of_groups, std::uint32_t group_count, std::uint32_t rounds) {
        const std::uint32_t begin = std::max(first, before), stop = std::min(end, before + rounds);
        if (begin < stop) bundle.set(of_groups, group_count);
        for (std::uint32_t round = begin; round < stop; ++round) bundle.solve(round - before);
        before += rounds;
    });
}

}  // namespace swivel
