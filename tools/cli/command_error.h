// SPDX-License-Identifier: MIT
//
// How a subcommand fails for a reason of its own, rather than of a file's or the library's.
#pragma once

#include <stdexcept>
#include <string>

namespace swivel::tools {

struct CommandError : std::runtime_error {
    // exit_code 1: the run failed, 2: the options do not go together. line: what, where, what to do.
    CommandError(int code, const std::string& line) : std::runtime_error(line), exit_code(code) {}
    int exit_code;
};

// Prints a failure as one line on stderr and returns its exit code.
int fail(int code, std::string line);

}  // namespace swivel::tools
