// SPDX-License-Identifier: MIT
//
// What makes the characters of a crowd differ. Knows a plan; no clip, no file.
#pragma once

#include <span>
#include <vector>

#include "tools/crowd/crowd_plan.h"
#include "tools/crowd/goals.h"

namespace swivel::tools {

// Character 0 is the clip's own. The others differ by the seed: a size within the plan's, and a start anywhere in the
// clip, if the plan staggers them. They stand on a square grid in X and Z: character n in column n % w and row n / w,
// w = ceil(sqrt(characters)). Neighbours are the plan's spacing apart, in arm spans, or in leg spans where no arm is
// solved.
std::vector<goal_character> characters_of(const CrowdPlan& plan, std::span<const Limb> limbs, std::size_t frame_count);

}  // namespace swivel::tools
