// SPDX-License-Identifier: MIT
//
// From the plan of a clip's crowd to what the solver alone needs of its limbs. Knows limbs and plans.
#pragma once

#include <span>
#include <vector>

#include "tools/crowd/crowd_plan.h"
#include "tools/crowd/limb_setup.h"

namespace swivel::tools {

// The plan for the solver alone, limb by limb.
std::vector<LimbSetup> limb_setups(std::span<const Limb> limbs, const CrowdPlan& plan);

}  // namespace swivel::tools
