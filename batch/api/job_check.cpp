// SPDX-License-Identifier: MIT
#include <cstdint>

#include "batch/api/check.h"
#include "batch/api/use.h"
#include "batch/refusal/sized.h"
#include "batch/refusal/status.h"
#include "batch/solve/work.h"
#include "simd/rows.h"

namespace swivel {

swivel_status check_mask(const swivel_crowd& crowd, const std::uint32_t* mask, std::uint32_t word_count)
{
    if (!mask) return refuse("the mask is null");
    if (const std::uint32_t needed = mask_word_count(crowd.block_count); word_count != needed)
        return refuse("a mask of %u words; this crowd of %u blocks has %u, a bit for each lane", word_count,
                      crowd.block_count, needed);
    return SWIVEL_OK;
}

swivel_status check_priorities(const swivel_crowd& crowd, const swivel_in* priorities)
{
    if (!priorities)
        return refuse("priorities are missing; give one for each of this crowd's %u groups", lane_group_count(crowd));
    swivel_status status = SWIVEL_OK;
    for (std::uint32_t g = 0; g < lane_group_count(crowd) && status == SWIVEL_OK; ++g)
        status = check_stride(g, "priority", crowd.groups[g].limb_count, priorities[g].data, priorities[g].stride,
                              sizeof(float), true);
    return status;
}

namespace {

swivel_status check_groups(const swivel_crowd& crowd, const swivel_job& job)
{
    if (!job.groups && job.group_word_count > 0) return refuse("the job's groups are null");
    const std::uint32_t needed = group_word_count(crowd.group_count);
    if (job.groups && job.group_word_count != needed)
        return refuse("%u words of groups; this crowd of %u groups has %u, a bit for each", job.group_word_count,
                      crowd.group_count, needed);
    return SWIVEL_OK;
}
// Limbs are solved together with what they are linked to.
swivel_status check_links(const swivel_crowd& crowd, const swivel_job& job)
{
    for (std::uint32_t g = 0; job.groups && g < crowd.group_count; ++g) {
        if (!(crowd.groups[g].features & SWIVEL_WITH_LINK)) continue;
        const LinkPlan& link = crowd.groups[g].plan.limb.link;
        if (const bool is_named_here = is_named(job.groups, g);
            is_named_here != is_named(job.groups, link.group) && (is_named_here || link.is_prop))
            return refuse("the job names group %u, but not group %u; they are linked, name both",
                          is_named_here ? g : link.group, is_named_here ? link.group : g);
    }
    return SWIVEL_OK;
}

// Whether the numbers of a group's positions are what they are read as. The streams have their origin.
swivel_status check_positions(std::uint32_t g, const swivel_streams& streams, const swivel_pose* pose)
{
    if (streams.positions > SWIVEL_DOUBLES)
        return refuse("streams of group %u: positions is %u; it is a swivel_numbers, 0 to 2", g, streams.positions);
    const bool is_double = streams.origin.data != nullptr;
    if (streams.positions == SWIVEL_NUMBERS_UNSPECIFIED || is_double == (streams.positions == SWIVEL_DOUBLES))
        return SWIVEL_OK;
    for (const swivel_stream& each : fields_of(streams))
        if (each.data && is_input(each.field) && is_position(each.field))
            return refuse("streams of group %u: %s is in %s, but %s; %s", g, name_of(each.field),
                          is_double ? "floats" : "doubles",
                          !is_double ? "floats are read without an origin"
                          : pose     ? "the pose has root_is_double"
                                     : "the streams have an origin",
                          is_double ? "give doubles"
                          : pose    ? "give floats, or a root in doubles and root_is_double"
                                    : "give floats, or an origin");
    return SWIVEL_OK;
}

swivel_status check_streams(const swivel_crowd& crowd, std::uint32_t g, swivel_streams streams, const swivel_pose* pose)
{
    const swivel_in origin = pose ? origin_of(full_pose(pose)) : streams.origin;
    if (streams.origin.data && (streams.origin.data != origin.data || streams.origin.stride != origin.stride))
        return refuse("streams of group %u: a body's origin is its root in doubles; give that, or leave origin out", g);
    streams.origin = origin;
    if (!streams.fields && streams.field_count > 0)
        return refuse("streams of group %u: its %u fields are null", g, streams.field_count);
    swivel_status status = check_positions(g, streams, pose);
    if (status == SWIVEL_OK && streams.origin.data)
        status = check_stride(g, "origin", 1, streams.origin.data, streams.origin.stride, 3 * sizeof(double), true);
    std::uint64_t seen = 0;
    static_assert(kFieldCount <= 64, "a bit for each");
    for (const swivel_stream& each : fields_of(streams)) {
        if (status == SWIVEL_OK) status = check_field(each.field);
        if (status != SWIVEL_OK) return status;
        if (!each.data) continue;
        const std::uint64_t bit = std::uint64_t{1} << index_of(each.field);
        if (seen & bit) return refuse("streams of group %u list %s twice; list it once", g, name_of(each.field));
        seen |= bit;
        const bool is_double = streams.origin.data && is_position(each.field);
        status = check_values(crowd, g, each.field, 1, each.data, each.stride, is_input(each.field),
                              is_double ? sizeof(double) : sizeof(float));
    }
    return status;
}

// Checks the streams of the groups that the blocks touch, and not those of other groups.
swivel_status check_all_streams(const swivel_crowd& crowd, const swivel_job& job, swivel_blocks blocks)
{
    swivel_status status = check_size<swivel_streams>("the first streams", size_of(job.streams));
    for_each_group(crowd, job.groups, blocks, [&](const Group& group, GroupBlocks, std::uint32_t n) {
        if (status == SWIVEL_OK) status = check_element("streams", job.streams, n);
        const auto g = static_cast<std::uint32_t>(&group - crowd.groups);
        if (status == SWIVEL_OK) status = check_streams(crowd, g, streams_at(job.streams, n), job.pose);
    });
    return status;
}

}  // namespace

swivel_status check_job(const swivel_crowd& crowd, const swivel_job& job, swivel_blocks blocks)
{
    if (blocks.first > crowd.block_count || blocks.count > crowd.block_count - blocks.first)
        return refuse("%u blocks from block %u on do not all exist; this crowd has %u", blocks.count, blocks.first,
                      crowd.block_count);
    swivel_status status = check_groups(crowd, job);
    if (status == SWIVEL_OK && (job.mask || job.mask_word_count > 0))
        status = check_mask(crowd, job.mask, job.mask_word_count);
    if (status == SWIVEL_OK) status = check_pose(crowd, job.groups, job.pose);
    if (status == SWIVEL_OK) status = check_links(crowd, job);
    if (status == SWIVEL_OK && job.streams) status = check_all_streams(crowd, job, blocks);
    if (kChecksUse && status == SWIVEL_OK) status = check_overlap(crowd, job, blocks);
    return status;
}

}  // namespace swivel
