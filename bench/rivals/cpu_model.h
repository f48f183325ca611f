// SPDX-License-Identifier: MIT
//
// What this CPU calls itself.
#pragma once

#include <string>

namespace bench {

// As Linux has it in /proc/cpuinfo, with family and model, because virtual CPUs have names that say little: "AMD EPYC,
// family 25, model 17". "unknown" where it says nothing.
std::string cpu_model();

}  // namespace bench
