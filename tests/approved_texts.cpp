// SPDX-License-Identifier: MIT
#include "tests/approved_texts.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string_view>

namespace swivel::test {

namespace {

// Reads the number that begins here, if one does, and goes on to what follows it.
bool take_number(const char*& at, double& number)
{
    const bool is_signed = *at == '-';
    if (!std::isdigit(static_cast<unsigned char>(at[is_signed]))) return false;
    char* end = nullptr;
    number = std::strtod(at, &end);
    at = end;
    return true;
}

bool agree(const std::string& said, const std::string& approved)
{
    const char *a = said.c_str(), *b = approved.c_str();
    while (*a || *b) {
        double is = 0, wanted = 0;
        // What rounding leaves of a target that is reached has no meaning.
        const bool is_rounding = std::string_view(said.c_str(), a).ends_with("to within ");
        const bool is_number = take_number(a, is);
        if (is_number != take_number(b, wanted)) return false;
        if (!is_number && *a++ != *b++) return false;
        if (!is_rounding && std::fabs(is - wanted) > 2e-3 * std::fabs(wanted)) return false;
    }
    return true;
}

}  // namespace

ApprovedTexts::ApprovedTexts(const std::string& file) : path_(SWIVEL_SOURCE_DIR "/tests/approved/" + file) {}

void ApprovedTexts::scene(const std::string& name)
{
    if (!lines_.empty()) lines_.emplace_back();
    lines_.push_back("# " + name);
}

void ApprovedTexts::line(const std::string& when, const std::string& text)
{
    std::istringstream lines(when + ": " + text);
    for (std::string line; std::getline(lines, line);) lines_.push_back(line);
}

void ApprovedTexts::compare() const
{
    if (std::getenv("SWIVEL_RENEW")) {
        std::ofstream file(path_);
        for (const std::string& line : lines_) file << line << '\n';
    }
    std::ifstream file(path_);
    std::string scene, approved;
    for (const std::string& said : lines_) {
        if (said.starts_with("# ")) scene = said;
        const bool is_there = static_cast<bool>(std::getline(file, approved));
        INFO(scene << "\nsaid:     " << said << "\napproved: " << (is_there ? approved : "no such line"));
        CHECK((is_there && agree(said, approved)));
    }
    CHECK(!std::getline(file, approved));  // no line is left
}

void check_room(const std::string& whole, const std::function<swivel_status(char* room, std::size_t size)>& call)
{
    for (std::size_t size = 1; size < whole.size() + 3; ++size) {
        std::string room(whole.size() + 8, 'x');
        REQUIRE(call(room.data(), size) == SWIVEL_OK);
        std::string expected = whole.substr(0, size - 1);
        if (expected != whole)
            for (std::size_t n = 1; n <= std::min<std::size_t>(expected.size(), 3); ++n)
                expected[expected.size() - n] = '.';
        REQUIRE(room.c_str() == expected);
        REQUIRE(room.find_first_not_of('x', size) == std::string::npos);
    }
}

double number_after(const std::string& text, const std::string& words)
{
    const std::size_t at = text.find(words);
    INFO(text << " lacks " << words);
    REQUIRE(at != std::string::npos);
    return std::stod(text.substr(at + words.size()));
}

}  // namespace swivel::test
