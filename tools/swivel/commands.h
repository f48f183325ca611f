// SPDX-License-Identifier: MIT
//
// The subcommands: each adds itself to the command line, with what to run when it is chosen. They report failure by
// throwing CommandError, formats::InputError or swivel::Error; main.cpp turns these into one line and an exit code.
#pragma once

#include <CLI/CLI.hpp>
#include <stdexcept>

namespace swivel::tools {

struct CommandError : std::runtime_error {
    // 1: the run failed, 2: the options do not go together.
    CommandError(int code, const std::string& line) : std::runtime_error(line), exit_code(code) {}
    int exit_code;
};

void add_demo(CLI::App& app);
void add_solve(CLI::App& app);
void add_verify(CLI::App& app);
void add_info(CLI::App& app);

}  // namespace swivel::tools
