// SPDX-License-Identifier: MIT
#include "tools/rig/name_table.h"

#include "tools/rig/joint_names.h"

namespace swivel::tools {

namespace {

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
