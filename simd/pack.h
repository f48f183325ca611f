// SPDX-License-Identifier: MIT
//
// Converts result rows of floats to rows of 16-bit words, block by block. Compact crowds add this part to the kernels.
// It knows no solver.
#pragma once

#include <cstring>

#include "core/compact.h"
#include "simd/kernels.h"
#include "simd/lanes.h"
#include "simd/rows.h"

namespace swivel::inline SWIVEL_ISA {

// The rows of one step of T's lanes in a block: its results, and floats that hold a word each. Features without
// feature::compact.
template <class T, FeatureSet Features>
struct PackStep {
    const float* results;
    float* held;
    std::size_t first_lane;

    static constexpr std::uint32_t word_row(Field field) { return field_first_row(Features | feature::compact, field); }
    SWIVEL_INLINE T load(Field field, std::uint32_t component) const
    {
        const std::uint32_t row = field_first_row(Features, field) + component;
        return load_lanes<T>([&](std::size_t lane) SWIVEL_INLINE_LAMBDA {
            return results + row_offset(first_lane + lane, result_row_count(Features), row);
        });
    }
    SWIVEL_INLINE void hold(Field field, std::uint32_t word, const T& value) const
    {
        const std::uint32_t row = word_row(field) + word;
        store_lanes(
            [&](std::size_t lane) SWIVEL_INLINE_LAMBDA {
                return held + row_offset(first_lane + lane, result_row_count(Features | feature::compact), row);
            },
            value);
    }
    SWIVEL_INLINE void hold_rotation(Field field) const
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

template <class T, FeatureSet Features>
SWIVEL_INLINE void pack_block(const float* results, std::uint16_t* words)
{
    constexpr FeatureSet compact = Features | feature::compact;
    constexpr std::uint32_t row_count = result_row_count(compact);
    constexpr std::uint32_t elbow = field_first_row(compact, Field::elbow) * kLanes,
                            wrist = field_first_row(compact, Field::wrist) * kLanes,
                            flags = field_first_row(compact, Field::flags) * kLanes;
    constexpr bool joints = Features & feature::joints, with_hand = Features & feature::hand;
    alignas(64) float held[row_count * kLanes];
    for (std::size_t lane = 0; lane < kLanes; lane += lane_count<T>) {
        const PackStep<T, Features> step{results, held, lane};
        step.hold_rotation(Field::shoulder);
        if constexpr (joints) {
            step.hold_rotation(Field::elbow);
        } else {
            step.hold(Field::elbow, 0, compact_half(step.load(Field::elbow, 0)));
            step.hold(Field::elbow, 1, compact_half(step.load(Field::elbow, 1)));
        }
        if constexpr (with_hand) step.hold_rotation(Field::wrist);
        step.hold(Field::flags, 0, step.load(Field::flags, 0));
    }
    cut_words(held, 0, field_row_count(compact, Field::shoulder), words);
    cut_words(held + elbow, joints ? 0 : kHalfBit, field_row_count(compact, Field::elbow), words + elbow);
    if constexpr (with_hand) cut_words(held + wrist, 0, field_row_count(compact, Field::wrist), words + wrist);
    cut_words(held + flags, 0, 1, words + flags);
    cut_words(held + flags, 16, 1, words + flags + kLanes);
}

// T's lanes fit a block.
template <class T, FeatureSet Features>
SWIVEL_FLATTEN void pack(const PackRun& run)
{
    constexpr std::uint32_t row_count = result_row_count(Features),
                            word_count = result_row_count(Features | feature::compact);
    for (std::size_t block = 0; block < run.block_count; ++block)
        pack_block<T, Features>(run.results + row_offset(block * kLanes, row_count, 0),
                                run.words + row_offset(block * kLanes, word_count, 0));
}

}  // namespace swivel::inline SWIVEL_ISA
