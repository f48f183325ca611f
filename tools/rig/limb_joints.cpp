// SPDX-License-Identifier: MIT
#include "tools/rig/limb_joints.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <vector>

#include "tools/rig/joint_names.h"
#include "tools/rig/limb_words.h"

namespace swivel::tools {

namespace {

using formats::Clip;
using formats::Joint;
using formats::LimbKind;
using formats::LimbName;
using formats::Side;

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
    {{"腕*", "ひじ*", "手首*"}, "MikuMikuDance in Blender"},
    {{"upperarm*", "lowerarm*", "wrist*"}, "KayKit"},
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
    {{"足*", "ひざ*", "足首*"}, "MikuMikuDance in Blender"},
    {{"hip*", "knee*", "foot*"}, "Valve, Source 1"},
    {{"upleg*", "leg*", "foot*"}, "Blender"},
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

// The first joint between the two that is neither a twist or roll bone by name, nor a part of `top` by name, nor at the
// place of its parent; -1 if there is none.
int stranger_between(const Clip& clip, int top, int bottom)
{
    double length = 0;
    for (int joint = bottom; joint != top; joint = joint_at(clip, joint).parent)
        length += joint_at(clip, joint).offset.norm();
    const auto no_step = [&](int joint) { return joint_at(clip, joint).offset.norm() <= 1e-4 * length; };
    int stranger = -1, below = bottom;
    for (int up = joint_at(clip, bottom).parent; up != top; below = up, up = joint_at(clip, up).parent) {
        const Joint& joint = joint_at(clip, up);
        const bool is_known =
            is_twist_name(joint.name) || is_roll_name(joint.name) || are_parts(joint_at(clip, top).name, joint.name);
        if (!no_step(up) && !no_step(below) && !is_known) stranger = up;
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

// What came of one naming.
struct Attempt {
    LimbByName result;
    int fits = 0;  // of the three joints, those whose name is borne
    std::array<std::vector<int>, 3> bearers;

    // A limb, or more than one.
    bool is_whole(const Clip& clip) const
    {
        const auto is_bone = [&](int joint) { return joint_at(clip, joint).is_bone; };
        const auto has_bone = [&](const auto& each) { return std::any_of(each.begin(), each.end(), is_bone); };
        if (!result.joints && std::none_of(bearers.begin(), bearers.end(), has_bone)) return false;
        return result.joints || (fits == 3 && std::any_of(bearers.begin(), bearers.end(),
                                                          [](const auto& each) { return each.size() > 1; }));
    }
    // Whether each of its names is borne by a joint that is none of `limb`.
    bool is_beside(const LimbJoints& limb) const
    {
        return std::all_of(bearers.begin(), bearers.end(), [&](const std::vector<int>& each) {
            return std::any_of(each.begin(), each.end(),
                               [&](int joint) { return std::find(limb.begin(), limb.end(), joint) == limb.end(); });
        });
    }
};

Attempt attempt(const Clip& clip, std::span<const std::string> plain_names, LimbName limb, const Naming& naming,
                std::string_view side)
{
    const LimbWords& words = words_of(limb.kind);
    const std::string_view parts[] = {words.upper_joint, words.lower_joint, words.end_joint};
    Attempt made;
    made.result.habit = naming.habit;
    LimbJoints joints{-1, -1, -1};
    std::string& problem = made.result.problem;
    for (std::size_t n = 0; n < 3; ++n) {
        const std::string name = with_side(naming.joints[n], side);
        const std::vector<int> found = joints_named(clip, plain_names, name);
        if (!found.empty()) joints[n] = found[0];
        made.fits += !found.empty();
        made.bearers[n] = found;
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

int shared_joint(std::span<const int> a, std::span<const int> b)
{
    const auto found = std::find_first_of(a.begin(), a.end(), b.begin(), b.end());
    return found == a.end() ? -1 : *found;
}

LimbByName limb_by_name(const Clip& clip, LimbName limb)
{
    const auto namings = limb.kind == LimbKind::arm ? std::span<const Naming>(kArmNamings) : kLegNamings;
    const auto sides = limb.side == Side::left ? std::array{"left", "l", "左"} : std::array{"right", "r", "右"};
    std::vector<Attempt> whole_limbs;
    Attempt nearest;
    nearest.fits = 1;                               // one name alone says nothing: half the world has a "LeftHand"
    for (const bool as_they_are : {true, false}) {  // the names, before those without endings
        std::vector<std::string> plain_names;
        for (const Joint& joint : clip.joints)
            plain_names.push_back(plain(as_they_are ? std::string_view(joint.name) : without_ending(joint.name)));
        for (const Naming& naming : namings)
            for (const std::string_view side : sides) {
                Attempt made = attempt(clip, plain_names, limb, naming, side);
                if (made.fits > nearest.fits) nearest = made;
                if (made.is_whole(clip)) whole_limbs.push_back(std::move(made));
            }
    }
    const auto has_joints = [](const Attempt& made) { return made.result.joints.has_value(); };
    const auto fit = std::find_if(whole_limbs.begin(), whole_limbs.end(), has_joints);
    if (fit == whole_limbs.end()) return nearest.result;
    const LimbJoints& joints = *fit->result.joints;
    const auto is_beside = [&](const Attempt& made) { return made.is_beside(joints); };
    const auto other = std::find_if(whole_limbs.begin(), whole_limbs.end(), is_beside);
    if (other == whole_limbs.end()) return fit->result;
    const auto first_of = [&](const std::vector<int>& bearers) {
        return *std::find_if(bearers.begin(), bearers.end(),
                             [&](int joint) { return std::find(joints.begin(), joints.end(), joint) == joints.end(); });
    };
    const auto name = [&](int joint) { return printable_name(joint_at(clip, joint)); };
    return {std::nullopt,
            {},
            fmt::format("'{}' and '{}' both begin a {}", name(joints[0]), name(first_of(other->bearers[0])),
                        plain_name(limb))};
}

std::optional<std::array<int, 2>> trunks_apart(const Clip& clip, int joint_a, int joint_b)
{
    const auto above_alone = [&](int joint, int other) {
        std::vector<int> found;
        for (int up = joint_at(clip, joint).parent; up >= 0 && !is_above(clip, up, other);
             up = joint_at(clip, up).parent)
            found.push_back(up);
        return found;
    };
    const std::vector<int> above_b = above_alone(joint_b, joint_a);
    std::optional<std::array<int, 2>> nearly;
    for (const int a : above_alone(joint_a, joint_b))
        for (const int b : above_b) {
            const std::string &name_a = joint_at(clip, a).name, &name_b = joint_at(clip, b).name;
            if (!are_namesakes(name_a, name_b)) continue;
            const bool is_another = nearly && !are_namesakes(name_a, joint_at(clip, (*nearly)[0]).name);
            if (is_another || plain(name_a) == plain(name_b)) return std::array{a, b};
            if (!nearly) nearly = {a, b};
        }
    return std::nullopt;
}

}  // namespace swivel::tools
