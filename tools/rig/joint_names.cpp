// SPDX-License-Identifier: MIT
#include "tools/rig/joint_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <vector>

#include "tools/formats/text.h"

namespace swivel::tools {

namespace {

using formats::Side;

// Prefixes that exporters put before every joint's name, some with a number behind.
constexpr std::array<std::string_view, 7> kPrefixes = {"def",   "mixamorig", "bip", "character", "quickrigcharacter",
                                                       "joint", "jnt"};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_number(std::string_view text) { return std::all_of(text.begin(), text.end(), is_digit); }

// FBX writes a character that it has no use for as this and its number, in three digits.
std::string decoded(std::string_view name)
{
    constexpr std::string_view kEscape = "FBXASC";
    std::string out;
    while (!name.empty()) {
        const std::size_t at = std::min(name.find(kEscape), name.size());
        out += name.substr(0, at);
        name.remove_prefix(at);
        const std::string_view digits = name.substr(std::min(kEscape.size(), name.size()), 3);
        if (digits.size() == 3 && is_number(digits) && digits <= "255") {
            out += static_cast<char>(*formats::parse_integer(digits));
            name.remove_prefix(kEscape.size() + digits.size());
        } else if (!name.empty()) {
            out += name[0];
            name.remove_prefix(1);
        }
    }
    return out;
}

// The words of a name, in lower case: what its separators divide. A word may be a number.
std::vector<std::string> words_in(std::string_view name, std::vector<char>& separators)
{
    std::vector<std::string> words(1);
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte >= 0x80 || std::isalnum(byte)) {
            words.back() += static_cast<char>(byte < 0x80 ? std::tolower(byte) : byte);
        } else if (!words.back().empty()) {
            words.emplace_back();
            separators.push_back(c);
        }
    }
    if (words.back().empty() && words.size() > 1) words.pop_back();
    return words;
}

bool is_side(std::string_view word) { return word == "l" || word == "r" || word == "left" || word == "right"; }

void drop_endings(std::vector<std::string>& words, const std::vector<char>& separators)
{
    const auto is_ending = [&](std::size_t n) {
        return words[n] == "jnt" || words[n] == "joint" || (separators[n - 1] == '_' && is_number(words[n]));
    };
    while (words.size() > 1 && is_ending(words.size() - 1)) words.pop_back();
    if (words.size() > 1 && (words.back() == "m" || words.back() == "x")) words.pop_back();  // of neither side
}

// The words of a name without its name space and endings.
std::vector<std::string> own_words(std::string_view joint_name)
{
    if (const std::size_t space = joint_name.find_last_of(":|"); space != std::string_view::npos)
        joint_name.remove_prefix(space + 1);
    std::vector<char> separators;
    std::vector<std::string> words = words_in(decoded(joint_name), separators);
    drop_endings(words, separators);
    return words;
}

void drop_before_side(std::vector<std::string>& words)
{
    const auto side = std::find_if(words.begin(), words.end(), is_side);
    if (side != words.end() && side + 1 != words.end()) words.erase(words.begin(), side);
}

void drop_prefixes(std::string& name)
{
    for (const std::string_view prefix : kPrefixes) {
        if (!name.starts_with(prefix)) continue;
        const std::size_t end = std::min(name.find_first_not_of("0123456789", prefix.size()), name.size());
        if (end == name.size()) return;  // it is all of the name
        name.erase(0, end);
        return drop_prefixes(name);
    }
}

}  // namespace

std::string plain(std::string_view joint_name)
{
    std::vector<std::string> words = own_words(joint_name);
    drop_before_side(words);
    std::string name;
    for (const std::string& word : words) name += word;
    drop_prefixes(name);
    return name;
}

std::string last_word(std::string_view joint_name)
{
    std::string word = own_words(joint_name).back();
    word.erase(word.find_last_not_of("0123456789") + 1);
    return word;
}

std::optional<Side> side_word(std::string_view joint_name)
{
    std::vector<char> separators;
    const std::vector<std::string> words = words_in(joint_name, separators);
    const auto says = [&](std::string_view word, std::string_view letter, std::string_view sign) {
        return joint_name.find(sign) != std::string_view::npos ||
               std::any_of(words.begin(), words.end(), [&](const std::string& each) {
                   return each == letter || each.find(word) != std::string::npos;
               });
    };
    const bool left = says("left", "l", "左"), right = says("right", "r", "右");
    if (left == right) return std::nullopt;
    return left ? Side::left : Side::right;
}

}  // namespace swivel::tools
