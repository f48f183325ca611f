// SPDX-License-Identifier: MIT
//
// Hands and feet brought to their goals by the solver, in a clip that has all else already.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/retarget/retarget.h"

namespace swivel::tools {

// Turns each limb's three joints so that its end is at its goal. The solver says where elbow or knee then are: they
// lean as the goal says. The joints get there by the least turns; hand and foot keep their orientation in the world. A
// frame in which the end is within 1e-6 limb lengths of the goal is left as it is. parts: of the target. file: for
// messages. Throws as choose_joints() does.
//
// Returns for each of motion.limbs why it was not solved and only turns as the source's; empty: it was.
std::vector<std::string> solve_limbs(Retargeted& motion, const std::vector<BodyPart>& parts,
                                     const std::filesystem::path& file);

}  // namespace swivel::tools
