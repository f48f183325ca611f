// SPDX-License-Identifier: MIT
//
// Solves chunks of a cache: the characters of one column, frame by frame.
#pragma once

#include <vector>

#include "tools/cache/cache.h"
#include "tools/crowd/goal_crowd.h"

namespace swivel::tools {

class Column {
public:
    // crowd must outlive the column. index: which column of it these are the characters of.
    Column(const CachedCrowd& crowd, std::uint32_t index, std::vector<goal_character> characters);
    std::uint32_t index() const { return index_; }

    // Starts from the last results of the chunk before, where state is carried.
    void restore(const Results& state);
    // Solves the frames of a chunk and fills results; returns their digest. Where state is carried, chunks in order, or
    // restore() first.
    std::uint64_t solve(std::uint32_t time, const ChunkGoals& goals, Results& results);

private:
    // Whether a limb has a field of the results. A look has its joints in the fields of shoulder, elbow and wrist.
    bool has(std::size_t limb, swivel_field field) const;
    void read_frame(std::uint32_t frame, Results& results) const;

    const CachedCrowd& cached_;
    std::uint32_t index_;
    std::vector<ResultField> fields_;
    std::vector<LimbSetup> setups_;
    GoalCrowd crowd_;
};

// Puts the user's goals in the formula's place, as a chunk has them for one of its frames. The chunk's characters are
// the crowd's from `first` on. places, unless null, gets the limbs that had such goals.
void put_given(const CachedCrowd& cached, const ChunkGoals& goals, std::uint32_t frame, std::uint32_t first,
               GoalCrowd& crowd, std::vector<GivenPlace>* places = nullptr);

// What its legs stand on; null: nothing.
inline const Ground* ground_of(const CachedCrowd& crowd) { return crowd.ground ? &*crowd.ground : nullptr; }

// Whole chunks' results, all of them NaN, and 0 where they are flags.
Results empty_results(const CachedCrowd& crowd);

}  // namespace swivel::tools
