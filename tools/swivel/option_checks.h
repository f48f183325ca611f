// SPDX-License-Identifier: MIT
//
// What values options take. Numbers are checked more strictly than by the parser: it wraps negative ones, saturates
// large ones and reads a leading zero as octal.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace swivel::tools {

// Decimal digits, least to most.
CLI::Validator whole_number(std::uint64_t least, std::uint64_t most);
// A finite number, least to most.
CLI::Validator number(double least, double most);
// Anything but nothing.
CLI::Validator file_name();
// The same. advice: what to do instead of giving nothing.
CLI::Validator name(const std::string& advice);
// One of these words; another is refused with the one that looks like it.
CLI::Validator one_of(const std::vector<std::string>& words);

}  // namespace swivel::tools
