// SPDX-License-Identifier: MIT
#include "tools/rig/finger_names.h"

#include <algorithm>
#include <array>

#include "tools/rig/name_table.h"

namespace swivel::tools {

namespace {

using formats::Side;

struct Finger {
    std::string_view word, finger;
};
constexpr std::array<Finger, 7> kFingers = {{{"thumb", "thumb"},
                                             {"index", "index"},
                                             {"middle", "middle"},
                                             {"mid", "middle"},
                                             {"ring", "ring"},
                                             {"pinky", "pinky"},
                                             {"little", "pinky"}}};

// What may stand before a finger's word: in Mixamo, Rigify and Second Life.
constexpr std::array<std::string_view, 4> kBefore = {"", "hand", "f", "mhand"};

// "index 1" for "findex01", a finger's name without its side; empty for anything else.
std::string bone_of(std::string_view name)
{
    const std::size_t end = name.find_last_not_of("0123456789") + 1;
    std::string_view number = name.substr(end);
    number.remove_prefix(std::min(number.find_first_not_of('0'), number.size()));
    if (number.size() != 1) return {};
    for (const Finger& each : kFingers)
        for (const std::string_view before : kBefore)
            if (name.substr(0, end) == std::string(before).append(each.word))
                return std::string(each.finger).append(" ").append(number);
    return {};
}

}  // namespace

std::string finger_bone(std::string_view plain_name)
{
    for (const Side side : {Side::left, Side::right})
        for (const std::string_view word : side_words(side)) {
            std::string bone;
            if (plain_name.starts_with(word)) bone = bone_of(plain_name.substr(word.size()));
            if (bone.empty() && plain_name.ends_with(word))
                bone = bone_of(plain_name.substr(0, plain_name.size() - word.size()));
            if (!bone.empty()) return std::string(side_name(side)).append(" ").append(bone);
        }
    return {};
}

}  // namespace swivel::tools
