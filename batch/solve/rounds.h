// SPDX-License-Identifier: MIT
//
// A job with streams goes in rounds, because limbs of one character often share cache lines. Round n is the nth run of
// blocks of each group, so one thread has the same characters of all groups.
#pragma once

#include "batch/solve/work.h"

namespace swivel {

std::uint32_t round_count(const Work& work);
// Solves rounds first ... end - 1 of a job on this thread.
void solve_rounds(const Work& work, std::uint32_t first, std::uint32_t end);

}  // namespace swivel
