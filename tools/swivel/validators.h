// SPDX-License-Identifier: MIT
//
// Checks of option values, stricter than the parser's own: it wraps negative numbers, saturates large ones and reads a
// leading zero as octal.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <string>

namespace swivel::tools {

// Decimal digits, least to most.
inline CLI::Validator whole_number(std::uint64_t least, std::uint64_t most)
{
    const auto check = [least, most](const std::string& text) -> std::string {
        std::uint64_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool plain =
            error == std::errc() && end == text.data() + text.size() && (text.size() == 1 || text[0] != '0');
        if (plain && value >= least && value <= most) return {};
        return fmt::format("'{}' is not a whole number from {} to {}", text, least, most);
    };
    return CLI::Validator(check, fmt::format("{}..{}", least, most));
}

// A finite number, least to most.
inline CLI::Validator number(double least, double most)
{
    const auto check = [least, most](const std::string& text) -> std::string {
        double value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error == std::errc() && end == text.data() + text.size() && value >= least && value <= most) return {};
        return fmt::format("'{}' is not a number from {} to {}", text, least, most);
    };
    return CLI::Validator(check, fmt::format("{}..{}", least, most));
}

inline CLI::Validator file_name()
{
    const auto check = [](const std::string& text) -> std::string {
        return text.empty() ? "the file name is empty" : "";
    };
    return CLI::Validator(check, "FILE");
}

}  // namespace swivel::tools
