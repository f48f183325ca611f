// SPDX-License-Identifier: MIT
//
// One number for a crowd's results, which machines compare instead of the results themselves.
#include <algorithm>
#include <array>

#include "batch/crowd/crowd.h"
#include "core/num.h"

namespace {

using namespace swivel;

// An odd number with bits in both halves, so that flipping any bit changes the upper half: 2^64 divided by the golden
// ratio.
constexpr std::uint64_t kFactor = 0x9e3779b97f4a7c15u;

// The product spreads a change to the bits above it, and the shift brings these back down. Both steps are invertible,
// so no change is lost.
void add(std::uint64_t& hash, std::uint64_t word)
{
    hash = (hash ^ word) * kFactor;
    hash ^= hash >> 32;
}

// One hash for each lane, so that sixteen products run at once.
using Hashes = std::array<std::uint64_t, kLanes>;

void add(Hashes& hashes, const Group& group)
{
    const float* rows = group.results;
    for (std::uint32_t first = 0; first < group.limb_count; first += kLanes) {
        const std::uint32_t lane_count = std::min(group.limb_count - first, kLanes);
        for (std::uint32_t row = 0; row < group.result_row_count; ++row, rows += kLanes)
            for (std::uint32_t lane = 0; lane < lane_count; ++lane)
                add(hashes[lane], bit_cast<std::uint32_t>(rows[lane]));
    }
}

}  // namespace

uint64_t swivel_digest(const swivel_crowd* crowd)
{
    if (!crowd) return 0;
    Hashes hashes{};
    for (const Group* group = crowd->groups; group != crowd->groups + crowd->group_count; ++group) add(hashes, *group);
    std::uint64_t whole = 0;
    for (const std::uint64_t hash : hashes) add(whole, hash);
    return whole;
}
