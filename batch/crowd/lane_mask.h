// SPDX-License-Identifier: MIT
//
// Masks of a crowd's lanes, one bit for each lane. A word of 32 bits covers two blocks.
#pragma once

#include "batch/crowd/crowd.h"

namespace swivel {

using LaneMask = std::uint32_t;  // of one block: the low SWIVEL_LANES bits
inline constexpr LaneMask kAllLanes = (1u << SWIVEL_LANES) - 1;

inline LaneMask lanes_of(const std::uint32_t* words, std::uint32_t block)
{
    return words[block / 2] >> block % 2 * SWIVEL_LANES & kAllLanes;
}

inline void add_lanes(std::uint32_t* words, std::uint32_t block, LaneMask lanes)
{
    words[block / 2] |= lanes << block % 2 * SWIVEL_LANES;
}

// The number of limbs in a block of a group; the block's other lanes are padding. block: counted within the group.
inline std::uint32_t limb_count_of(const Group& group, std::uint32_t block)
{
    const std::uint32_t left = group.limb_count - block * SWIVEL_LANES;
    return left < SWIVEL_LANES ? left : std::uint32_t{SWIVEL_LANES};
}
// The lanes of those limbs.
inline LaneMask lanes_of_limbs(const Group& group, std::uint32_t block)
{
    return kAllLanes >> (SWIVEL_LANES - limb_count_of(group, block));
}
// The lanes of those limbs that a mask of the crowd chooses.
inline LaneMask chosen_limbs(const Group& group, std::uint32_t block, const std::uint32_t* mask)
{
    return lanes_of(mask, group.first_block + block) & lanes_of_limbs(group, block);
}

}  // namespace swivel
