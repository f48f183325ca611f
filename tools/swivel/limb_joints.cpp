// SPDX-License-Identifier: MIT
#include "tools/swivel/limb_joints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <span>
#include <vector>

#include "tools/formats/text.h"
#include "tools/swivel/limb_words.h"

namespace swivel::tools {

namespace {

using formats::Clip;
using formats::Joint;
using formats::LimbKind;
using formats::LimbName;
using formats::Side;

// What exporters put before every joint's name, in the form of plain(), with a number after some.
constexpr std::array<std::string_view, 9> kPrefixes = {"def",    "mixamorig", "valvebiped", "bip0",     "jbip",
                                                       "ccbase", "mavg",      "favg",       "character"};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// A joint's name in the form the tables below are written in: lower case, no name space before a colon or bar, no
// separators, no prefix. Letters beyond ASCII stay as they are.
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
            if (!out.starts_with(prefix) || out.size() == prefix.size()) continue;
            out.erase(0, prefix.size());
            while (!out.empty() && is_digit(out[0])) out.erase(0, 1);
            again = true;
        }
    }
    return out;
}

// A joint's name without what converters put behind all of them: a number after an underscore ("LeftArm_09", glTF from
// Sketchfab), or "jnt" or "joint" after a separator ("LeftArm_jnt").
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

// How exporters name a limb's three joints; * is the side, as a word or a letter.
struct Naming {
    std::array<std::string_view, 3> joints;
    std::string_view habit;
};
constexpr Naming kArmNamings[] = {
    {{"*arm", "*forearm", "*hand"}, "Mixamo, CMU, MotionBuilder"},
    {{"*upperarm", "*lowerarm", "*hand"}, "Unity, VRM, Godot"},
    {{"*upperarm", "*forearm", "*hand"}, "3ds Max Biped, Character Creator"},
    {{"upperarm*", "lowerarm*", "hand*"}, "Unreal, Mesh2Motion"},
    {{"upperarm*", "forearm*", "hand*"}, "Blender Rigify"},
    {{"upperarm*", "lowerarm*", "palm2*"}, "Quaternius"},
    {{"upperarm*", "lowerarm*", "palm*"}, "Quaternius"},
    {{"upperarm*", "lowerarm*", "fist*"}, "Quaternius"},
    {{"upperarm01*", "lowerarm01*", "wrist*"}, "MakeHuman"},
    {{"arm*", "forearm*", "hand*"}, "Blender"},
    {{"*shldr", "*forearm", "*hand"}, "Poser, DAZ"},
    {{"*shldrbend", "*forearmbend", "*hand"}, "DAZ Genesis"},
    {{"*shoulder", "*elbow", "*wrist"}, "Biovision, SMPL"},
    {{"shoulder*", "elbow*", "wrist*"}, "Advanced Skeleton"},
    {{"mshoulder*", "melbow*", "mwrist*"}, "Second Life"},
    {{"*uparm", "*lowarm", "*hand"}, "Biovision, older"},
    {{"*collar", "*elbow", "*wrist"}, "Biovision, older"},
    {{"*腕", "*ひじ", "*手首"}, "MikuMikuDance"},
    {{"*arm", "*elbow", "*wrist"}, "MikuMikuDance in English"},
    {{"arm*", "elbow*", "wrist*"}, "MikuMikuDance in English"},
    {{"armstretch*", "forearmstretch*", "hand*"}, "Auto-Rig Pro"},
    {{"armupper*", "armlower*", "hand*"}, "Valve, Source 2"},
    {{"shoulder*", "elbow*", "hand*"}, "Synty"},
    {{"arm*shoulder2", "arm*elbow", "arm*wrist"}, "XNALara"},
    {{"*humerus", "*radius", "*wrist"}, "Acclaim"},
};
constexpr Naming kLegNamings[] = {
    {{"*upleg", "*leg", "*foot"}, "Mixamo, CMU, MotionBuilder"},
    {{"*upperleg", "*lowerleg", "*foot"}, "Unity, VRM, Godot"},
    {{"*thigh", "*calf", "*foot"}, "3ds Max Biped, Character Creator"},
    {{"thigh*", "calf*", "foot*"}, "Unreal, Mesh2Motion"},
    {{"thigh*", "shin*", "foot*"}, "Blender Rigify"},
    {{"upperleg*", "lowerleg*", "foot*"}, "Quaternius"},
    {{"upperleg01*", "lowerleg01*", "foot*"}, "MakeHuman"},
    {{"*thigh", "*shin", "*foot"}, "Poser, DAZ"},
    {{"*thighbend", "*shin", "*foot"}, "DAZ Genesis"},
    {{"*hip", "*knee", "*ankle"}, "Biovision, SMPL"},
    {{"hip*", "knee*", "ankle*"}, "Advanced Skeleton"},
    {{"mhip*", "mknee*", "mankle*"}, "Second Life"},
    {{"*upleg", "*lowleg", "*foot"}, "Biovision, older"},
    {{"*足", "*ひざ", "*足首"}, "MikuMikuDance"},
    {{"*leg", "*knee", "*ankle"}, "MikuMikuDance in English"},
    {{"leg*", "knee*", "ankle*"}, "MikuMikuDance in English"},
    {{"thighstretch*", "legstretch*", "foot*"}, "Auto-Rig Pro"},
    {{"legupper*", "leglower*", "ankle*"}, "Valve, Source 2"},
    {{"upperleg*", "lowerleg*", "ankle*"}, "Synty"},
    {{"leg*thigh", "leg*knee", "leg*ankle"}, "XNALara"},
    {{"*femur", "*tibia", "*foot"}, "Acclaim"},
};

std::string with_side(std::string_view naming, std::string_view side)
{
    const std::size_t star = naming.find('*');
    return std::string(naming.substr(0, star)).append(side).append(naming.substr(star + 1));
}

// The same for people: "hand_l" where the side is a letter at the end.
std::string shown(std::string_view naming, std::string_view side)
{
    if (side.size() > 1 || !naming.ends_with("*")) return with_side(naming, side);
    return fmt::format("{}_{}", naming.substr(0, naming.size() - 1), side);
}

// The joints of a plain name: bones where any bears it.
std::vector<int> joints_named(const Clip& clip, std::span<const std::string> plain_names, const std::string& name)
{
    std::vector<int> found;
    for (const bool bones : {true, false}) {
        for (std::size_t n = 0; n < clip.joints.size(); ++n)
            if (clip.joints[n].is_bone == bones && plain_names[n] == name) found.push_back(static_cast<int>(n));
        if (!found.empty()) break;
    }
    return found;
}

// `name` without digits: what "DEF-upper_arm.L.001" and "DEF-upper_arm.L" share.
std::string without_digits(std::string name)
{
    std::erase_if(name, is_digit);
    return name;
}

// True for two parts of one bone by name: "DEF-thigh.L" and "DEF-thigh.L.001", "upperarm01.L" and "upperarm02.L". Not
// for shoulders: the first of two may be the clavicle.
bool are_parts(std::string_view top, std::string_view below)
{
    top = without_ending(top), below = without_ending(below);
    const std::string whole = plain(top), part = plain(below);
    if (without_digits(whole) != without_digits(part) || whole.find("shoulder") != std::string::npos) return false;
    const bool both_count =
        std::any_of(whole.begin(), whole.end(), is_digit) && std::any_of(part.begin(), part.end(), is_digit);
    const std::size_t dot = below.find_last_of('.');
    const bool is_copy = dot != std::string_view::npos && below.size() - dot == 4 &&
                         std::all_of(below.begin() + static_cast<std::ptrdiff_t>(dot) + 1, below.end(), is_digit);
    return both_count || is_copy;
}

// The first joint between the two that is neither a twist bone by name, nor a part of `top` by name, nor at the place
// of its parent; -1 if there is none.
int stranger_between(const Clip& clip, int top, int bottom)
{
    int stranger = -1, below = bottom;
    for (int up = joint_at(clip, bottom).parent; up != top; below = up, up = joint_at(clip, up).parent) {
        const Joint& joint = joint_at(clip, up);
        const bool no_step = joint.offset.isZero(0) || joint_at(clip, below).offset.isZero(0);
        if (!no_step && !are_parts(joint_at(clip, top).name, joint.name) && !is_twist_name(joint.name)) stranger = up;
    }
    return stranger;
}

bool is_above(const Clip& clip, int top, int joint)
{
    while (joint >= 0 && joint != top) joint = joint_at(clip, joint).parent;
    return joint >= 0;
}

// Why joints of one plain name, two or more, do not tell which is meant.
std::string of_one_name(const Clip& clip, const std::vector<int>& joints, std::string_view part)
{
    const Joint& first = joint_at(clip, joints[0]);
    const auto differs = [&](int joint) { return joint_at(clip, joint).name != first.name; };
    const auto other = std::find_if(joints.begin(), joints.end(), differs);
    if (other == joints.end()) return fmt::format("{} joints are called '{}'", joints.size(), printable_name(first));
    return fmt::format("'{}' and '{}' both have the name of its {}", printable_name(first),
                       printable_name(joint_at(clip, *other)), part);
}

bool share_joint(const LimbJoints& a, const LimbJoints& b)
{
    return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
}

// What came of one naming; `fits` counts joints that bear its names.
struct Attempt {
    LimbByName result;
    int fits = 0;
};

Attempt attempt(const Clip& clip, std::span<const std::string> plain_names, LimbName limb, const Naming& naming,
                std::string_view side)
{
    const LimbWords& words = words_of(limb.kind);
    const std::string_view parts[] = {words.upper_joint, words.lower_joint, words.end_joint};
    Attempt made{{std::nullopt, std::string(naming.habit), {}}, 0};
    LimbJoints joints{-1, -1, -1};
    std::string& problem = made.result.problem;
    for (std::size_t n = 0; n < 3; ++n) {
        const std::string name = with_side(naming.joints[n], side);
        const std::vector<int> found = joints_named(clip, plain_names, name);
        if (!found.empty()) joints[n] = found[0];
        made.fits += !found.empty();
        if (found.size() > 1 && problem.empty())
            problem = of_one_name(clip, found, parts[n]);
        else if (found.empty() && problem.empty())
            problem =
                fmt::format("no joint is called '{}' or alike for its {}", shown(naming.joints[n], side), parts[n]);
    }
    for (std::size_t n = 0; n < 2 && problem.empty(); ++n) {
        const Joint &top = joint_at(clip, joints[n]), &bottom = joint_at(clip, joints[n + 1]);
        if (joints[n] == joints[n + 1] || !is_above(clip, joints[n], joints[n + 1])) {
            problem =
                fmt::format("'{}' is not below '{}' in the hierarchy", printable_name(bottom), printable_name(top));
        } else if (const int between = stranger_between(clip, joints[n], joints[n + 1]); between >= 0) {
            problem = fmt::format("'{}' lies between '{}' and '{}' and is no twist bone by its name",
                                  printable_name(joint_at(clip, between)), printable_name(top), printable_name(bottom));
        }
    }
    const auto is_bone = [&](int joint) { return joint_at(clip, joint).is_bone; };
    if (problem.empty() && std::none_of(joints.begin(), joints.end(), is_bone))
        problem = fmt::format("'{}' and what is below it are no bones of the file's skin",
                              printable_name(joint_at(clip, joints[0])));
    if (problem.empty()) made.result.joints = joints;
    return made;
}

}  // namespace

bool is_chain(const Clip& clip, const LimbJoints& joints)
{
    return joints[0] != joints[1] && joints[1] != joints[2] && is_above(clip, joints[0], joints[1]) &&
           is_above(clip, joints[1], joints[2]);
}

bool is_twist_name(std::string_view joint_name)
{
    const std::string name = plain(joint_name);
    for (const std::string_view word : {"twist", "roll", "捩"})
        for (std::size_t at = 0; (at = name.find(word, at)) != std::string::npos; ++at) {
            const std::string_view before = std::string_view(name).substr(0, at),
                                   after = std::string_view(name).substr(at);
            if (word != "roll" || (!before.ends_with("sc") && !after.starts_with("roller")))
                return true;  // "scroll", "controller"
        }
    return false;
}

LimbByName limb_by_name(const Clip& clip, LimbName limb)
{
    const auto namings = limb.kind == LimbKind::arm ? std::span<const Naming>(kArmNamings) : kLegNamings;
    const auto sides = limb.side == Side::left ? std::array{"left", "l", "左"} : std::array{"right", "r", "右"};
    Attempt best;
    best.fits = 1;                            // one name alone says nothing: half the world has a "LeftHand"
    for (const bool whole : {true, false}) {  // the names as they are before those without endings
        std::vector<std::string> plain_names;
        for (const Joint& joint : clip.joints)
            plain_names.push_back(plain(whole ? std::string_view(joint.name) : without_ending(joint.name)));
        std::optional<LimbByName> fit;
        for (const Naming& naming : namings)
            for (const std::string_view side : sides) {
                Attempt made = attempt(clip, plain_names, limb, naming, side);
                if (!made.result.joints) {
                    if (made.fits > best.fits) best = std::move(made);
                } else if (!fit) {
                    fit = std::move(made.result);
                } else if (!share_joint(*fit->joints, *made.result.joints)) {  // another figure's
                    const auto name = [&](const LimbByName& of) {
                        return printable_name(joint_at(clip, (*of.joints)[0]));
                    };
                    return {
                        std::nullopt,
                        {},
                        fmt::format("'{}' and '{}' both begin a {}", name(*fit), name(made.result), plain_name(limb))};
                }
            }
        if (fit) return *fit;
    }
    return best.result;
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
