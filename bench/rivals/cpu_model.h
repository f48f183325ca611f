// SPDX-License-Identifier: MIT
//
// What this CPU calls itself.
#pragma once

#include <string>

namespace bench {

// As Linux has it in /proc/cpuinfo; "unknown" where it says nothing.
std::string cpu_model();

}  // namespace bench
