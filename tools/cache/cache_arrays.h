// SPDX-License-Identifier: MIT
//
// The arrays of a cache: their names, types and shapes, by the crowd alone. docs/cache.md has them as a table.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tools/cache/cached_crowd.h"
#include "tools/cache/zarr.h"

namespace swivel::tools {

// The arrays of a cache, in the one order in which it lists them.
struct CacheArrays {
    explicit CacheArrays(const CachedCrowd& crowd);

    std::vector<ResultField> fields;
    std::vector<ZarrArray> results, state;  // one for each field; no state where none is carried
    ZarrArray digest, state_digest;
    std::vector<ZarrArray> clip;        // sources, one array for each member of goal_source; then positions of joints
    std::vector<ZarrArray> ground;      // heights; none without hills
    std::vector<ZarrArray> characters;  // one array for each member of goal_character
    std::vector<ZarrArray> given;       // target, pole, hand; none without goals of one's own

    // Those that are written once, when a cache is made.
    std::vector<ZarrArray> made() const;
    // All others: results if they are kept, state, digests.
    std::vector<ZarrArray> filled(const CachedCrowd& crowd) const;
};

// Digests of all chunks of an array that is written once, 0 where there is no chunk, by the array's name. Each list is
// a chunk of digest_array().
using GoalDigests = std::map<std::string, std::vector<std::uint64_t>>;
ZarrArray digest_array(const ZarrArray& made);
// One for all of them.
std::uint64_t digest_of(const GoalDigests& digests);

}  // namespace swivel::tools
