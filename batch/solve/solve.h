// SPDX-License-Identifier: MIT
//
// Solves a job: in parts, on this thread or on several, and each part by the kernels of its groups.
#pragma once

#include "batch/solve/work.h"

namespace swivel {

// Solves all parts of a job, one after the other.
void solve_here(const Work& work);

// A job in parts, each of which any one thread solves.
struct JobParts {
    std::uint32_t count;
    void (*solve)(const Work& work, std::uint32_t first, std::uint32_t end);  // solves parts first ... end - 1
};
// The parts are strips of bodies, rounds of streams, or else the job's blocks.
JobParts parts_of(const Work& work);
void solve_blocks(const Work& work, std::uint32_t first, std::uint32_t end);

// These solve blocks of one group. The caller has set the floating-point environment (FloatEnv).
//
// Solves every limb, or those whose bits are set in mask, which has one bit for each lane of the crowd. Other limbs
// keep their results. strip: of a workspace, which plain arms do not need.
void solve_group(const Kernels& kernels, const Group& group, GroupBlocks blocks, StripMemory strip,
                 bool exceeds_cache = false, const std::uint32_t* mask = nullptr);
// The same. Plain arms' blocks that are chosen whole are solved as if there were no mask, which is faster.
void solve_chosen_group(const Kernels& kernels, const Group& group, const std::uint32_t* mask, GroupBlocks blocks,
                        StripMemory strip, bool exceeds_cache = false);
// Runs the stages of one pass of a group of bodies, before any limb of these bodies is solved.
void prepare_group(const Kernels& kernels, const Group& group, Pass pass, GroupBlocks blocks, StripMemory strip,
                   const std::uint32_t* mask);

// The blocks as kernels take them, for the pass that solves.
SolveRun run_of(const Group& group, GroupBlocks blocks, StripMemory strip, bool exceeds_cache,
                const std::uint32_t* mask);

// Whether the rows of so many blocks are too large to stay in the caches from one solve to the next.
bool exceeds_cache(const swivel_crowd& crowd, std::uint32_t block_count);

// bodies.cpp: a job of bodies goes in strips. A strip has as many blocks of bodies as a workspace.
std::uint32_t strip_count(const Work& work);
// Solves strips first ... end - 1 of a job on this thread.
void solve_strips(const Work& work, std::uint32_t first, std::uint32_t end);

// pose.cpp: the way of solved joints back into the bodies' poses.
//
// These write a block's bodies to the caller's memory: the joints that a group moves; and, once all groups are solved,
// where all needed joints are.
void pose_out(const BodyKernels& kernels, const BodyPlan& plan, const Group& group, const BodyBlock& block);
// The same of a pose in the body's space, where the group's own motion is known.
void carry_out(const BodyKernels& kernels, const BodyPlan& plan, const Group& group, const BodyBlock& block);
void joints_out(const BodyKernels& kernels, const BodyPlan& plan, const BodyBlock& block);
// Sets how a limb or look that is not solved moves its joints: no more than what is above them.
void stay(const Group& group, const BodyBlock& block);

// rounds.cpp: a job with streams goes in rounds, because limbs of one character often share cache lines. Round n is the
// nth run of blocks of each group, so one thread has the same characters of all groups.
std::uint32_t round_count(const Work& work);
// Solves rounds first ... end - 1 of a job on this thread.
void solve_rounds(const Work& work, std::uint32_t first, std::uint32_t end);

// schedule.cpp: solves a job in the caller's oneTBB arena. Returns false, and has solved nothing, where the job is too
// small for several threads or the library is built without oneTBB.
bool solve_on_threads(const Work& work);

// A crowd remembers which thread solved which chunk, from its creation to its end.
void begin_schedule(swivel_crowd& crowd);
void end_schedule(swivel_crowd& crowd);

// rest.cpp: puts all limbs of a new crowd, or of a new group of free limbs, into their rest pose, without flags.
void rest(const swivel_crowd& crowd);
void rest(Group& group);

// budget.cpp: chooses the blocks that are solved within a budget. Blocks gather urgency while they wait, and the most
// urgent are picked. Does what swivel_choose() promises; arguments are already checked: an entry of priorities for each
// group, words for every block, urgency or null. Returns how many limbs were picked.
//
// The magnitude of a block's urgency is what it has gathered. The sign says whether the block is wanted now, so that no
// second array is needed: above 0 if it is, else negative or 0.
std::uint32_t choose(const swivel_crowd& crowd, const swivel_in* priorities, float* urgency, std::uint32_t max_blocks,
                     std::uint32_t* words);

}  // namespace swivel
