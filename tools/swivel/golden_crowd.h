// SPDX-License-Identifier: MIT
//
// The crowd that the promise of equal bits is checked on: for every set of features, ordinary limbs of all reaches,
// hard poses and bad input, in groups that end inside a block. Knows the public interface and nothing else.
#pragma once

#include <cstdint>

#include "swivel/swivel.hpp"

namespace swivel::tools {

// Sets of features a crowd can have: 0 ... kFeatureSets - 1, of which the invalid ones are skipped by is_feature_set().
inline constexpr std::uint32_t kFeatureSets = 16;
bool is_feature_set(std::uint32_t features);

// A crowd of three groups, limb_count limbs in the first and fewer in the others, all inputs written. The same numbers
// on every machine.
Crowd golden_crowd(std::uint32_t features, std::uint32_t limb_count);

// FNV-1a (64 bits) over the results of all limbs, field by field; the padding is left out.
std::uint64_t digest(const Crowd& crowd, std::uint64_t hash);
inline constexpr std::uint64_t kDigestStart = 0xcbf29ce484222325u;

// The digest over every set of features, each crowd solved by solve(crowd).
template <class Solve>
std::uint64_t golden_digest(std::uint32_t limb_count, Solve solve)
{
    std::uint64_t hash = kDigestStart;
    for (std::uint32_t features = 0; features < kFeatureSets; ++features) {
        if (!is_feature_set(features)) continue;
        Crowd crowd = golden_crowd(features, limb_count);
        solve(crowd);
        hash = digest(crowd, hash);
    }
    return hash;
}

}  // namespace swivel::tools
