// SPDX-License-Identifier: MIT
//
// Converts result rows of floats to rows of 16-bit words, block by block. It knows no solver and no features.
#pragma once

#include <cstring>

#include "core/pack.h"
#include "simd/component_rows.h"
#include "simd/kernels.h"
#include "simd/lanes.h"
#include "simd/rows.h"

namespace swivel::inline SWIVEL_ISA {

// 16 bits of every float, from bit `from` on. The loop is not unrolled. Otherwise g++ would unroll the 16 turns of a
// single row before it could vectorise them, which took half as long again on AVX2.
SWIVEL_INLINE void cut_words(const float* held, std::uint32_t from, std::uint32_t row_count, std::uint16_t* words)
{
    SWIVEL_KEEP_LOOP
    for (std::size_t n = 0; n < std::size_t{row_count} * kLanes; ++n) {
        std::uint32_t bits;
        std::memcpy(&bits, held + n, sizeof bits);
        words[n] = static_cast<std::uint16_t>((bits >> from) & 0xffffu);
    }
}

template <class T>
SWIVEL_INLINE void pack_rotation(const float* rows, std::uint16_t* words)
{
    alignas(64) float held[3 * kLanes];
    for (std::size_t lane = 0; lane < kLanes; lane += lane_count<T>) {
        const PackedRotation<T> packed = packed_rotation(load_rotor_rows<T>(rows + lane));
        store_lanes(held + lane, packed.first);
        store_lanes(held + kLanes + lane, packed.second);
        store_lanes(held + 2 * kLanes + lane, packed.third);
    }
    cut_words(held, 0, 3, words);
}
template <class T>
SWIVEL_INLINE void pack_half(const float* row, std::uint16_t* words)
{
    alignas(64) float held[kLanes];
    for (std::size_t lane = 0; lane < kLanes; lane += lane_count<T>)
        store_lanes(held + lane, packed_half(load_lanes<T>(row + lane)));
    cut_words(held, kHalfBit, 1, words);
}

// T's lanes fit a block.
template <class T>
SWIVEL_FLATTEN void pack(const PackRun& run)
{
    for (std::size_t block = 0; block < run.block_count; ++block)
        for (const PackedValue* value = run.values; value != run.values + run.value_count; ++value) {
            const float* const rows = run.results + row_offset(block * kLanes, run.result_row_count, value->from);
            std::uint16_t* const words = run.words + row_offset(block * kLanes, run.word_row_count, value->to);
            if (value->how == Packing::rotation) {
                pack_rotation<T>(rows, words);
            } else if (value->how == Packing::half) {
                pack_half<T>(rows, words);
            } else {
                cut_words(rows, 0, 1, words);
                cut_words(rows, 16, 1, words + kLanes);
            }
        }
}

}  // namespace swivel::inline SWIVEL_ISA
