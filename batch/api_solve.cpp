// SPDX-License-Identifier: MIT
//
// The C entry points that solve limbs and choose them: check a job, mark what it chooses, solve that.
#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>

#include "batch/budget.h"
#include "batch/check.h"
#include "batch/frame.h"
#include "batch/lane_mask.h"
#include "batch/pose.h"
#include "batch/sized.h"
#include "batch/solve.h"
#include "batch/status.h"
#include "batch/use.h"
#include "batch/workspace.h"
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
    if (!priorities)
        return fail(SWIVEL_INVALID_ARGUMENT, "priorities are missing; give one for each of this crowd's %u groups",
                    lane_group_count(crowd));
    swivel_status status = SWIVEL_OK;
    for (std::uint32_t g = 0; g < lane_group_count(crowd) && status == SWIVEL_OK; ++g)
        status = check_stride(g, "priority", crowd.groups[g].limb_count, priorities[g].data, priorities[g].stride,
                              sizeof(float), true);
    return status;
}

swivel_status check_groups(const swivel_crowd& crowd, const swivel_job& job)
{
    if (!job.groups && job.group_word_count > 0) return fail(SWIVEL_INVALID_ARGUMENT, "the job's groups are null");
    const std::uint32_t needed = group_word_count(crowd.group_count);
    if (job.groups && job.group_word_count != needed)
        return fail(SWIVEL_INVALID_ARGUMENT, "%u words of groups; this crowd of %u groups has %u, a bit for each",
                    job.group_word_count, crowd.group_count, needed);
    return SWIVEL_OK;
}
// What limbs are linked to is solved with them.
swivel_status check_links(const swivel_crowd& crowd, const swivel_job& job)
{
    for (std::uint32_t g = 0; job.groups && g < crowd.group_count; ++g) {
        if (!(crowd.groups[g].features & SWIVEL_WITH_LINK)) continue;
        const BodyLimb& limb = crowd.groups[g].limb;
        if (const bool is_named_here = is_named(job.groups, g);
            is_named_here != is_named(job.groups, limb.linked_group) && (is_named_here || limb.holds_prop))
            return fail(SWIVEL_INVALID_ARGUMENT, "the job names group %u, but not group %u; they are linked, name both",
                        is_named_here ? g : limb.linked_group, is_named_here ? limb.linked_group : g);
    }
    return SWIVEL_OK;
}

swivel_status check_sampling(const swivel_crowd& crowd, const swivel_job& job)
{
    if (!job.probes_only) return SWIVEL_OK;
    if (job.sample)
        return fail(SWIVEL_INVALID_ARGUMENT,
                    "the job has a sample function, but probes_only does not call it; give one "
                    "of them");
    if (job.probes_only && job.priorities)
        return fail(
            SWIVEL_INVALID_ARGUMENT,
            "the job is for probes_only and has priorities, so the solve would choose other bodies; choose them "
            "by swivel_choose(), and give both jobs its mask");
    for (std::uint32_t g = 0; g < crowd.group_count; ++g)
        if (crowd.groups[g].features & SWIVEL_WITH_GROUND && is_named(job.groups, g)) return SWIVEL_OK;
    return fail(SWIVEL_INVALID_ARGUMENT,
                "the job is for probes_only, but names no group that is SWIVEL_WITH_GROUND; leave it out");
}

// Whether the numbers of a frame's positions are what they are read as. The frame has its origin.
swivel_status check_positions(std::uint32_t g, const swivel_frame& frame, const swivel_pose* pose)
{
    if (frame.positions > SWIVEL_DOUBLES)
        return fail(SWIVEL_INVALID_ARGUMENT, "frame of group %u: positions is %u; it is a swivel_numbers, 0 to 2", g,
                    frame.positions);
    const bool is_double = frame.origin.data != nullptr;
    if (frame.positions == SWIVEL_NUMBERS_UNSAID || is_double == (frame.positions == SWIVEL_DOUBLES)) return SWIVEL_OK;
    for (const swivel_frame_field& each : fields_of(frame))
        if (each.data && is_input(each.field) && is_position(each.field))
            return fail(SWIVEL_INVALID_ARGUMENT, "frame of group %u: %s is in %s, but %s; %s", g, name_of(each.field),
                        is_double ? "floats" : "doubles",
                        !is_double ? "floats are read without an origin"
                        : pose     ? "the pose has root_is_double"
                                   : "the frame has an origin",
                        is_double ? "give doubles"
                        : pose    ? "give floats, or a root in doubles and root_is_double"
                                  : "give floats, or an origin");
    return SWIVEL_OK;
}

swivel_status check_frame(const swivel_crowd& crowd, std::uint32_t g, swivel_frame frame, const swivel_pose* pose)
{
    const swivel_in origin = pose ? origin_of(full_pose(pose)) : frame.origin;
    if (frame.origin.data && (frame.origin.data != origin.data || frame.origin.stride != origin.stride))
        return fail(SWIVEL_INVALID_ARGUMENT,
                    "frame of group %u: a body's origin is its root in doubles; give that, or leave origin out", g);
    frame.origin = origin;
    if (!frame.fields && frame.field_count > 0)
        return fail(SWIVEL_INVALID_ARGUMENT, "frame of group %u: its %u fields are null", g, frame.field_count);
    swivel_status status = check_positions(g, frame, pose);
    if (status == SWIVEL_OK && frame.origin.data)
        status = check_stride(g, "origin", 1, frame.origin.data, frame.origin.stride, 3 * sizeof(double), true);
    std::uint64_t seen = 0;
    static_assert(kFieldCount <= 64, "a bit for each");
    for (const swivel_frame_field& each : fields_of(frame)) {
        if (status == SWIVEL_OK) status = check_field(each.field);
        if (status != SWIVEL_OK) return status;
        if (!each.data) continue;
        const std::uint64_t bit = std::uint64_t{1} << index_of(each.field);
        if (seen & bit)
            return fail(SWIVEL_INVALID_ARGUMENT, "frame of group %u lists %s twice; list it once", g,
                        name_of(each.field));
        seen |= bit;
        const bool is_double = frame.origin.data && is_position(each.field);
        status = check_values(crowd, g, each.field, 1, each.data, each.stride, is_input(each.field),
                              is_double ? sizeof(double) : sizeof(float));
    }
    return status;
}

// Checks the frames of the groups that the blocks touch, and not those of other groups.
swivel_status check_frames(const swivel_crowd& crowd, const swivel_job& job, swivel_blocks blocks)
{
    swivel_status status = check_size<swivel_frame>("the first frame", size_of(job.frames));
    for_each_group(crowd, job.groups, blocks, [&](const Group& group, GroupBlocks, std::uint32_t n) {
        if (status == SWIVEL_OK) status = check_element("frame", job.frames, n);
        const auto g = static_cast<std::uint32_t>(&group - crowd.groups);
        if (status == SWIVEL_OK) status = check_frame(crowd, g, frame_at(job.frames, n), job.pose);
    });
    if (kChecksUse && status == SWIVEL_OK) status = check_overlap(crowd, job, blocks);
    return status;
}

swivel_status check_choice(const swivel_crowd& crowd, const swivel_job& job)
{
    if ((job.most_blocks > 0 || job.urgency) && !job.priorities)
        return fail(SWIVEL_INVALID_ARGUMENT, "%s priorities; give one for each of this crowd's %u groups",
                    job.urgency ? "urgency goes with" : "most_blocks goes with", lane_group_count(crowd));
    if ((job.mask != nullptr) + (job.limbs != nullptr) + (job.priorities != nullptr) > 1)
        return fail(SWIVEL_INVALID_ARGUMENT,
                    "a job chooses limbs by a mask, by a list or by priorities; give one of them");
    if ((job.limbs || job.priorities) && (job.blocks || job.on_this_thread))
        return fail(SWIVEL_INVALID_ARGUMENT,
                    "a job with %s is for the whole crowd and cannot be one of several; leave %s out, or give a mask",
                    job.limbs ? "a list of limbs" : "priorities", job.blocks ? "blocks" : "on_this_thread");
    if (job.priorities && job.groups)
        return fail(SWIVEL_INVALID_ARGUMENT,
                    "a job with priorities is for the whole crowd; leave groups out, and give those that are not "
                    "wanted priority 0");
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

// The first body that a job solves; none: all are left out.
std::optional<std::uint32_t> first_body(const Work& work)
{
    if (!work.mask && work.blocks.count > 0) return work.blocks.first * SWIVEL_LANES;
    for (std::uint32_t block = work.blocks.first; block < work.blocks.first + work.blocks.count; ++block)
        if (const LaneMask bits = chosen_limbs(work.crowd.groups[0], block, work.mask))
            return block * SWIVEL_LANES + static_cast<std::uint32_t>(std::countr_zero(bits));
    return std::nullopt;
}
// Keeps what explanations doubt of a solve: resets of all bodies, and the time of its pose.
void note_solve(swivel_crowd& crowd, const Work& work)
{
    const std::uint32_t reset = crowd.reset_limbs.exchange(0, std::memory_order_relaxed);
    if (reset >= crowd.groups[0].limb_count)
        crowd.solves_anew.fetch_add(1, std::memory_order_relaxed);
    else
        crowd.solves_anew.store(0, std::memory_order_relaxed);
    const swivel_pose pose = full_pose(work.pose);
    const std::optional<std::uint32_t> body = first_body(work);
    if (!body || !pose.time.data) return crowd.doubted_time.store(kNoDoubt, std::memory_order_relaxed);
    float time;
    std::memcpy(&time, static_cast<const char*>(pose.time.data) + *body * pose.time.stride, sizeof time);
    const bool is_in_place = !pose.results.data || pose.results.data == pose.rotations.data;
    const bool is_doubted = time > 1 || (time == 0 && is_in_place);
    crowd.doubted_time.store(is_doubted ? time : kNoDoubt, std::memory_order_relaxed);
}

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
    if (job.blocks) status = check_blocks(*crowd, *job.blocks);
    const swivel_blocks blocks = job.blocks ? *job.blocks : swivel_blocks{0, crowd->block_count};
    if (status == SWIVEL_OK) status = check_groups(*crowd, job);
    if (status == SWIVEL_OK) status = check_choice(*crowd, job);
    if (status == SWIVEL_OK) status = check_pose(*crowd, job.groups, job.pose);
    if (status == SWIVEL_OK) status = check_links(*crowd, job);
    if (status == SWIVEL_OK) status = check_sampling(*crowd, job);
    if (status == SWIVEL_OK && job.frames) status = check_frames(*crowd, job, blocks);
    if (status != SWIVEL_OK) return status;
    const Isa* const isa = usable_isa(status);
    if (!isa) return status;
    const Workspace workspace(*crowd, job.workspace);
    status = workspace.status;
    if (status == SWIVEL_OK && job.limbs) status = mark(*crowd, job.limbs->indices, job.limbs->count);
    if (status != SWIVEL_OK) return status;
    if (job.priorities) choose(*crowd, job.priorities, job.urgency, job.most_blocks, crowd->chosen);

    const Work work{*crowd,
                    isa->kernels,
                    blocks,
                    job.groups,
                    job.limbs || job.priorities ? crowd->chosen : job.mask,
                    job.frames,
                    is_from_memory(*crowd, block_count_of(*crowd, job.groups, blocks)),
                    workspace.strip,
                    job.pose,
                    job.probes_only != 0,
                    job.sample,
                    job.sample_user};
    if (work.pose && !work.probes_only) note_solve(*crowd, work);
    if (job.on_this_thread)
        solve_here(work);
    else
        solve_in_chunks(work);
    if (job.solved_count) *job.solved_count = count_limbs(work);
    if (job.limbs) clear(crowd->chosen, job.limbs->indices, job.limbs->count);
    if (job.priorities) std::fill_n(crowd->chosen, mask_word_count(crowd->block_count), 0u);
    return SWIVEL_OK;
}

size_t swivel_workspace_bytes(const swivel_crowd* crowd)
{
    return crowd ? workspace_floats(crowd->strip_blocks, crowd->body_row_count) * sizeof(float) : 0;
}

swivel_status swivel_choose(swivel_crowd* crowd, const swivel_in* priorities, float* urgency, uint32_t most_blocks,
                            uint32_t* mask, uint32_t word_count, uint32_t* chosen_count)
{
    const Use use(crowd, Sharing::alone);
    swivel_status status = use.status;
    if (status == SWIVEL_OK) status = check_priorities(*crowd, priorities);
    if (status == SWIVEL_OK) status = check_mask(*crowd, mask, word_count);
    if (status != SWIVEL_OK) return status;
    const uint32_t picked = choose(*crowd, priorities, urgency, most_blocks, mask);
    if (chosen_count) *chosen_count = picked;
    return SWIVEL_OK;
}
