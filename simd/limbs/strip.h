// SPDX-License-Identifier: MIT
//
// A strip: up to eight blocks of a run, which go through the stages together. A stage leaves what it finds for later
// ones in rows of the strip, which stay in the cache of level 1.
#pragma once

#include "simd/slice.h"
#include "simd/stages.h"
#include "simd/strip_rows.h"

namespace swivel::inline SWIVEL_ISA {

static_assert(kMaxLines == kMaxLimitLines && kMaxBoxes == kMaxLimitBoxes);

struct Strip {
    const SolveRun& run;
    const Binding& bind;
    float* const rows;  // of its blocks
    std::uint32_t block_count = 0;
    std::uint32_t block[kStripBlocks] = {};   // of the run
    std::uint32_t chosen[kStripBlocks] = {};  // bits of its lanes that are solved; others may hold anything
    std::uint32_t good[kStripBlocks] =
        {};  // bits of the chosen lanes whose inputs are valid, as far as stages have seen

    // The floats of one lane of its blocks.
    float* lane(std::uint32_t n) const { return rows + n / kLanes * kStripBlockFloats + n % kLanes; }
    const float* input(std::uint32_t n) const
    {
        return run.input + row_offset(std::size_t{block[n / kLanes]} * kLanes + n % kLanes, run.input_row_count, 0);
    }
};

// A slice of a strip. Knows: the features that are constants of the stage, and Has: which of them the group has.
template <class Number, swivel_features Knows, swivel_features Has>
struct StripSlice {
    using T = Number;
    static constexpr std::uint32_t kEvery = (1u << lane_count<T>)-1;

    Strip& strip;
    Rows<T, kRuntimeFeatures> io;  // the group's own rows
    RowView<T> rows;               // the strip's
    RowView<T> body;               // the body's; of free limbs the strip's, which no stage reads as these
    std::uint32_t block, lane;

    // The group's features, for formulas. The bits of those that the stage knows are constants.
    SWIVEL_ALWAYS_INLINE swivel_features features() const { return (strip.run.features & ~Knows) | Has; }
    // Whether the group has a feature; and the same as a constant, of one that the stage knows. A stage that asks for
    // another one as a constant does not compile.
    SWIVEL_ALWAYS_INLINE bool has(swivel_features feature) const
    {
        return (((Knows & feature) == feature ? Has : strip.run.features) & feature) != 0;
    }
    template <swivel_features feature>
    static constexpr bool is()
    {
        static_assert((feature & Knows) == feature);
        return (Has & feature) != 0;
    }

    SWIVEL_ALWAYS_INLINE Hinge<T> elbow() const { return hinge(rows.get(kFlexionRow), -rows.get(kFlexionRow + 1)); }
    // A part of the goal: in the strip, if an earlier stage has put it there, or else as it was given.
    SWIVEL_ALWAYS_INLINE Vector<T> goal_vector(bool in_strip, std::uint32_t row, swivel_field field) const
    {
        return load_vector_rows<T>(in_strip ? rows.at(row) : io.at(field, 0));
    }

    // Bits of its lanes.
    SWIVEL_ALWAYS_INLINE std::uint32_t good() const { return strip.good[block] >> lane & kEvery; }
    SWIVEL_ALWAYS_INLINE std::uint32_t chosen() const { return strip.chosen[block] >> lane & kEvery; }
    // The group's rows of some lanes; of the chosen ones; and of those with valid input.
    SWIVEL_ALWAYS_INLINE Rows<T, kRuntimeFeatures> rows_of(std::uint32_t lanes) const
    {
        Rows<T, kRuntimeFeatures> some = io;
        some.chosen = lanes == kEvery ? kEveryLane : lanes;
        return some;
    }
    SWIVEL_ALWAYS_INLINE Rows<T, kRuntimeFeatures> chosen_rows() const { return rows_of(chosen()); }
    SWIVEL_ALWAYS_INLINE Rows<T, kRuntimeFeatures> good_rows() const { return rows_of(good()); }
    SWIVEL_ALWAYS_INLINE void store_flags(const Word<T>& flags) const
    {
        chosen_rows().store(SWIVEL_FLAGS, 0, select(lanes_where<T>(good()), flags, word<T>(SWIVEL_BAD_INPUT)));
    }
    // Lanes with an input that is not valid are bad from now on.
    SWIVEL_ALWAYS_INLINE void require(const Mask<T>& valid) const
    {
        strip.good[block] &= ~((lane_bits(!valid) & kEvery) << lane);
    }
};

// Calls take(slice) for each slice of a strip that has chosen lanes.
template <class T, swivel_features Knows, swivel_features Has, class Take>
SWIVEL_INLINE void for_each_slice(Strip& strip, const Take& take)
{
    constexpr std::uint32_t lanes = lane_count<T>;
    const SolveRun& run = strip.run;
    for (std::uint32_t n = 0; n < strip.block_count; ++n) {
        const std::size_t limb = std::size_t{strip.block[n]} * kLanes;
        const float* const input = run.input + row_offset(limb, run.input_row_count, 0);
        float* const results = run.results + row_offset(limb, run.result_row_count, 0);
        float* const rows = strip.lane(n * kLanes);
        float* const body = run.strip.bodies ? run.strip.bodies + strip.block[n] * run.body_block_floats : rows;
        for (std::uint32_t lane = 0; lane < kLanes; lane += lanes) {
            const StripSlice<T, Knows, Has> slice{
                strip, {run, input + lane, results + lane, kEveryLane}, {rows + lane}, {body + lane}, n, lane};
            if (lanes == kLanes || slice.chosen() != 0) take(slice);
        }
    }
}

}  // namespace swivel::inline SWIVEL_ISA
