// SPDX-License-Identifier: MIT
//
// One number for a crowd's results, which machines compare instead of the results themselves.
#include <algorithm>
#include <array>
#include <cstring>

#include "batch/crowd.h"

namespace {

using namespace swivel;

constexpr std::uint64_t kStart = 0xcbf29ce484222325u, kPrime = 0x100000001b3u;

// One step of FNV-1a, on a word instead of a byte.
void add(std::uint64_t& hash, std::uint64_t word) { hash = (hash ^ word) * kPrime; }

std::uint32_t bits_of(float number)
{
    std::uint32_t bits;
    std::memcpy(&bits, &number, sizeof bits);
    return bits;
}
std::uint32_t bits_of(std::uint16_t word) { return word; }

// A hash for each lane, so that sixteen products are under way at once.
template <class Number>
std::uint64_t digest(const swivel_crowd& crowd, const Number* results)
{
    std::array<std::uint64_t, kLanes> hashes;
    hashes.fill(kStart);
    for (std::uint32_t g = 0; g < crowd.group_count; ++g) {
        const Group& group = crowd.groups[g];
        for (std::uint32_t first = 0; first < group.limb_count; first += kLanes) {
            const std::uint32_t lane_count = std::min(group.limb_count - first, kLanes);
            const std::size_t block = group.first_block + first / kLanes;
            const Number* const rows = results + block * crowd.result_row_count * kLanes;
            for (std::uint32_t row = 0; row < crowd.result_row_count; ++row)
                for (std::uint32_t lane = 0; lane < lane_count; ++lane)
                    add(hashes[lane], bits_of(rows[row * kLanes + lane]));
        }
    }
    std::uint64_t whole = kStart;
    for (const std::uint64_t hash : hashes) add(whole, hash);
    return whole;
}

}  // namespace

uint64_t swivel_digest(const swivel_crowd* crowd)
{
    if (!crowd) return 0;
    return crowd->words ? digest(*crowd, crowd->words) : digest(*crowd, crowd->results);
}
