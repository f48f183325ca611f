// SPDX-License-Identifier: MIT
//
// What a build for one instruction set gives: a function for each set of features. No lanes in sight.
#pragma once

#include <cstddef>
#include <cstdint>

#include "batch/swivel.h"

namespace swivel {

// A run of blocks that share one binding.
struct SolveRun {
    const float* input;  // input rows of the run's first block
    float* results;      // result rows of the same block
    std::uint32_t block_count;
    float pole_is_point;  // 1, or 0 for poles that are directions; used with SWIVEL_WORLD
    const swivel_binding* binding;
    bool prefetch;  // rows come from memory: call for those of later blocks
};

struct Kernels {
    // By the features that change the formula: SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND.
    void (*solve[8])(const SolveRun& run);
};

}  // namespace swivel
