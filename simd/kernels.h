// SPDX-License-Identifier: MIT
//
// The functions that a build for one instruction set gives: one for each set of features. Nothing here knows lanes.
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

// The same for crowds of whole limbs (simd/limb_run.h), whose features the kernel is told.
struct LimbRun {
    const float* input;
    float* results;
    std::uint32_t block_count, input_row_count, result_row_count;
    std::uint32_t features;
    swivel_euler_order shoulder_order, wrist_order;
    const swivel_binding* binding;
    const std::uint16_t* first_row;  // of each field, among input or result rows
};

// Results of a run of blocks, to be packed into the words of a compact crowd.
struct PackRun {
    const float* results;  // result rows of the run's first block
    std::uint16_t* words;  // compact rows of the same block
    std::uint32_t block_count;
    bool prefetch;  // words go to memory: call for those of later blocks
};

// Of plain arms: simd/arm_kernels.cpp.
struct ArmKernels {
    // By the features that change the formula: SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND.
    void (*solve[8])(const SolveRun& run);
    // By the features that change the result rows: (SWIVEL_JOINTS | SWIVEL_WITH_HAND) / SWIVEL_JOINTS.
    void (*pack[4])(const PackRun& run);
};

// Of whole limbs: simd/limb_kernels.cpp.
struct LimbKernels {
    void (*solve)(const LimbRun& run);
    // For one limb of a run: stores up to capacity arcs and returns how many there are. Only in the scalar build.
    std::uint32_t (*allowed_arcs)(const LimbRun& run, std::size_t limb, swivel_arc* arcs, std::uint32_t capacity);
};

struct Kernels {
    const ArmKernels& arms;
    const LimbKernels& limbs;
};

}  // namespace swivel
