// SPDX-License-Identifier: MIT
//
// The whole command as a function.
#pragma once

namespace swivel::tools {

// Runs what the words say, argv[0] being the command's own name. Returns the exit code: 0 done, 1 failed, 2 bad usage,
// 128 and its number for a signal that ended the run. What went wrong is one line on stderr.
int run_swivel(int argc, const char* const* argv);

}  // namespace swivel::tools
