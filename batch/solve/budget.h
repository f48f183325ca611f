// SPDX-License-Identifier: MIT
//
// Chooses the blocks that are solved within a budget. Blocks gather urgency while they wait, and the most urgent are
// picked.
#pragma once

#include "batch/crowd/crowd.h"

namespace swivel {

// Does what swivel_choose() promises; arguments are already checked: an entry of priorities for each group, words for
// every block, urgency or null. Returns how many limbs were picked.
//
// The magnitude of a block's urgency is what it has gathered. The sign says whether the block is wanted now, so that no
// second array is needed: above 0 if it is, else negative or 0.
std::uint32_t choose(const swivel_crowd& crowd, const swivel_in* priorities, float* urgency, std::uint32_t max_blocks,
                     std::uint32_t* words);

}  // namespace swivel
