// SPDX-License-Identifier: MIT
//
// The C entry points that solve limbs and choose them: check a job, mark what it chooses, solve that.
#include <algorithm>
#include <bit>

#include "batch/budget.h"
#include "batch/check.h"
#include "batch/frame.h"
#include "batch/lane_mask.h"
#include "batch/sized.h"
#include "batch/solve.h"
#include "batch/status.h"
#include "batch/unpack.h"
#include "simd/rows.h"

using namespace swivel;

namespace {

swivel_status check_mask(const swivel_crowd& crowd, const std::uint32_t* mask, std::uint32_t word_count)
{
    if (!mask) return fail(SWIVEL_INVALID_ARGUMENT, "the mask is null");
    if (const std::uint32_t needed = mask_word_count(crowd.block_count); word_count != needed)
        return fail(SWIVEL_INVALID_ARGUMENT, "a mask of %u words; this crowd of %u blocks has %u, a bit for each lane",
                    word_count, crowd.block_count, needed);
    return SWIVEL_OK;
}

swivel_status check_priorities(const swivel_crowd& crowd, const swivel_in* priorities)
{
    if (!crowd.urgency)
        return fail(SWIVEL_INVALID_ARGUMENT, "this crowd remembers no urgency; create it with SWIVEL_BUDGET");
    if (!priorities)
        return fail(SWIVEL_INVALID_ARGUMENT, "priorities are missing; give one for each of this crowd's %u groups",
                    crowd.group_count);
    swivel_status status = SWIVEL_OK;
    for (std::uint32_t g = 0; g < crowd.group_count && status == SWIVEL_OK; ++g)
        status = check_stride(g, "priority", priorities[g].data, priorities[g].stride, sizeof(float), true);
    return status;
}

// A function of its own, so that the copy of a frame takes no stack while limbs are solved.
[[gnu::noinline]] swivel_status check_frame(const swivel_crowd& crowd, std::uint32_t g, const swivel_frame* frames)
{
    swivel_frame filled;
    const swivel_frame& frame = frame_at(frames, g, filled);
    swivel_status status = SWIVEL_OK;
    const auto check_member = [&](Field field, const auto& values) {
        if (!values.data || status != SWIVEL_OK) return;
        if (is_packed(crowd, field))
            status = fail(SWIVEL_INVALID_ARGUMENT,
                          "group %u, %s: a frame does not take results out of a crowd with SWIVEL_COMPACT; use "
                          "swivel_read() or swivel_compact_rows()",
                          g, name_of(field));
        else
            status = check_values(crowd, g, field, values.data, values.stride, is_input(field),
                                  frame.origin.data && is_position(field) ? sizeof(double) : sizeof(float));
    };
    if (frame.origin.data)
        status = check_stride(g, "origin", frame.origin.data, frame.origin.stride, 3 * sizeof(double), true);
    for (const FrameInput& input : kFrameInputs) check_member(input.field, frame.*input.member);
    for (const FrameOutput& output : kFrameOutputs) check_member(output.field, frame.*output.member);
    return status;
}

// Checks the frames of the groups that the blocks touch, and not those of other groups.
swivel_status check_frames(const swivel_crowd& crowd, const swivel_frame* frames, swivel_blocks blocks)
{
    swivel_status status = check_size<swivel_frame>("the first frame", size_of(frames));
    for_each_group(crowd, blocks, [&](std::uint32_t g, std::uint32_t, std::uint32_t) {
        if (status == SWIVEL_OK) status = check_element("frame", frames, g);
        if (status == SWIVEL_OK) status = check_frame(crowd, g, frames);
    });
    return status;
}

swivel_status check_choice(const swivel_crowd& crowd, const swivel_job& job)
{
    if (job.most_blocks > 0 && !job.priorities)
        return fail(SWIVEL_INVALID_ARGUMENT,
                    "most_blocks goes with priorities; give one for each of this crowd's %u groups", crowd.group_count);
    if ((job.mask != nullptr) + (job.limbs != nullptr) + (job.priorities != nullptr) > 1)
        return fail(SWIVEL_INVALID_ARGUMENT,
                    "a job chooses limbs by a mask, by a list or by priorities; give one of them");
    if ((job.limbs || job.priorities) && (job.blocks || job.on_this_thread))
        return fail(SWIVEL_INVALID_ARGUMENT,
                    "a job with %s is for the whole crowd and cannot be one of several; leave %s out, or give a mask",
                    job.limbs ? "a list of limbs" : "priorities", job.blocks ? "blocks" : "on_this_thread");
    if (job.limbs && !job.limbs->indices && job.limbs->count > 0)
        return fail(SWIVEL_INVALID_ARGUMENT, "a list of %u limbs is null", job.limbs->count);
    if (job.mask || job.mask_word_count > 0) return check_mask(crowd, job.mask, job.mask_word_count);
    return job.priorities ? check_priorities(crowd, job.priorities) : SWIVEL_OK;
}

// Finds the group that a limb index is in. It keeps the last group, because lists often stay in one.
struct Finder {
    const swivel_crowd& crowd;
    const Group* at = crowd.groups;

    bool is_limb(std::uint32_t limb)
    {
        const std::uint32_t block = limb / SWIVEL_LANES;
        if (block >= crowd.block_count) return false;
        if (block < at->first_block || block - at->first_block >= at->block_count) {
            const auto starts_after = [](std::uint32_t b, const Group& group) { return b < group.first_block; };
            at = std::upper_bound(crowd.groups, crowd.groups + crowd.group_count, block, starts_after) - 1;
        }
        return limb - at->first_block * SWIVEL_LANES < at->limb_count;
    }
};

void clear(std::uint32_t* words, const std::uint32_t* limbs, std::uint32_t limb_count)
{
    for (std::uint32_t n = 0; n < limb_count; ++n) words[limbs[n] / 32] = 0;
}

// Marks a list's limbs in the crowd's own mask; none if one of them is no limb.
swivel_status mark(const swivel_crowd& crowd, const std::uint32_t* limbs, std::uint32_t limb_count)
{
    Finder finder{crowd};
    for (std::uint32_t n = 0; n < limb_count; ++n) {
        if (!finder.is_limb(limbs[n])) {
            clear(crowd.chosen, limbs, n);
            return fail(SWIVEL_INVALID_ARGUMENT, "entry %u of the list: %u is no limb of this crowd, %s", n, limbs[n],
                        limbs[n] / SWIVEL_LANES < crowd.block_count ? "but padding" : "but past its end");
        }
        crowd.chosen[limbs[n] / 32] |= 1u << limbs[n] % 32;
    }
    return SWIVEL_OK;
}

std::uint32_t count_limbs(const swivel_crowd& crowd, const std::uint32_t* mask, swivel_blocks blocks)
{
    std::uint32_t limb_count = 0;
    for_each_group(crowd, blocks, [&](std::uint32_t g, std::uint32_t first, std::uint32_t count) {
        const Group& group = crowd.groups[g];
        const std::uint32_t last = first + count - 1;
        if (!mask) {
            limb_count += (count - 1) * SWIVEL_LANES + limb_count_of(group, last);
            return;
        }
        for (std::uint32_t block = first; block <= last; ++block)
            limb_count +=
                static_cast<std::uint32_t>(std::popcount(lanes_of_limbs(group, block) & lanes_of(mask, block)));
    });
    return limb_count;
}

}  // namespace

swivel_status swivel_solve(swivel_crowd* crowd, const swivel_job* given)
{
    if (!crowd) return fail(SWIVEL_INVALID_ARGUMENT, "swivel_solve: crowd is null");
    if (!given) {
        const swivel_job everything = swivel_default_job();
        return swivel_solve(crowd, &everything);
    }
    swivel_status status = check_size<swivel_job>("job", size_of(given));
    if (status != SWIVEL_OK) return status;
    swivel_job filled;
    const swivel_job& job = whole(given, swivel_default_job, filled);
    if (job.blocks) status = check_blocks(*crowd, *job.blocks);
    const swivel_blocks blocks = job.blocks ? *job.blocks : swivel_blocks{0, crowd->block_count};
    if (status == SWIVEL_OK) status = check_choice(*crowd, job);
    if (status == SWIVEL_OK && job.frames) status = check_frames(*crowd, job.frames, blocks);
    if (status != SWIVEL_OK) return status;
    const Isa* const isa = usable_isa(status);
    if (!isa) return status;
    if (job.limbs) status = mark(*crowd, job.limbs->indices, job.limbs->count);
    if (status != SWIVEL_OK) return status;
    if (job.priorities) choose(*crowd, job.priorities, job.most_blocks, crowd->chosen);

    const Work work{job.limbs || job.priorities ? crowd->chosen : job.mask, job.frames,
                    is_from_memory(*crowd, blocks.count)};
    if (job.on_this_thread)
        solve_here(*crowd, isa->kernels, work, blocks);
    else
        solve_in_chunks(*crowd, isa->kernels, work, blocks);
    if (job.solved_count) *job.solved_count = count_limbs(*crowd, work.mask, blocks);
    if (job.limbs) clear(crowd->chosen, job.limbs->indices, job.limbs->count);
    if (job.priorities) std::fill_n(crowd->chosen, mask_word_count(crowd->block_count), 0u);
    return SWIVEL_OK;
}

swivel_status swivel_choose(swivel_crowd* crowd, const swivel_in* priorities, uint32_t most_blocks, uint32_t* mask,
                            uint32_t word_count, uint32_t* chosen_count)
{
    if (!crowd) return fail(SWIVEL_INVALID_ARGUMENT, "swivel_choose: crowd is null");
    swivel_status status = check_priorities(*crowd, priorities);
    if (status == SWIVEL_OK) status = check_mask(*crowd, mask, word_count);
    if (status != SWIVEL_OK) return status;
    const uint32_t picked = choose(*crowd, priorities, most_blocks, mask);
    if (chosen_count) *chosen_count = picked;
    return SWIVEL_OK;
}
