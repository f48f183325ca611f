// SPDX-License-Identifier: MIT
//
// How a run fails: for a reason of the command's own, rather than of a file's or the library's, and how any reason
// becomes a line and an exit code.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace swivel::tools {

struct CommandError : std::runtime_error {
    // exit_code 1: the run failed, 2: the options do not go together. line: what, where, what to do.
    CommandError(int code, const std::string& line) : std::runtime_error(line), exit_code(code) {}
    int exit_code;
};

// Says a failure as one line on stderr and returns its exit code.
int fail(int code, std::string line);

inline constexpr const char* kNotEnoughMemory =
    "not enough memory; try a shorter clip, fewer --characters or --threads 1";

// Does the work of a run and returns its exit code. What is thrown, and a standard output that could not be written in
// full, become one line on stderr.
int run_to_end(const std::function<void()>& work) noexcept;

}  // namespace swivel::tools
