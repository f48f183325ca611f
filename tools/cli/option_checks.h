// SPDX-License-Identifier: MIT
//
// What values options take. Numbers are checked more strictly than by the parser: it wraps negative ones, saturates
// large ones and reads a leading zero as octal.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace swivel::tools {

// What an option takes.
struct OptionValue {
    std::string word;                                      // for it in help; "arms|legs" where only these are taken
    std::function<std::string(const std::string&)> check;  // what is wrong with a text; empty: nothing
};

// The option takes that; help calls it by its word alone.
CLI::Option* takes(CLI::Option* option, const OptionValue& value);

// Decimal digits, least to most.
OptionValue whole_number(std::uint64_t min, std::uint64_t max);
// A finite number, least to most.
OptionValue number(double min, double max);
// As many such numbers, above `least`, with commas between; formats::numbers_of() gives them.
OptionValue numbers(std::size_t count, double min);
// Anything but nothing.
OptionValue file_name();
// The same. advice: what to do instead of giving nothing.
OptionValue name(const std::string& advice);
// One of these words; another is refused with the one that looks like it.
OptionValue one_of(const std::vector<std::string>& words);

}  // namespace swivel::tools
