// SPDX-License-Identifier: MIT
//
// A crowd in memory. It has one arena, laid out when the crowd is created: the crowd itself, its groups, its input
// rows, its result rows.
#pragma once

#include <cstddef>
#include <cstdint>

#include "batch/swivel.h"
#include "simd/kernels.h"
#include "simd/rows.h"

namespace swivel {

struct Group {
    std::uint32_t first_block, block_count, limb_count;
    swivel_binding binding;
    RestFrames frames;  // the binding's, for kernels
};

}  // namespace swivel

struct swivel_crowd {
    swivel::FeatureSet features;
    std::uint32_t group_count, block_count;
    std::uint32_t input_row_count, result_row_count;
    std::uint16_t first_row[swivel::kFieldCount];  // of each field, among input or result rows of floats
    swivel_euler_order shoulder_order, wrist_order;
    swivel::Group* groups;
    float *input, *results;  // results: null in a compact crowd, which has words instead
    std::uint16_t* words;
    void* arena;
    std::size_t arena_bytes;
    void (*release)(void* memory, std::size_t bytes, void* user);  // null: the caller keeps the memory
    void* user;
    alignas(16) unsigned char schedule[64];  // what threads remember from one solve to the next (schedule.cpp)
    std::uint32_t* chosen;                   // a bit for each lane, zeros between calls (api_solve.cpp)
    float* urgency;                          // of each block; null without SWIVEL_BUDGET (budget.cpp)
    std::uint8_t* done;                      // a byte for each block, of a solve on threads (schedule.cpp)
};

namespace swivel {

// Bytes of a block's rows, from the counts that the crowd keeps: jobs ask for this in each call.
inline std::size_t block_bytes(const swivel_crowd& crowd)
{
    return crowd.input_row_count * kInputRowBytes + crowd.result_row_count * result_row_bytes(crowd.features);
}

// Words of one bit for each lane.
inline std::uint32_t mask_word_count(std::uint32_t block_count) { return (block_count + 1) / 2; }

// A group of a def that full_def() has filled.
swivel_group_def group_at(const swivel_crowd_def& def, std::uint32_t g);
// Bytes of the arena. The def must be valid, and full_def() must have filled it.
std::uint64_t crowd_bytes(const swivel_crowd_def& def);
// Lays a crowd out in arena, which is aligned to 64 and crowd_bytes(def) long: inputs as swivel_crowd_create() says,
// and all limbs at rest.
swivel_crowd* place_crowd(const swivel_crowd_def& def, void* arena);

}  // namespace swivel
