// SPDX-License-Identifier: MIT
#include "tools/cli/option_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "tools/formats/printable.h"
#include "tools/formats/suggestion.h"
#include "tools/formats/text.h"

namespace swivel::tools {

namespace {

OptionValue not_empty(const char* word, const std::string& problem)
{
    return {word, [problem](const std::string& text) { return text.empty() ? problem : ""; }};
}

}  // namespace

CLI::Option* takes(CLI::Option* option, const OptionValue& value)
{
    return option->type_name(value.word)->check(CLI::Validator(value.check, ""));
}

OptionValue whole_number(std::uint64_t min, std::uint64_t max)
{
    const auto check = [min, max](const std::string& text) -> std::string {
        std::uint64_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool plain =
            error == std::errc() && end == text.data() + text.size() && (text.size() == 1 || text[0] != '0');
        if (plain && value >= min && value <= max) return {};
        return fmt::format("'{}' is not a whole number from {} to {}", text, min, max);
    };
    return {"NUMBER", check};
}

OptionValue number(double min, double max)
{
    const auto check = [min, max](const std::string& text) -> std::string {
        double value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error == std::errc() && end == text.data() + text.size() && value >= min && value <= max) return {};
        return fmt::format("'{}' is not a number from {} to {}", text, min, max);
    };
    return {"NUMBER", check};
}

OptionValue numbers(std::size_t count, double min)
{
    const auto check = [count, min](const std::string& text) -> std::string {
        const std::vector<double> values = formats::numbers_of(text);
        const bool fits = std::ranges::all_of(values, [&](double value) { return value > min; });
        if (values.size() == count && fits) return {};
        return fmt::format("'{}' is not {} numbers with commas between{}", formats::printable(text), count,
                           fits ? "" : fmt::format(", above {}", min));
    };
    return {"NUMBERS", check};
}

OptionValue file_name() { return not_empty("FILE", "the file name is empty; give one, or leave the option out"); }

OptionValue name(const std::string& advice) { return not_empty("NAME", "the name is empty; " + advice); }

OptionValue one_of(const std::vector<std::string>& words)
{
    const auto check = [words](const std::string& text) -> std::string {
        if (std::find(words.begin(), words.end(), text) != words.end()) return {};
        return fmt::format("there is no '{}'; {}", formats::printable(text), formats::suggestion(text, words));
    };
    return {formats::joined(words, "|"), check};
}

}  // namespace swivel::tools
