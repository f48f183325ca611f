// SPDX-License-Identifier: MIT
//
// A job as the solver takes it, and the blocks of groups that it touches.
#pragma once

#include <algorithm>
#include <span>

#include "batch/crowd/crowd.h"
#include "batch/refusal/sized.h"
#include "simd/kernels.h"

namespace swivel {

// A swivel_job, checked.
struct Work {
    swivel_crowd& crowd;
    const Kernels& kernels;
    swivel_blocks blocks;
    const std::uint32_t* groups;    // bits of those that are named; null: all
    const std::uint32_t* mask;      // bits of the limbs to solve; null: all
    const swivel_streams* streams;  // of each group that is named; null: values are in rows
    bool exceeds_cache;             // the job's rows do not fit the caches
    StripMemory strip;              // of a workspace
    const swivel_pose* pose;        // of bodies; null: free limbs
    swivel_sample* sample = nullptr;
    void* sample_user = nullptr;
};

// The nth streams of a job, and their fields.
inline swivel_streams streams_at(const swivel_streams* streams, std::size_t n)
{
    return element(streams, n, swivel_default_streams());
}
inline std::span<const swivel_stream> fields_of(const swivel_streams& streams)
{
    return {streams.fields, streams.field_count};
}

// A validated pose, padded to the current size of the structure.
inline swivel_pose full_pose(const swivel_pose* given) { return element(given, 0, swivel_default_pose()); }
// The origin of the positions in a job's streams: the root, where it is doubles.
inline swivel_in origin_of(const swivel_pose& pose) { return pose.root_is_double ? pose.root_position : swivel_in{}; }
// Whether a pose asks for where all needed joints are.
inline bool gives_joints(const swivel_pose& pose) { return pose.joint_rotations.data || pose.joint_positions.data; }

inline bool is_named(const std::uint32_t* groups, std::uint32_t g) { return !groups || groups[g / 32] >> g % 32 & 1; }
// Whether a group's joints hang below a look that a job solves.
inline bool hangs_on_solved(const swivel_crowd& crowd, const std::uint32_t* groups, const Group& group)
{
    const GroupJoints& joints = group.plan.joints;
    if (joints.above == 0) return false;
    return is_named(groups, joints.above_group) || hangs_on_solved(crowd, groups, crowd.groups[joints.above_group]);
}

// Some of a group's blocks, counted within it.
struct GroupBlocks {
    std::uint32_t first, count;
};

// Calls take(group, its blocks, n) for each named group that has blocks in a range of the crowd's; n counts the named
// groups before it.
template <class Take>
void for_each_group(const swivel_crowd& crowd, const std::uint32_t* groups, swivel_blocks blocks, const Take& take)
{
    for (std::uint32_t g = 0, n = 0; g < crowd.group_count; ++g) {
        if (!is_named(groups, g)) continue;
        const Group& group = crowd.groups[g];
        const std::uint32_t first = std::max(blocks.first, group.first_block);
        const std::uint32_t end = std::min(blocks.first + blocks.count, group.first_block + group.block_count);
        if (first < end) take(group, GroupBlocks{first - group.first_block, end - first}, n);
        ++n;
    }
}

// Counts the blocks of the named groups in a range. Groups of bodies share their blocks, so these count once.
inline std::uint32_t block_count_of(const swivel_crowd& crowd, const std::uint32_t* groups, swivel_blocks blocks)
{
    if (crowd.joint_count > 0) return blocks.count;
    std::uint32_t count = 0;
    for_each_group(crowd, groups, blocks, [&](const Group&, GroupBlocks part, std::uint32_t) { count += part.count; });
    return count;
}

}  // namespace swivel
