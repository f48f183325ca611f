// SPDX-License-Identifier: MIT
//
// Values that change no faster than they may.
#pragma once

#include <vector>

namespace swivel::tools {

// The values, each moved as far as it takes that none differs from the next by more than max_step: halfway between the
// lowest such course above all of them and the highest one below. Values far enough from a jump stay as they are.
std::vector<double> eased(const std::vector<double>& values, double max_step);

}  // namespace swivel::tools
