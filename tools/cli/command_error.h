// SPDX-License-Identifier: MIT
//
// How a run fails: for a reason of the command's own, rather than of a file's or the library's, and how any reason
// becomes a line and an exit code.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace swivel::tools {

struct CommandError : std::runtime_error {
    // exit_code 1: the run failed, 2: the options do not go together, 128 and a signal's number: that ended it.
    // line: what, where, what to do.
    CommandError(int code, const std::string& line) : std::runtime_error(line), exit_code(code) {}
    int exit_code;
};

// Says a failure as one line on stderr and returns its exit code. The line ends with the advice. Takes no memory.
int fail(int code, std::string_view line, std::string_view advice = {}) noexcept;

constexpr std::string_view kNotEnoughMemory = "not enough memory";

// What to do about a lack of memory, such as "; try a shorter clip"; empty: nothing is known. It is noted before memory
// lacks, by one thread before others read it, and cut to 200 bytes.
void note_memory_advice(std::string_view advice) noexcept;
std::string_view memory_advice() noexcept;

// Does the work of a run and returns its exit code. What is thrown, a noted signal, and a standard output that could
// not be written in full become one line on stderr. Where that is a pipe that nobody reads any more, the code is
// SIGPIPE's, and nothing is said.
int run_to_end(const std::function<void()>& work) noexcept;

}  // namespace swivel::tools
