// SPDX-License-Identifier: MIT
//
// The checks of a job and of a choice.
#pragma once

#include "batch/crowd/crowd.h"

namespace swivel {

// Checks what swivel_solve() promises of a job whose members are all there: it can be solved, or is refused. blocks:
// the job's, or all.
swivel_status check_job(const swivel_crowd& crowd, const swivel_job& job, swivel_blocks blocks);

// A mask of the crowd's lanes; and one entry of priorities for each group with lanes of its own.
swivel_status check_mask(const swivel_crowd& crowd, const std::uint32_t* mask, std::uint32_t word_count);
swivel_status check_priorities(const swivel_crowd& crowd, const swivel_in* priorities);

// Whether results of a job, whose streams and pose are right, overlap each other or inputs that are not their own. For
// builds with SWIVEL_CHECK_USE.
swivel_status check_overlap(const swivel_crowd& crowd, const swivel_job& job, swivel_blocks blocks);

}  // namespace swivel
