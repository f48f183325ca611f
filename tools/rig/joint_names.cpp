// SPDX-License-Identifier: MIT
#include "tools/rig/joint_names.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace swivel::tools {

namespace {

using formats::Side;

// What exporters put before every joint's name, in the form of plain(), with a number after some.
constexpr std::array<std::string_view, 12> kPrefixes = {
    "def",  "mixamorig", "valvebiped",        "bip", "jbip", "ccbase", "mavg",
    "favg", "character", "quickrigcharacter", "jnt", "joint"};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// `name` without digits: what "DEF-upper_arm.L.001" and "DEF-upper_arm.L" share.
std::string without_digits(std::string name)
{
    std::erase_if(name, is_digit);
    return name;
}

// `name` without the number that Blender gives a copy: "thigh.L.001".
std::string_view without_copy(std::string_view name)
{
    const std::size_t dot = name.find_last_of('.');
    const bool is_copy = dot != std::string_view::npos && name.size() - dot == 4 &&
                         std::all_of(name.begin() + static_cast<std::ptrdiff_t>(dot) + 1, name.end(), is_digit);
    return is_copy ? name.substr(0, dot) : name;
}

}  // namespace

std::string plain(std::string_view name)
{
    if (const std::size_t space = name.find_last_of(":|"); space != std::string_view::npos)
        name.remove_prefix(space + 1);
    std::string out;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte >= 0x80 || std::isalnum(byte)) out += static_cast<char>(byte < 0x80 ? std::tolower(byte) : byte);
    }
    for (bool again = true; again;) {
        again = false;
        for (const std::string_view prefix : kPrefixes) {
            if (!out.starts_with(prefix)) continue;
            std::string rest = out.substr(prefix.size());
            while (!rest.empty() && is_digit(rest[0])) rest.erase(0, 1);
            if (rest.empty()) continue;  // it is all of the name
            out = rest;
            again = true;
        }
    }
    return out;
}

std::string_view without_ending(std::string_view name)
{
    for (bool again = true; again;) {
        again = false;
        const std::size_t at = name.find_last_of("_.- ");
        if (at == std::string_view::npos || at == 0 || at + 1 == name.size()) break;
        const std::string_view end = name.substr(at + 1);
        const bool is_number = name[at] == '_' && std::all_of(end.begin(), end.end(), is_digit);
        again = is_number || plain(end) == "jnt" || plain(end) == "joint";
        if (again) name = name.substr(0, at);
    }
    return name;
}

bool are_namesakes(std::string_view a, std::string_view b)
{
    const auto bare = [](std::string_view name) { return plain(without_copy(without_ending(name))); };
    return !bare(a).empty() && bare(a) == bare(b);
}

bool is_copy_name(std::string_view joint_name)
{
    const std::string_view name = without_ending(joint_name);
    return without_copy(name) != name;
}

bool are_parts(std::string_view top, std::string_view below)
{
    top = without_ending(top), below = without_ending(below);
    const std::string whole = plain(top), part = plain(below);
    if (const std::size_t at = part.find("part"); at != std::string::npos && whole.find("part") == std::string::npos) {
        std::string without = part;  // "ShoulderPart1_L", of Advanced Skeleton
        without.erase(at, 4);
        return without_digits(whole) == without_digits(without);
    }
    if (without_digits(whole) != without_digits(part) || whole.find("shoulder") != std::string::npos) return false;
    const bool both_count =
        std::any_of(whole.begin(), whole.end(), is_digit) && std::any_of(part.begin(), part.end(), is_digit);
    return both_count || is_copy_name(below);
}

bool is_twist_name(std::string_view joint_name)
{
    const std::string name = plain(joint_name);
    return name.find("twist") != std::string::npos || name.find("捩") != std::string::npos;
}

bool is_roll_name(std::string_view joint_name)
{
    const std::string name = plain(joint_name);
    for (std::size_t at = 0; (at = name.find("roll", at)) != std::string::npos; ++at)
        if (!name.substr(0, at).ends_with("sc") && !name.substr(at).starts_with("roller"))
            return true;  // and no "scroll" or "controller"
    return false;
}

Side side_of(std::string_view joint_name, Side otherwise)
{
    const std::string name = plain(without_ending(joint_name));
    const bool left = name.starts_with("l") || name.ends_with("l") || name.find("left") != std::string::npos ||
                      name.starts_with("左");
    const bool right = name.find("right") != std::string::npos ||
                       (!name.ends_with("shoulder") && name.ends_with("r")) || name.starts_with("r") ||
                       name.starts_with("右");
    return left == right ? otherwise : left ? Side::left : Side::right;
}

}  // namespace swivel::tools
