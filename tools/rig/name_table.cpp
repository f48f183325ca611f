// SPDX-License-Identifier: MIT
#include "tools/rig/name_table.h"

#include <algorithm>
#include <array>

#include "tools/rig/joint_names.h"

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

// Words that may stand before a finger's: in Mixamo, Rigify and Second Life.
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

// clang-format off
constexpr NameRow kRows[] = {
    {{"*arm", "*forearm", "*hand"}, {"*upleg", "*leg", "*foot"}, "Mixamo, CMU, MotionBuilder"},
    {{"*upperarm", "*lowerarm", "*hand"}, {"*upperleg", "*lowerleg", "*foot"}, "Unity, VRM, Godot"},
    {{"*upperarm", "*forearm", "*hand"}, {"*thigh", "*calf", "*foot"}, "3ds Max Biped, Character Creator, Valve"},
    {{}, {"*leg", "*shin", "*foot"}, "SOMA"},
    {{"upperarm*", "lowerarm*", "hand*"}, {"thigh*", "calf*", "foot*"}, "Unreal, Mesh2Motion"},
    {{"upperarm*", "forearm*", "hand*"}, {"thigh*", "shin*", "foot*"}, "Blender Rigify"},
    {{"upperarm*", "lowerarm*", "palm2*"}, {"upperleg*", "lowerleg*", "foot*"}, "Quaternius"},
    {{"upperarm*", "lowerarm*", "palm*"}, {}, "Quaternius"},
    {{"upperarm*", "lowerarm*", "fist*"}, {}, "Quaternius"},
    {{"upperarm*", "lowerarm*", "wrist*"}, {}, "KayKit"},
    {{"upperarm01*", "lowerarm01*", "wrist*"}, {"upperleg01*", "lowerleg01*", "foot*"}, "MakeHuman"},
    {{"arm*", "forearm*", "hand*"}, {"upleg*", "leg*", "foot*"}, "Blender"},
    {{"uparm*", "loarm*", "hand*"}, {"upleg*", "loleg*", "foot*"}, "short names"},
    {{"armupper*", "armlower*", "hand*"}, {"legupper*", "leglower*", "ankle*"}, "Valve, Source 2"},
    {{"armstretch*", "forearmstretch*", "hand*"}, {"thighstretch*", "legstretch*", "foot*"}, "Auto-Rig Pro"},
    {{"*uparm", "*lowarm", "*hand"}, {"*upleg", "*lowleg", "*foot"}, "Biovision, older"},
    {{"*shldr", "*forearm", "*hand"}, {"*thigh", "*shin", "*foot"}, "Poser, DAZ"},
    {{"*shldrbend", "*forearmbend", "*hand"}, {"*thighbend", "*shin", "*foot"}, "DAZ Genesis"},
    {{"*腕", "*ひじ", "*手首"}, {"*足", "*ひざ", "*足首"}, "MikuMikuDance"},
    {{"腕*", "ひじ*", "手首*"}, {"足*", "ひざ*", "足首*"}, "MikuMikuDance in Blender"},
    {{"*arm", "*elbow", "*wrist"}, {"*leg", "*knee", "*ankle"}, "MikuMikuDance in English"},
    {{"arm*", "elbow*", "wrist*"}, {"leg*", "knee*", "ankle*"}, "MikuMikuDance in English"},
    {{"*humerus", "*radius", "*wrist"}, {"*femur", "*tibia", "*foot"}, "Acclaim"},
    {{"*humerus", "*ulna", "*wrist"}, {}, "anatomy"},
    {{"*shoulder2", "*elbow", "*wrist"}, {"*thigh", "*knee", "*ankle"}, "XNALara"},
    {{"mshoulder*", "melbow*", "mwrist*"}, {"mhip*", "mknee*", "mankle*"}, "Second Life"},
    {{"*shoulder", "*elbow", "*wrist"}, {"*hip", "*knee", "*ankle"}, "Biovision, SMPL"},
    {{"*shoulder", "*elbow", "*hand"}, {"*hip", "*knee", "*foot"}, "motion capture"},
    {{"*shoulder", "*forearm", "*hand"}, {}, "iPi"},
    {{"shoulder*", "elbow*", "wrist*"}, {"hip*", "knee*", "ankle*"}, "Advanced Skeleton"},
    {{"shoulder*", "elbow*", "hand*"}, {"upperleg*", "lowerleg*", "ankle*"}, "Synty"},
    {{"*collar", "*elbow", "*wrist"}, {"hip*", "knee*", "foot*"}, "Biovision, older; Valve, Source 1"},
};
// clang-format on

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

std::span<const NameRow> name_table() { return kRows; }

std::array<std::string_view, 3> side_words(formats::Side side)
{
    if (side == formats::Side::left) return {"left", "l", "左"};
    return {"right", "r", "右"};
}

formats::Side side_of(std::string_view joint_name, formats::Side otherwise)
{
    const std::string name = plain(joint_name);
    for (const formats::Side side : {formats::Side::left, formats::Side::right})
        for (const NameRow& row : kRows)
            for (const std::string_view word : side_words(side))
                for (const auto& names : {row.arm, row.leg})
                    for (const std::string_view known : names)
                        if (!known.empty() && with_side(known, word) == name) return side;
    return side_word(joint_name).value_or(otherwise);
}

std::string with_side(std::string_view name, std::string_view side)
{
    const std::size_t star = name.find('*');
    return std::string(name.substr(0, star)).append(side).append(name.substr(star + 1));
}

}  // namespace swivel::tools
