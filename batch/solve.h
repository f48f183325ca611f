// SPDX-License-Identifier: MIT
//
// Solving runs of blocks, and cutting a crowd into chunks for threads.
#pragma once

#include "batch/crowd.h"
#include "simd/kernels.h"

namespace swivel {

// Solves blocks first_block ... first_block + block_count - 1 on this thread.
void solve_blocks(const swivel_crowd& crowd, const Kernels& kernels, std::uint32_t first_block,
                  std::uint32_t block_count);

// Solves all blocks, in chunks on the caller's oneTBB arena, or on this thread in a build without oneTBB.
void solve_all(const swivel_crowd& crowd, const Kernels& kernels);

}  // namespace swivel
