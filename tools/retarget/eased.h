// SPDX-License-Identifier: MIT
//
// Limits how fast values change.
#pragma once

#include <vector>

namespace swivel::tools {

// The values, changed so that neighbours differ by at most max_step: halfway between the lowest such course above them
// and the highest one below. Values far enough from a jump stay as they are.
std::vector<double> eased(const std::vector<double>& values, double max_step);

}  // namespace swivel::tools
