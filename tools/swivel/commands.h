// SPDX-License-Identifier: MIT
//
// The subcommands: each adds itself to the command line, with what to run when it is chosen. They report failure by
// throwing CommandError, formats::InputError or swivel::Error; main.cpp turns these into one line and an exit code.
#pragma once

#include <CLI/CLI.hpp>

namespace swivel::tools {

void add_demo(CLI::App& app);
void add_solve(CLI::App& app);
void add_rig(CLI::App& app);
void add_verify(CLI::App& app);
void add_bench(CLI::App& app);
void add_info(CLI::App& app);

}  // namespace swivel::tools
