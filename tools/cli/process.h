// SPDX-License-Identifier: MIT
//
// A run as a whole process. Part of programs, not of the library: it decides what ends the process.
#pragma once

#include <functional>

namespace swivel::tools {

// For main(): what run() returns. Whatever ends the process from now on, a signal, a fault or a lack of memory, first
// removes unfinished files and says one line. A signal that is ignored, or that something else waits for, such as a
// sanitizer, is left to that. Closed standard streams are no file's.
int run_process(const std::function<int()>& run);

}  // namespace swivel::tools
