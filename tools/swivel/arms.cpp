// SPDX-License-Identifier: MIT
#include "tools/swivel/arms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>

#include "tools/formats/error.h"

namespace swivel::tools {

namespace {

using formats::Clip;
using formats::InputError;
using formats::Side;

// A joint's name in the form the table below is written in: lower case, no name space before a colon, no separators.
std::string plain(std::string_view name)
{
    if (const std::size_t colon = name.rfind(':'); colon != std::string_view::npos) name.remove_prefix(colon + 1);
    std::string out;
    for (const char c : name)
        if (std::isalnum(static_cast<unsigned char>(c)))
            out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out.starts_with("def") ? out.substr(3) : out;
}

// How exporters name an arm's three joints; * is the side, as a word or a letter.
constexpr std::array<std::array<std::string_view, 3>, 9> kNamings = {{
    {"*arm", "*forearm", "*hand"},         // CMU, Mixamo, MotionBuilder
    {"*upperarm", "*lowerarm", "*hand"},   // Unity, VRM
    {"upperarm*", "lowerarm*", "hand*"},   // Unreal
    {"upperarm*", "forearm*", "hand*"},    // Blender Rigify
    {"upperarm*", "lowerarm*", "palm2*"},  // Quaternius
    {"*shldr", "*forearm", "*hand"},       // Poser, DAZ
    {"*shoulder", "*elbow", "*wrist"},     // Biovision
    {"*uparm", "*lowarm", "*hand"},        // Biovision, older
    {"*collar", "*elbow", "*wrist"},
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

bool is_chain(const Clip& clip, const Arm& arm)
{
    const auto parent = [&](int joint) { return clip.joints[static_cast<std::size_t>(joint)].parent; };
    return parent(arm.wrist) == arm.elbow && parent(arm.elbow) == arm.shoulder;
}

bool share_a_joint(const Arm& a, const Arm& b)
{
    for (const int joint : {a.shoulder, a.elbow, a.wrist})
        if (joint == b.shoulder || joint == b.elbow || joint == b.wrist) return true;
    return false;
}

std::optional<Arm> arm_by_habit(const Clip& clip, Side side)
{
    for (const auto& naming : kNamings)
        for (const std::string_view word : side == Side::left ? std::array{"left", "l"} : std::array{"right", "r"}) {
            Arm arm;
            arm.side = side;
            arm.shoulder = joint_named(clip, with_side(naming[0], word));
            arm.elbow = joint_named(clip, with_side(naming[1], word));
            arm.wrist = joint_named(clip, with_side(naming[2], word));
            if (arm.shoulder >= 0 && arm.elbow >= 0 && arm.wrist >= 0 && is_chain(clip, arm)) return arm;
        }
    return std::nullopt;
}

int joint_wanted(const Clip& clip, const std::filesystem::path& file, std::string_view name)
{
    const std::vector<int> found = formats::find_joints(clip, name);
    if (found.empty())
        throw InputError(file,
                         fmt::format("no joint is called '{}' (--arm); its joints are listed by its HIERARCHY", name));
    if (found.size() > 1)
        throw InputError(file, fmt::format("{} joints are called '{}' (--arm); name one by its path, such as {}",
                                           found.size(), name, formats::joint_path(clip, found[0])));
    return found[0];
}

Side side_of(std::string_view shoulder_name, Side otherwise)
{
    const std::string name = plain(shoulder_name);
    const bool left = name.starts_with("l") || name.ends_with("l") || name.find("left") != std::string::npos;
    const bool right = name.find("right") != std::string::npos ||
                       (!name.ends_with("shoulder") && name.ends_with("r")) || name.starts_with("r");
    return left == right ? otherwise : left ? Side::left : Side::right;
}

Arm arm_wanted(const Clip& clip, const std::filesystem::path& file, std::string_view text, Side otherwise)
{
    std::optional<Side> side;
    for (const Side each : {Side::left, Side::right}) {
        const std::string prefix = fmt::format("{}:", formats::side_name(each));
        if (!text.starts_with(prefix)) continue;
        side = each;
        text.remove_prefix(prefix.size());
    }
    const std::size_t first = text.find(','), second = text.find(',', first + 1);
    if (first == std::string_view::npos || second == std::string_view::npos ||
        text.find(',', second + 1) != std::string_view::npos)
        throw InputError(file, fmt::format("--arm '{}' does not name three joints; write SHOULDER,ELBOW,WRIST", text));
    const std::string_view name = text.substr(0, first);
    Arm arm;
    arm.side = side ? *side : side_of(name, otherwise);
    arm.shoulder = joint_wanted(clip, file, name);
    arm.elbow = joint_wanted(clip, file, text.substr(first + 1, second - first - 1));
    arm.wrist = joint_wanted(clip, file, text.substr(second + 1));
    if (!is_chain(clip, arm))
        throw InputError(file, fmt::format("--arm '{}' does not name a joint, its child and its child's child", text));
    return arm;
}

Eigen::Vector3d offset(const Clip& clip, int joint) { return clip.joints[static_cast<std::size_t>(joint)].offset; }

// The axis the elbow turns about in this clip, in the shoulder joint's frame. A bent elbow shows it; BVH rests are
// straight, so it is the mean over the frames, each counting by the sine of its bend. A clip that never bends its elbow
// gets the axis that carries a forearm of a figure facing +Z forwards.
void choose_hinge(const Clip& clip, Arm& arm)
{
    const Eigen::Vector3d upper = offset(clip, arm.elbow).normalized(), fore = offset(clip, arm.wrist).normalized();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weight = 0;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const Eigen::Quaterniond& elbow =
            clip.rotation[frame * clip.joints.size() + static_cast<std::size_t>(arm.elbow)];
        const Eigen::Vector3d bend = (elbow * fore).cross(upper);
        sum += bend;
        weight += bend.norm();
    }
    // 0.02: a mean bend of one degree; half: the bends must agree on an axis, not cancel.
    if (weight > 0.02 * static_cast<double>(clip.frame_count) && sum.norm() > 0.5 * weight) {
        arm.hinge = sum.normalized();
        arm.hinge_source = "mean bend of the clip";
        return;
    }
    arm.hinge = Eigen::Vector3d::UnitZ().cross(upper);
    if (arm.hinge.norm() < 0.1) arm.hinge = Eigen::Vector3d::UnitX();
    arm.hinge.normalize();
    arm.hinge_source = "facing +Z, as the clip shows no bend";
}

void store(const Eigen::Vector3d& v, float (&to)[3])
{
    for (int n = 0; n < 3; ++n) to[n] = static_cast<float>(v[n]);
}

void bind_arm(const Clip& clip, const std::filesystem::path& file, Arm& arm)
{
    choose_hinge(clip, arm);
    swivel_chain chain{};
    chain.shoulder_rotation[3] = chain.elbow_rotation[3] = chain.wrist_rotation[3] = 1;  // a BVH rests without rotation
    store(offset(clip, arm.elbow), chain.elbow_offset);
    store(offset(clip, arm.wrist), chain.wrist_offset);
    store(arm.hinge, chain.hinge);
    try {
        arm.limb = bind(chain);
    } catch (const Error& error) {
        throw InputError(file,
                         fmt::format("the {} arm cannot be bound: {}", formats::side_name(arm.side), error.what()));
    }
}

}  // namespace

std::vector<Arm> find_arms(const Clip& clip, const std::filesystem::path& file, std::span<const std::string> wanted)
{
    std::vector<Arm> arms;
    for (const std::string& text : wanted)
        arms.push_back(arm_wanted(clip, file, text, arms.empty() ? Side::left : Side::right));
    if (wanted.empty())
        for (const Side side : {Side::left, Side::right})
            if (const std::optional<Arm> arm = arm_by_habit(clip, side)) arms.push_back(*arm);
    if (arms.empty())
        throw InputError(file, "no arms found by the usual joint names; name them with --arm SHOULDER,ELBOW,WRIST");
    if (arms.size() > 2) throw InputError(file, "--arm was given more than twice; a character has two arms");
    if (arms.size() == 2 && arms[0].side == arms[1].side)
        throw InputError(file, fmt::format("both arms are taken as {}; write --arm left:... and --arm right:...",
                                           formats::side_name(arms[0].side)));
    if (arms.size() == 2 && share_a_joint(arms[0], arms[1]))
        throw InputError(file, "the two arms share a joint; each needs three of its own (--arm)");
    for (Arm& arm : arms) bind_arm(clip, file, arm);
    return arms;
}

}  // namespace swivel::tools
