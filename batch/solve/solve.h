// SPDX-License-Identifier: MIT
//
// Solves runs of blocks, and cuts a crowd into chunks for threads.
#pragma once

#include <algorithm>

#include "batch/crowd/crowd.h"
#include "simd/kernels.h"

namespace swivel {

// Some of a group's blocks, counted within it.
struct GroupBlocks {
    std::uint32_t first, count;
};

// These solve blocks of one group on this thread. The caller has set the floating-point environment (FloatEnv).
// solve_group() solves every limb, or those whose bits are set in mask, which has one bit for each lane of the crowd.
// Other limbs keep their results. strip: of a workspace, which plain arms do not need. from_memory: the job's rows do
// not fit the caches.
void solve_group(const Kernels& kernels, const Group& group, GroupBlocks blocks, StripMemory strip,
                 bool from_memory = false, const std::uint32_t* mask = nullptr);
// A group of bodies does this in a pass before any of their limbs is solved.
void prepare_group(const Kernels& kernels, const Group& group, Pass pass, GroupBlocks blocks, StripMemory strip,
                   const std::uint32_t* mask);
// The limbs of a mask. Plain arms' blocks that are chosen whole are solved as if there were no mask, which is faster.
void solve_chosen_group(const Kernels& kernels, const Group& group, const std::uint32_t* mask, GroupBlocks blocks,
                        StripMemory strip, bool from_memory = false);

// The swivels that the limits of a limb, counted within its group, allow (swivel_allowed_arcs).
std::uint32_t allowed_arcs(const Group& group, std::uint32_t limb, swivel_arc* arcs, std::uint32_t capacity);

// A swivel_job, checked.
struct Work {
    swivel_crowd& crowd;
    const Kernels& kernels;
    swivel_blocks blocks;
    const std::uint32_t* groups;    // bits of those that are named; null: all
    const std::uint32_t* mask;      // bits of the limbs to solve; null: all
    const swivel_streams* streams;  // of each group that is named; null: values are in rows
    bool from_memory;               // the job's rows do not fit the caches
    StripMemory strip;              // of a workspace
    const swivel_pose* pose;        // of bodies; null: free limbs
    swivel_sample* sample = nullptr;
    void* sample_user = nullptr;
};
inline bool is_named(const std::uint32_t* groups, std::uint32_t g) { return !groups || groups[g / 32] >> g % 32 & 1; }

// Calls run(group, its blocks, n) for each group's share of a range of the crowd's blocks, if it is named; n counts
// all groups that are named before it.
template <class Run>
void for_each_group(const swivel_crowd& crowd, const std::uint32_t* groups, swivel_blocks blocks, const Run& run)
{
    const std::uint32_t first_block = blocks.first, end_block = blocks.first + blocks.count;
    for (std::uint32_t g = 0, n = 0; g < crowd.group_count; ++g) {
        if (!is_named(groups, g)) continue;
        const Group& group = crowd.groups[g];
        const std::uint32_t from = std::max(first_block, group.first_block);
        const std::uint32_t to = std::min(end_block, group.first_block + group.block_count);
        if (from < to) run(group, GroupBlocks{from - group.first_block, to - from}, n);
        ++n;
    }
}

// Blocks of the named groups in a range; of bodies, the range's.
inline std::uint32_t block_count_of(const swivel_crowd& crowd, const std::uint32_t* groups, swivel_blocks blocks)
{
    if (crowd.joint_count > 0) return blocks.count;
    std::uint32_t count = 0;
    for_each_group(crowd, groups, blocks, [&](const Group&, GroupBlocks part, std::uint32_t) { count += part.count; });
    return count;
}
bool is_from_memory(const swivel_crowd& crowd, std::uint32_t block_count);

// Work with streams goes in rounds, because limbs of one character often share cache lines. Round n is the nth run of
// blocks of each group. These solve rounds first ... end - 1 of a job's blocks on this thread, and count all rounds.
void solve_rounds(const Work& work, std::uint32_t first, std::uint32_t end);
std::uint32_t round_count(const Work& work);

// Bodies go in runs of as many blocks as a workspace has. These solve runs first ... end - 1 of a job's blocks on this
// thread, and count all runs.
void solve_runs(const Work& work, std::uint32_t first, std::uint32_t end);
std::uint32_t run_count(const Work& work);

// Solves a job on this thread; or in chunks in the caller's oneTBB arena, if there are enough.
void solve_here(const Work& work);
void solve_in_chunks(const Work& work);

// A crowd's memory of which thread solved which chunk: from its creation to its end.
void begin_schedule(swivel_crowd& crowd);
void end_schedule(swivel_crowd& crowd);

}  // namespace swivel
