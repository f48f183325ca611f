// SPDX-License-Identifier: MIT
//
// Picks the most urgent blocks. Floats above 0 have bits in the same order as the numbers. The code counts how many
// blocks have which leading digits. The counts give the least urgency that is picked, without sorting and without
// allocating memory.
#include <algorithm>
#include <cstring>
#include <limits>

#include "batch/solve/solve.h"
#include "core/num.h"
#include "simd/float_env.h"

namespace swivel {

namespace {

constexpr float kMaxPriority = 1e15f;  // as for lengths

// The largest priority of a block's limbs, within 0 ... kMaxPriority. NaN fails every comparison.
float largest(const char* priority, std::size_t stride, std::uint32_t limb_count)
{
    float max = 0;
    for (std::uint32_t n = 0; n < limb_count; ++n, priority += stride) {
        float each;
        std::memcpy(&each, priority, sizeof each);
        max = each > max ? each : max;
    }
    return max < kMaxPriority ? max : kMaxPriority;
}

// What a block has gathered; 0 where the caller's number is infinite or NaN.
float gathered(float urgency)
{
    const float size = urgency < 0 ? -urgency : urgency;
    return size <= std::numeric_limits<float>::max() ? size : 0;
}

// Adds priorities to the urgency of a group's blocks, and sets its sign: a block is wanted if its priority is above 0.
// Returns how many are wanted.
std::uint32_t add_urgency(float* urgency, const Group& group, const swivel_in& priorities)
{
    const char* at = static_cast<const char*>(priorities.data);
    std::uint32_t wanted = 0;
    for (std::uint32_t block = 0; block < group.block_count; ++block, ++urgency) {
        const float priority = largest(at, priorities.stride, limb_count_of(group, block));
        *urgency = priority > 0 ? gathered(*urgency) + priority : -gathered(*urgency);
        wanted += priority > 0;
        at += SWIVEL_LANES * priorities.stride;
    }
    return wanted;
}

// An urgency as a number to pick by: above 0 for blocks that are wanted, 0 for others.
std::uint32_t key_of(float urgency) { return urgency > 0 ? bit_cast<std::uint32_t>(urgency) : 0; }

// Blocks of a larger key are picked, and equal_count blocks of just this key, in the crowd's order.
struct Threshold {
    std::uint32_t key, equal_count;
};

// Finds the max_blocks largest keys, digit by digit, the leading one first. More keys than that are above 0.
Threshold find_threshold(const float* urgency, std::uint32_t block_count, std::uint32_t max_blocks)
{
    constexpr std::uint32_t kMaxDigits = 1u << 11;  // 2,048 counts: exponent and three bits tell most blocks apart
    std::uint32_t prefix = 0, left = max_blocks;    // the threshold's digits so far, and blocks not yet above it
    std::uint32_t unknown_bits = 31;                // of the threshold; floats above 0 have no sign
    for (const std::uint32_t shift : {20u, 10u, 0u}) {
        const std::uint32_t max_digit = (1u << (unknown_bits - shift)) - 1;
        std::uint32_t counts[kMaxDigits] = {};
        for (std::uint32_t block = 0; block < block_count; ++block) {
            const std::uint32_t key = key_of(urgency[block]);
            if (key >> unknown_bits == prefix) ++counts[key >> shift & max_digit];
        }
        std::uint32_t digit = max_digit;
        for (; counts[digit] < left; --digit) left -= counts[digit];
        prefix = prefix << (unknown_bits - shift) | digit;
        unknown_bits = shift;
    }
    return {prefix, left};
}

}  // namespace

std::uint32_t choose(const swivel_crowd& crowd, const swivel_in* priorities, float* urgency, std::uint32_t max_blocks,
                     std::uint32_t* words)
{
    const FloatEnv env;
    if (!urgency) {
        urgency = crowd.urgency;
        std::fill_n(urgency, crowd.block_count, 0.0f);
    }
    std::uint32_t wanted = 0, limb_count = 0;
    for (std::uint32_t g = 0; g < lane_group_count(crowd); ++g)
        wanted += add_urgency(urgency + crowd.groups[g].first_block, crowd.groups[g], priorities[g]);
    std::fill_n(words, mask_word_count(crowd.block_count), 0u);
    if (max_blocks == 0) return 0;
    Threshold min = wanted > max_blocks ? find_threshold(urgency, crowd.block_count, max_blocks) : Threshold{0, 0};
    for (std::uint32_t g = 0; g < lane_group_count(crowd); ++g) {
        const Group& group = crowd.groups[g];
        for (std::uint32_t n = 0, block = group.first_block; n < group.block_count; ++n, ++block) {
            const std::uint32_t key = key_of(urgency[block]);
            const bool equal = key == min.key && min.equal_count > 0;
            if (key <= min.key && !equal) continue;
            min.equal_count -= equal;
            add_lanes(words, block, lanes_of_limbs(group, n));
            limb_count += limb_count_of(group, n);
            urgency[block] = 0;
        }
    }
    return limb_count;
}

}  // namespace swivel
