// SPDX-License-Identifier: MIT
#include "tools/swivel/limb_joints.h"

#include <cctype>
#include <span>
#include <string>

namespace swivel::tools {

namespace {

using formats::Clip;
using formats::LimbKind;
using formats::Side;

// What exporters put before every joint's name, in the form of plain().
constexpr std::array<std::string_view, 5> kPrefixes = {"def", "mixamorig", "bip001", "bip01", "jbip"};

// A joint's name in the form the tables below are written in: lower case, no name space before a colon, no separators,
// no prefix.
std::string plain(std::string_view name)
{
    if (const std::size_t colon = name.rfind(':'); colon != std::string_view::npos) name.remove_prefix(colon + 1);
    std::string out;
    for (const char c : name)
        if (std::isalnum(static_cast<unsigned char>(c)))
            out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    for (const std::string_view prefix : kPrefixes)
        if (out.starts_with(prefix)) return out.substr(prefix.size());
    return out;
}

// How exporters name a limb's three joints; * is the side, as a word or a letter.
using Naming = std::array<std::string_view, 3>;
constexpr std::array<Naming, 10> kArmNamings = {{
    {"*arm", "*forearm", "*hand"},         // CMU, Mixamo, MotionBuilder
    {"*upperarm", "*lowerarm", "*hand"},   // Unity, VRM
    {"*upperarm", "*forearm", "*hand"},    // 3ds Max Biped
    {"upperarm*", "lowerarm*", "hand*"},   // Unreal
    {"upperarm*", "forearm*", "hand*"},    // Blender Rigify
    {"upperarm*", "lowerarm*", "palm2*"},  // Quaternius
    {"*shldr", "*forearm", "*hand"},       // Poser, DAZ
    {"*shoulder", "*elbow", "*wrist"},     // Biovision
    {"*uparm", "*lowarm", "*hand"},        // Biovision, older
    {"*collar", "*elbow", "*wrist"},
}};
constexpr std::array<Naming, 9> kLegNamings = {{
    {"*upleg", "*leg", "*foot"},          // CMU, Mixamo, MotionBuilder
    {"*upperleg", "*lowerleg", "*foot"},  // Unity, VRM
    {"*thigh", "*calf", "*foot"},         // 3ds Max Biped
    {"thigh*", "calf*", "foot*"},         // Unreal
    {"thigh*", "shin*", "foot*"},         // Blender Rigify
    {"upperleg*", "lowerleg*", "foot*"},  // Quaternius
    {"*thigh", "*shin", "*foot"},         // Poser, DAZ
    {"*hip", "*knee", "*ankle"},          // Biovision
    {"*upleg", "*lowleg", "*foot"},       // Biovision, older
}};

std::string with_side(std::string_view naming, std::string_view side)
{
    const std::size_t star = naming.find('*');
    return std::string(naming.substr(0, star)).append(side).append(naming.substr(star + 1));
}

// The only joint of that plain name, or -1.
int joint_named(const Clip& clip, const std::string& name)
{
    int found = -1;
    for (std::size_t n = 0; n < clip.joints.size(); ++n) {
        if (plain(clip.joints[n].name) != name) continue;
        if (found >= 0) return -1;
        found = static_cast<int>(n);
    }
    return found;
}

std::optional<LimbJoints> joints_named(const Clip& clip, const Naming& naming, std::string_view side)
{
    LimbJoints joints;
    for (std::size_t n = 0; n < joints.size(); ++n) {
        joints[n] = joint_named(clip, with_side(naming[n], side));
        if (joints[n] < 0) return std::nullopt;
    }
    return is_chain(clip, joints) ? std::optional(joints) : std::nullopt;
}

}  // namespace

bool is_chain(const Clip& clip, const LimbJoints& joints)
{
    const auto parent = [&](int joint) { return clip.joints[static_cast<std::size_t>(joint)].parent; };
    return parent(joints[2]) == joints[1] && parent(joints[1]) == joints[0];
}

std::optional<LimbJoints> joints_by_habit(const Clip& clip, formats::LimbName limb)
{
    const auto namings = limb.kind == LimbKind::arm ? std::span<const Naming>(kArmNamings) : kLegNamings;
    const auto sides = limb.side == Side::left ? std::array{"left", "l"} : std::array{"right", "r"};
    for (const Naming& naming : namings)
        for (const std::string_view side : sides)
            if (const std::optional<LimbJoints> joints = joints_named(clip, naming, side)) return joints;
    return std::nullopt;
}

Side side_of(std::string_view joint_name, Side otherwise)
{
    const std::string name = plain(joint_name);
    const bool left = name.starts_with("l") || name.ends_with("l") || name.find("left") != std::string::npos;
    const bool right = name.find("right") != std::string::npos ||
                       (!name.ends_with("shoulder") && name.ends_with("r")) || name.starts_with("r");
    return left == right ? otherwise : left ? Side::left : Side::right;
}

}  // namespace swivel::tools
