// SPDX-License-Identifier: MIT
#include "tools/rig/body_parts.h"

#include <algorithm>
#include <initializer_list>

#include "tools/rig/joint_names.h"

namespace swivel::tools {

namespace {

using formats::Clip;
using formats::LimbKind;
using formats::LimbName;

// VRM's words for a limb's three joints.
std::array<std::string, 3> part_names(LimbName limb)
{
    const std::string side(side_name(limb.side));
    if (limb.kind == LimbKind::arm) return {side + "UpperArm", side + "LowerArm", side + "Hand"};
    return {side + "UpperLeg", side + "LowerLeg", side + "Foot"};
}

// The joints below `top` and above `joint`, from the top down; all above `joint` where `top` is not above it.
std::vector<int> between(const Clip& clip, int top, int joint)
{
    std::vector<int> joints;
    for (int up = joint_at(clip, joint).parent; up >= 0 && up != top; up = joint_at(clip, up).parent)
        joints.insert(joints.begin(), up);
    return joints;
}

// Names of heads; the last two are those of Second Life and XNALara.
constexpr std::array<std::string_view, 4> kHeads = {"head", "頭", "mhead", "headneckupper"};
constexpr std::string_view kRigifyHead = "spine006";  // another rig may have a seventh joint in its spine

struct Body {
    const Clip& clip;
    const KnownLimbs& limbs;

    int said(const std::string& bone) const
    {
        const auto found = clip.human_bones.find(bone);
        return found == clip.human_bones.end() ? -1 : found->second;
    }
    // Where two limbs meet; -1 unless both are known.
    int fork(std::size_t left) const
    {
        return limbs[left] && limbs[left + 1] ? fork_of(clip, (*limbs[left])[0], (*limbs[left + 1])[0]) : -1;
    }
    int first_called(std::initializer_list<std::string_view> names) const
    {
        for (int joint = 0; joint < static_cast<int>(clip.joints.size()); ++joint)
            if (std::ranges::find(names, plain(joint_at(clip, joint).name)) != names.end()) return joint;
        return -1;
    }
    int hips() const
    {
        if (const int joint = said("hips"); joint >= 0) return joint;
        const int joint = fork(2);
        return joint >= 0 ? joint : first_called({"hips", "pelvis"});
    }
    // How doubtful it is that this is the head; nothing if it is not.
    std::optional<int> doubt_of_head(int joint) const
    {
        const formats::Joint& at = joint_at(clip, joint);
        const std::string name = plain(at.name);
        const bool is_called_so = std::ranges::find(kHeads, name) != kHeads.end();
        if (!is_called_so && last_word(at.name) != "head" && name != kRigifyHead) return std::nullopt;
        return (at.is_bone ? 0 : 2) + (is_called_so ? 0 : 1);
    }
    int head(int chest) const
    {
        if (const int joint = said("head"); joint >= 0) return joint;
        std::optional<int> min;
        int head = -1;
        for (int joint = 0; joint < static_cast<int>(clip.joints.size()); ++joint) {
            const std::optional<int> doubt = doubt_of_head(joint);
            if (!doubt || (min && *min <= *doubt) || (chest >= 0 && !is_above(clip, chest, joint))) continue;
            min = doubt;
            head = joint;
        }
        return head;
    }
    int toe(std::size_t leg) const
    {
        const std::vector<int> toes = toes_of(clip, formats::kLimbNames[leg].side, (*limbs[leg])[2]);
        return toes.empty() ? -1 : toes.front();
    }
};

}  // namespace

std::vector<BodyPart> body_parts(const Clip& clip, const KnownLimbs& limbs, std::optional<int> given_head)
{
    const Body body{clip, limbs};
    std::vector<BodyPart> parts;
    const auto add = [&](std::string name, std::vector<int> joints) {
        if (!joints.empty() && joints.front() >= 0) parts.push_back({std::move(name), std::move(joints)});
    };
    const int hips = body.hips();
    add("hips", {hips});
    int chest = body.fork(0);
    if (chest >= 0 && hips >= 0 && is_above(clip, hips, chest)) {
        std::vector<int> spine = between(clip, hips, chest);
        spine.push_back(chest);
        add("spine", spine);
    } else if (chest != hips) {
        chest = -1;  // no trunk that could be told
    }
    if (const int head = given_head ? *given_head : body.head(chest); head >= 0) {
        if (chest >= 0 && is_above(clip, chest, head)) add("neck", between(clip, chest, head));
        add("head", {head});
    }
    for (std::size_t n = 0; n < limbs.size(); ++n) {
        if (!limbs[n]) continue;
        const LimbName limb = formats::kLimbNames[n];
        const std::string side(side_name(limb.side));
        if (limb.kind == LimbKind::arm && chest >= 0) add(side + "Shoulder", between(clip, chest, (*limbs[n])[0]));
        for (std::size_t joint = 0; joint < 3; ++joint) add(part_names(limb)[joint], {(*limbs[n])[joint]});
        if (limb.kind == LimbKind::leg) add(side + "Toes", {body.toe(n)});
    }
    return parts;
}

std::vector<int> joints_of(const std::vector<BodyPart>& parts, std::string_view name)
{
    const auto part = std::ranges::find(parts, name, &BodyPart::name);
    return part == parts.end() ? std::vector<int>() : part->joints;
}

std::vector<std::string> part_names()
{
    std::vector<std::string> names{"hips", "spine", "neck", "head"};
    for (const LimbName limb : formats::kLimbNames) {
        const std::string side(side_name(limb.side));
        if (limb.kind == LimbKind::arm) names.push_back(side + "Shoulder");
        for (const std::string& name : part_names(limb)) names.push_back(name);
        if (limb.kind == LimbKind::leg) names.push_back(side + "Toes");
    }
    return names;
}

bool is_limb_part(const BodyPart& part)
{
    return std::ranges::any_of(formats::kLimbNames, [&](LimbName limb) {
        const auto names = part_names(limb);
        return std::ranges::find(names, part.name) != names.end();
    });
}

KnownLimbs limbs_of(const std::vector<BodyPart>& parts)
{
    KnownLimbs limbs;
    for (std::size_t n = 0; n < limbs.size(); ++n) {
        LimbJoints joints{};
        bool is_known = true;
        for (std::size_t part = 0; part < 3; ++part) {
            const std::vector<int> found = joints_of(parts, part_names(formats::kLimbNames[n])[part]);
            is_known = is_known && found.size() == 1;
            if (is_known) joints[part] = found.front();
        }
        if (is_known) limbs[n] = joints;
    }
    return limbs;
}

}  // namespace swivel::tools
