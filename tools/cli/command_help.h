// SPDX-License-Identifier: MIT
//
// The subcommand that says what the others take, and what to say of words that none takes.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace swivel::tools {

// To be added last: it knows the others.
void add_help(CLI::App& app);

// Why a command line was not understood, in one line: an unknown command or option with the one that looks like it,
// else what the parser says.
std::string cause_of(const CLI::App& app, const CLI::ParseError& error);

}  // namespace swivel::tools
