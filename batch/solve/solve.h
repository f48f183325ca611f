// SPDX-License-Identifier: MIT
//
// Solves a job on this thread: in parts, and each part by the kernels of its groups.
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
// The parts are strips of bodies (bodies.h), rounds of streams (rounds.h), or else the job's blocks.
JobParts parts_of(const Work& work);
void solve_blocks(const Work& work, std::uint32_t first, std::uint32_t end);

// These solve blocks of one group. The caller has set the floating-point environment (FloatEnv).
//
// Solves every limb, or those whose bits are set in mask, which has one bit for each lane of the crowd. Other limbs
// keep their results. strip: of a workspace, which plain arms do not need.
void solve_group(const Kernels& kernels, const Group& group, GroupBlocks blocks, StripMemory strip,
                 bool exceeds_cache = false, const std::uint32_t* mask = nullptr);
// Solves the limbs of a mask. Plain arms' blocks that are chosen whole are solved as if there were no mask, which is
// faster.
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

}  // namespace swivel
