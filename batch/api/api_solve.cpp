// SPDX-License-Identifier: MIT
//
// The C entry points that solve limbs and choose them. A job is checked (job_check.cpp), becomes Work, and is solved.
#include <bit>

#include "batch/api/check.h"
#include "batch/api/use.h"
#include "batch/api/workspace.h"
#include "batch/refusal/sized.h"
#include "batch/solve/solve.h"

using namespace swivel;

namespace {

// How many limbs a job solves.
std::uint32_t count_limbs(const Work& work)
{
    std::uint32_t limb_count = 0;
    for_each_group(work.crowd, work.groups, work.blocks, [&](const Group& group, GroupBlocks part, std::uint32_t n) {
        if (work.pose && n > 0) return;  // the same bodies
        const std::uint32_t last = part.first + part.count - 1;
        if (!work.mask) {
            limb_count += (part.count - 1) * SWIVEL_LANES + limb_count_of(group, last);
            return;
        }
        for (std::uint32_t block = part.first; block <= last; ++block)
            limb_count += static_cast<std::uint32_t>(std::popcount(chosen_limbs(group, block, work.mask)));
    });
    return limb_count;
}

}  // namespace

swivel_status swivel_solve(swivel_crowd* crowd, const swivel_job* given)
{
    if (!given) {
        const swivel_job everything = swivel_default_job();
        return swivel_solve(crowd, &everything);
    }
    swivel_status status = check_size<swivel_job>("job", size_of(given));
    if (status != SWIVEL_OK) return status;
    swivel_job filled;
    const swivel_job& job = whole(given, swivel_default_job, filled);
    const Use use(crowd, job.on_this_thread ? Sharing::shared : Sharing::alone);
    status = use.status;
    if (status != SWIVEL_OK) return status;
    const swivel_blocks blocks = job.blocks ? *job.blocks : swivel_blocks{0, crowd->block_count};
    status = check_job(*crowd, job, blocks);
    if (status != SWIVEL_OK) return status;
    const Isa* const isa = usable_isa(status);
    if (!isa) return status;
    const Workspace workspace(*crowd, job.workspace);
    if (workspace.status != SWIVEL_OK) return workspace.status;

    const Work work{.crowd = *crowd,
                    .kernels = isa->kernels,
                    .blocks = blocks,
                    .groups = job.groups,
                    .mask = job.mask,
                    .streams = job.streams,
                    .exceeds_cache = exceeds_cache(*crowd, block_count_of(*crowd, job.groups, blocks)),
                    .strip = workspace.strip,
                    .pose = job.pose,
                    .sample = job.sample,
                    .sample_user = job.sample_user};
    if (work.pose) note_doubts(work);
    if (job.on_this_thread || !solve_on_threads(work)) solve_here(work);
    if (job.solved_count) *job.solved_count = count_limbs(work);
    return SWIVEL_OK;
}

size_t swivel_workspace_bytes(const swivel_crowd* crowd)
{
    return crowd ? workspace_floats(crowd->strip_blocks, crowd->body_row_count) * sizeof(float) : 0;
}

swivel_status swivel_choose(swivel_crowd* crowd, const swivel_in* priorities, float* urgency, uint32_t max_blocks,
                            uint32_t* mask, uint32_t word_count, uint32_t* chosen_count)
{
    const Use use(crowd, Sharing::alone);
    swivel_status status = use.status;
    if (status == SWIVEL_OK) status = check_priorities(*crowd, priorities);
    if (status == SWIVEL_OK) status = check_mask(*crowd, mask, word_count);
    if (status != SWIVEL_OK) return status;
    const uint32_t picked = choose(*crowd, priorities, urgency, max_blocks, mask);
    if (chosen_count) *chosen_count = picked;
    return SWIVEL_OK;
}
