// SPDX-License-Identifier: MIT
//
// The functions that a build for one instruction set gives. Plain arms have one for each set of features, whole limbs
// one that takes a list of stages. Nothing here knows lanes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/body_rows.h"
#include "simd/fields.h"
#include "simd/stages.h"

namespace swivel {

// Memory for the rows of some blocks, which whole limbs work in (strip_rows.h).
struct StripMemory {
    float* rows;
    std::uint32_t block_count;
    float* bodies = nullptr;            // as many blocks of bodies (body_rows.h)
    const swivel_pose* pose = nullptr;  // theirs
};

// A run of blocks that share their features and binding.
struct SolveRun {
    const float* input;  // input rows of the run's first block
    float* results;      // result rows of the same block
    std::uint32_t input_row_count, result_row_count;
    std::size_t limb_count;  // padding included, but gathered limbs may end within their block
    swivel_features features;
    std::uint32_t shoulder_order, wrist_order;  // of kEulerOrders
    const swivel_binding* binding;              // used with SWIVEL_JOINTS and kBody
    const std::uint16_t* first_row;             // of each field, among input or result rows
    bool exceeds_cache;                         // the job's rows do not fit the caches
    bool keeps_pose;                            // of limbs with bad input only the flags are written
    const std::uint32_t* mask;      // the crowd's chosen lanes, a bit for each; null: all. Others keep their results
    std::size_t first_lane;         // of the run, in the mask
    std::size_t first_padding;      // the first lane of the run that is padding, which whole limbs leave out
    const StageList* stages;        // of whole limbs
    StripMemory strip;              // the same
    const GroupPlan* plan;          // if the group is of bodies
    std::size_t body_block_floats;  // the same: from one block to the next in strip.bodies
    const swivel_region* region;    // with SWIVEL_WITH_REGION
    const HalfLine* half_line;      // used with SWIVEL_POLE_HALF_LINE
};

// Bits of the lanes of a slice that are chosen. limb: the slice's first, in the run. All bits are set if there is no
// mask.
inline constexpr std::uint32_t kEveryLane = ~0u;
[[gnu::always_inline]] inline std::uint32_t chosen_lanes(const SolveRun& run, std::size_t limb, std::size_t lane_count)
{
    if (!run.mask) return kEveryLane;
    if (limb >= run.first_padding) return 0;
    const std::size_t lane = run.first_lane + limb, left = run.first_padding - limb,
                      count = left < lane_count ? left : lane_count;
    return run.mask[lane / 32] >> lane % 32 & ((1u << count) - 1);
}

// Results of a run of blocks, to be packed into words of 16 bits.
enum class Packing : std::uint8_t { rotation, half, flags };
struct PackedValue {
    Packing how;
    std::uint16_t from, to;  // its first row of floats, and of words
};
struct PackRun {
    const float* results;  // result rows of the run's first block
    std::uint16_t* words;  // rows of words of the same block
    std::uint32_t block_count, result_row_count, word_row_count;
    const PackedValue* values;
    std::uint32_t value_count;
};

// The features that change the formula of plain arms, and their rows. They number its kernels.
inline constexpr swivel_features kFormulaFeatures = SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND;
static_assert(kFormulaFeatures == 7);

// Plain arms, and packing: simd/kernels/arm_kernels.cpp.
struct ArmKernels {
    void (*solve_arms[8])(const SolveRun& run);  // by the run's kFormulaFeatures
    void (*pack)(const PackRun& run);            // of any group
};

// How many arcs of swivels limits can leave: two for each line, and those of boxes and a region. core/allowed_arcs.h
// has as many.
inline constexpr std::size_t kMaxArcs = 2 * kLineLimitCount + 169;
// An arc of swivels: cos and sin of its ends.
struct ArcEnds {
    float from[2], to[2];
};

// Whole limbs: simd/kernels/limb_kernels.cpp.
struct LimbKernels {
    void (*solve_limbs)(const SolveRun& run);
    // For one limb of a run: stores its arcs and returns how many there are. Null but in the build for single limbs
    // (dispatch.h).
    std::uint32_t (*allowed_arcs)(const SolveRun& run, std::size_t limb, ArcEnds (&arcs)[kMaxArcs]);
};

// Bodies: simd/kernels/body_kernels.cpp.
struct BodyKernels {
    // Fills in the rows of all joints of a block from what the pose says of each.
    void (*forward)(const BodyPlan& plan, const BodyBlock& block);
    // Finds how a solved limb moves the joints that it turns and all below them (kMotionRow).
    void (*move)(const BodyBlock& block, const GroupJoints& joints);
    // These fill in a block's rows for a joint to be written (OutRow), where the limbs have moved it to.
    // - carry: any joint that moves, as a pose in the body's space has it.
    // - locate: a needed joint's rotation and position, in the body's space, from the root before its shift.
    void (*carry)(const BodyPlan& plan, const BodyBlock& block, const MovedJoint& joint);
    void (*locate)(const BodyPlan& plan, const BodyBlock& block, const BodyJoint& joint);
};

struct Kernels {
    const ArmKernels& arms;
    const LimbKernels& limbs;
    const BodyKernels& bodies;
};

}  // namespace swivel
