// SPDX-License-Identifier: MIT
//
// The checks of arguments that the files of entry points share. Each fails with a line, or gives SWIVEL_OK. And what is
// recorded of suspicious use, for swivel_explain().
#pragma once

#include <cstddef>

#include "batch/crowd/crowd.h"
#include "simd/dispatch.h"

namespace swivel {

struct Work;

// A range of limbs of a group.
swivel_status check(const swivel_crowd& crowd, std::uint32_t group, std::uint32_t first, std::uint32_t limb_count);

// A group of limbs; and one whose limbs' poses are known, because they are free or because the group keeps records.
// call: the entry point, named in the line.
swivel_status check_limbs(const swivel_crowd& crowd, std::uint32_t group, const char* call);
swivel_status check_kept(const swivel_crowd& crowd, std::uint32_t group, const char* call);

// A caller's array for some limbs, named in the line.
swivel_status check_stride(std::uint32_t group, const char* name, std::uint32_t limb_count, const void* data,
                           std::size_t stride, std::size_t value_bytes, bool may_repeat);

// A number that is a field's; and a field that the group has and, if input, that goes into it.
swivel_status check_field(swivel_field field);
swivel_status check_field(const swivel_crowd& crowd, std::uint32_t group, swivel_field field, bool input);

// The caller's values of a field, to be read if they are input: components of component_bytes each.
swivel_status check_values(const swivel_crowd& crowd, std::uint32_t group, swivel_field field, std::uint32_t limb_count,
                           const void* data, std::size_t stride, bool input,
                           std::size_t component_bytes = sizeof(float));

// The kernels to solve with; or null, with the reason in status and last_error().
const Isa* usable_isa(swivel_status& status);

// job_check.cpp: checks what swivel_solve() promises of a job whose members are all there: it can be solved, or is
// refused. blocks: the job's, or all.
swivel_status check_job(const swivel_crowd& crowd, const swivel_job& job, swivel_blocks blocks);

// A mask of the crowd's lanes; and one entry of priorities for each group with lanes of its own.
swivel_status check_mask(const swivel_crowd& crowd, const std::uint32_t* mask, std::uint32_t word_count);
swivel_status check_priorities(const swivel_crowd& crowd, const swivel_in* priorities);

// overlap.cpp: whether results of a job, whose streams and pose are right, overlap each other or inputs that are not
// their own. For builds with SWIVEL_CHECK_USE.
swivel_status check_overlap(const swivel_crowd& crowd, const swivel_job& job, swivel_blocks blocks);

// pose_check.cpp: checks what swivel_solve() promises of a pose, which may be null, for the groups that a job names;
// and what does not depend on groups.
swivel_status check_pose(const swivel_crowd& crowd, const std::uint32_t* groups, const swivel_pose* given);
swivel_status check_pose(const swivel_crowd& crowd, const swivel_pose* given);

// doubts.cpp: records in the crowd, before a solve of poses, whether each frame resets all bodies, whether the time
// step is odd, and what the pose has.
void note_doubts(const Work& work);

}  // namespace swivel
