// SPDX-License-Identifier: MIT
//
// The differences between a crowd's characters. Knows a plan; no clip, no file.
#pragma once

#include <random>
#include <span>
#include <vector>

#include "tools/crowd/crowd_plan.h"
#include "tools/crowd/goals.h"

namespace swivel::tools {

// Uniform from 0 to below 1; std::uniform_real_distribution may differ between libraries.
inline double drawn_share(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }
inline double drawn_in(const formats::NumberRange& range, std::mt19937_64& random)
{
    return range.min + (range.max - range.min) * drawn_share(random);
}

// The characters of a crowd, one after the other: the plan's agents, or a grid. In a grid character 0 is the first
// clip's own. The seed gives the others a size and a heading within the plan's ranges, one of its clips, and a start
// anywhere in it if the plan staggers them. Their feet, at the plan's foot, stand on a square grid in X and Z:
// character n in column n % w and row n / w, w = ceil(sqrt(characters)). Neighbours are the plan's spacing apart, in
// arm spans, or in leg spans where no arm is solved. The seed gives some characters a box; character 0 has one only if
// all have.
class CharacterStream {
public:
    CharacterStream(const CrowdPlan& plan, std::span<const Limb> limbs, std::size_t frame_count);

    goal_character next();

private:
    PlannedAgent drawn(std::uint32_t n);  // for a place in the grid

    const CrowdPlan& plan_;
    std::mt19937_64 random_, carriers_, headings_;  // so that boxes and headings change nothing else
    std::vector<ClipPart> clips_;
    std::uint32_t columns_;
    double spacing_;
    std::uint32_t made_ = 0;
};

// All of them.
std::vector<goal_character> characters_of(const CrowdPlan& plan, std::span<const Limb> limbs, std::size_t frame_count);

}  // namespace swivel::tools
