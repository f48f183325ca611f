// SPDX-License-Identifier: MIT
//
// Runs the swivel command in a folder and keeps what it said.
#pragma once

#include <filesystem>
#include <string>

#include "tests/run_program.h"

namespace swivel::test {

// Runs `swivel arguments...` as a function of this process, with `folder` as its working directory and `input` on its
// standard input.
Outcome run_command(const std::filesystem::path& folder, const Words& arguments, const std::string& input = {});

// The same as a process of its own. Only a process has an environment, a terminal, a peak of memory and a time.
Outcome spawn_command(const std::filesystem::path& folder, const Words& arguments,
                      const Surroundings& surroundings = {});

}  // namespace swivel::test
