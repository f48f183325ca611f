// SPDX-License-Identifier: MIT
#include "tools/rig/body_parts.h"

#include <algorithm>

#include "tools/rig/joint_names.h"

namespace swivel::tools {

namespace {

using formats::Clip;
using formats::LimbKind;
using formats::LimbName;

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

    // Where two limbs meet; -1 unless both are known.
    int fork(std::size_t left) const
    {
        return limbs[left] && limbs[left + 1] ? fork_of(clip, (*limbs[left])[0], (*limbs[left + 1])[0]) : -1;
    }
    int hips() const
    {
        if (const int joint = vrm_joint(clip, "hips"); joint >= 0) return joint;
        if (const int joint = fork(2); joint >= 0) return joint;
        for (int joint = 0; joint < static_cast<int>(clip.joints.size()); ++joint)
            if (const std::string name = plain(joint_at(clip, joint).name); name == "hips" || name == "pelvis")
                return joint;
        return -1;
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
        if (const int joint = vrm_joint(clip, "head"); joint >= 0) return joint;
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
        for (std::size_t joint = 0; joint < 3; ++joint) add(vrm_words(limb)[joint], {(*limbs[n])[joint]});
        if (limb.kind == LimbKind::leg) add(side + "Toes", {toe_of(clip, limb.side, (*limbs[n])[2])});
    }
    return parts;
}

std::vector<int> joints_of(const std::vector<BodyPart>& parts, std::string_view name)
{
    const auto part = std::ranges::find(parts, name, &BodyPart::name);
    return part == parts.end() ? std::vector<int>() : part->joints;
}

int first_joint(const std::vector<BodyPart>& parts, std::string_view name)
{
    const std::vector<int> joints = joints_of(parts, name);
    return joints.empty() ? -1 : joints.front();
}

std::vector<std::string> part_names()
{
    std::vector<std::string> names{"hips", "spine", "neck", "head"};
    for (const LimbName limb : formats::kLimbNames) {
        const std::string side(side_name(limb.side));
        if (limb.kind == LimbKind::arm) names.push_back(side + "Shoulder");
        for (const std::string& word : vrm_words(limb)) names.push_back(word);
        if (limb.kind == LimbKind::leg) names.push_back(side + "Toes");
    }
    return names;
}

bool is_limb_part(const BodyPart& part)
{
    return std::ranges::any_of(formats::kLimbNames, [&](LimbName limb) {
        const auto words = vrm_words(limb);
        return std::ranges::find(words, part.name) != words.end();
    });
}

KnownLimbs limbs_of(const std::vector<BodyPart>& parts)
{
    KnownLimbs limbs;
    for (std::size_t n = 0; n < limbs.size(); ++n) {
        LimbJoints joints{};
        bool is_known = true;
        for (std::size_t part = 0; part < 3; ++part) {
            const std::vector<int> found = joints_of(parts, vrm_words(formats::kLimbNames[n])[part]);
            is_known = is_known && found.size() == 1;
            if (is_known) joints[part] = found.front();
        }
        if (is_known) limbs[n] = joints;
    }
    return limbs;
}

}  // namespace swivel::tools
