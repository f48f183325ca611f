// SPDX-License-Identifier: MIT
//
// Brings hands and feet to their goals by the solver, in a clip that is otherwise done.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/retarget/retarget.h"

namespace swivel::tools {

// Turns each limb's three joints to bring its end to its goal. The solver places elbow or knee, which leans as in the
// goal. The joints get there by the least turns; hand and foot keep their orientation in the world. A frame in which
// the end is within 1e-6 limb lengths of the goal is left as it is. parts: of the target. file: for messages. Throws as
// choose_joints() does.
//
// Returns for each of motion.limbs why it was not solved, and only turns like the source's; empty: solved.
std::vector<std::string> solve_limbs(Retargeted& motion, const std::vector<BodyPart>& parts,
                                     const std::filesystem::path& file);

}  // namespace swivel::tools
