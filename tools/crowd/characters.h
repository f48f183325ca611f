// SPDX-License-Identifier: MIT
//
// What makes the characters of a crowd differ. Knows a plan; no clip, no file.
#pragma once

#include <random>
#include <span>
#include <vector>

#include "tools/crowd/crowd_plan.h"
#include "tools/crowd/goals.h"

namespace swivel::tools {

// Uniform from 0 to below 1; std::uniform_real_distribution may differ between libraries.
inline double drawn_share(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

// The characters of a crowd, one after the other. Character 0 is the first clip's own. By the seed the others have a
// size within the plan's and perform one of its clips. If the plan staggers them, they start anywhere in that. By the
// seed, too, some carry a box; character 0 does where all do. Their feet, which the plan says, stand on a square grid
// in X and Z: character n in column n % w and row n / w, w = ceil(sqrt(characters)). Neighbours are the plan's spacing
// apart, in arm spans, or in leg spans where no arm is solved.
class CharacterStream {
public:
    CharacterStream(const CrowdPlan& plan, std::span<const Limb> limbs, std::size_t frame_count);

    goal_character next();

private:
    const CrowdPlan& plan_;
    std::mt19937_64 random_, carriers_;  // so that boxes change nothing else
    std::vector<ClipPart> clips_;
    std::uint32_t columns_;
    double spacing_;
    std::uint32_t made_ = 0;
};

// All of them.
std::vector<goal_character> characters_of(const CrowdPlan& plan, std::span<const Limb> limbs, std::size_t frame_count);

}  // namespace swivel::tools
