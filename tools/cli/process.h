// SPDX-License-Identifier: MIT
//
// A run as a whole process. Part of programs, not of the library: it decides what ends the process.
#pragma once

#include <functional>

namespace swivel::tools {

// For main(): what run() gives, as the process's end. Closed standard streams are no file's; a run that a signal ended
// ends by that signal. Where nobody can catch an exception, as in threads and before main(), it is one line and exit
// code 1, too.
int run_process(const std::function<int()>& run);

}  // namespace swivel::tools
