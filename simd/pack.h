// SPDX-License-Identifier: MIT
//
// Converts result rows of floats to rows of 16-bit words, block by block. Compact groups add this part to the kernels.
// It knows no solver.
#pragma once

#include <cstring>

#include "core/compact.h"
#include "simd/kernels.h"
#include "simd/lanes.h"
#include "simd/rows.h"

namespace swivel::inline SWIVEL_ISA {

// The rows of one step of T's lanes in a block: its results, and floats that hold a word each. Features without
// SWIVEL_COMPACT.
template <class T, swivel_features Features>
struct PackStep {
    const float* results;
    float* held;
    std::size_t first_lane;

    static constexpr RowPlan kFloats{Features}, kWords{Features | SWIVEL_COMPACT};

    SWIVEL_INLINE T load(swivel_field field, std::uint32_t component) const
    {
        const std::uint32_t row = kFloats.first[index_of(field)] + component;
        return load_lanes<T>([&](std::size_t lane) SWIVEL_INLINE_LAMBDA {
            return results + row_offset(first_lane + lane, kFloats.result_count, row);
        });
    }
    SWIVEL_INLINE void hold(swivel_field field, std::uint32_t word, const T& value) const
    {
        const std::uint32_t row = kWords.first[index_of(field)] + word;
        store_lanes([&](std::size_t lane)
                        SWIVEL_INLINE_LAMBDA { return held + row_offset(first_lane + lane, kWords.result_count, row); },
                    value);
    }
    SWIVEL_INLINE void hold_rotation(swivel_field field) const
    {
        const CompactRotation<T> words =
            compact_rotation(rotor(load(field, 0), load(field, 1), load(field, 2), load(field, 3)));
        hold(field, 0, words.first);
        hold(field, 1, words.second);
        hold(field, 2, words.third);
    }
};

// 16 bits of every float, from bit `from` on. The loop is not unrolled. Otherwise g++ would unroll the 16 turns of a
// single row before it could vectorise them, which took half as long again on AVX2.
SWIVEL_INLINE void cut_words(const float* held, std::uint32_t from, std::uint32_t row_count, std::uint16_t* words)
{
#pragma GCC unroll 1
    for (std::size_t n = 0; n < std::size_t{row_count} * kLanes; ++n) {
        std::uint32_t bits;
        std::memcpy(&bits, held + n, sizeof bits);
        words[n] = static_cast<std::uint16_t>((bits >> from) & 0xffffu);
    }
}

template <class T, swivel_features Features>
SWIVEL_INLINE void pack_block(const float* results, std::uint16_t* words)
{
    constexpr swivel_features compact = Features | SWIVEL_COMPACT;
    constexpr std::uint32_t row_count = result_row_count(compact);
    constexpr std::uint32_t elbow = field_first_row(compact, SWIVEL_ELBOW) * kLanes,
                            wrist = field_first_row(compact, SWIVEL_WRIST) * kLanes,
                            flags = field_first_row(compact, SWIVEL_FLAGS) * kLanes;
    constexpr bool joints = Features & SWIVEL_JOINTS, with_hand = Features & SWIVEL_WITH_HAND;
    alignas(64) float held[row_count * kLanes];
    for (std::size_t lane = 0; lane < kLanes; lane += lane_count<T>) {
        const PackStep<T, Features> step{results, held, lane};
        step.hold_rotation(SWIVEL_SHOULDER);
        if constexpr (joints) {
            step.hold_rotation(SWIVEL_ELBOW);
        } else {
            step.hold(SWIVEL_ELBOW, 0, compact_half(step.load(SWIVEL_ELBOW, 0)));
            step.hold(SWIVEL_ELBOW, 1, compact_half(step.load(SWIVEL_ELBOW, 1)));
        }
        if constexpr (with_hand) step.hold_rotation(SWIVEL_WRIST);
        step.hold(SWIVEL_FLAGS, 0, step.load(SWIVEL_FLAGS, 0));
    }
    cut_words(held, 0, elbow / kLanes, words);
    cut_words(held + elbow, joints ? 0 : kHalfBit, (wrist - elbow) / kLanes, words + elbow);
    if constexpr (with_hand) cut_words(held + wrist, 0, (flags - wrist) / kLanes, words + wrist);
    cut_words(held + flags, 0, 1, words + flags);
    cut_words(held + flags, 16, 1, words + flags + kLanes);
}

// T's lanes fit a block.
template <class T, swivel_features Features>
SWIVEL_FLATTEN void pack(const PackRun& run)
{
    constexpr std::uint32_t row_count = result_row_count(Features),
                            word_count = result_row_count(Features | SWIVEL_COMPACT);
    for (std::size_t block = 0; block < run.block_count; ++block)
        pack_block<T, Features>(run.results + row_offset(block * kLanes, row_count, 0),
                                run.words + row_offset(block * kLanes, word_count, 0));
}

}  // namespace swivel::inline SWIVEL_ISA
