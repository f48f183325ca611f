// SPDX-License-Identifier: MIT
#include "tools/rig/limb_joints.h"

#include <algorithm>

#include "tools/rig/joint_names.h"

namespace swivel::tools {

using formats::Clip;

bool is_above(const Clip& clip, int top, int joint)
{
    do {
        joint = joint_at(clip, joint).parent;
    } while (joint >= 0 && joint != top);
    return joint >= 0;
}

int root_of(const Clip& clip, int joint)
{
    while (joint_at(clip, joint).parent >= 0) joint = joint_at(clip, joint).parent;
    return joint;
}

bool is_chain(const Clip& clip, const LimbJoints& joints)
{
    return is_above(clip, joints[0], joints[1]) && is_above(clip, joints[1], joints[2]);
}

std::array<std::string, 3> vrm_words(formats::LimbName limb)
{
    const std::string side(side_name(limb.side));
    if (limb.kind == formats::LimbKind::arm) return {side + "UpperArm", side + "LowerArm", side + "Hand"};
    return {side + "UpperLeg", side + "LowerLeg", side + "Foot"};
}

int vrm_joint(const Clip& clip, const std::string& word)
{
    const auto found = clip.human_bones.find(word);
    return found == clip.human_bones.end() ? -1 : found->second;
}

int fork_of(const Clip& clip, int a, int b)
{
    while (a != b) {
        int& later = a > b ? a : b;  // parents come before their children
        later = joint_at(clip, later).parent;
    }
    return a;
}

std::vector<int> toes_of(const Clip& clip, formats::Side side, int foot)
{
    if (const int said = vrm_joint(clip, std::string(side_name(side)) + "Toes"); said >= 0) return {said};
    const auto is_called = [&](int joint, std::string_view word) {
        return plain(joint_at(clip, joint).name).find(word) != std::string::npos;
    };
    std::vector<int> toes, feet;
    for (const int joint : formats::child_joints(clip, foot)) {
        if (is_called(joint, "toe") || is_called(joint, "ball")) toes.push_back(joint);
        if (is_called(joint, "foot") && !is_called(foot, "foot")) feet.push_back(joint);
    }
    return toes.empty() ? feet : toes;
}

int toe_of(const Clip& clip, formats::Side side, int foot)
{
    const std::vector<int> toes = toes_of(clip, side, foot);
    return toes.empty() ? -1 : toes.front();
}

int shared_joint(std::span<const int> a, std::span<const int> b)
{
    const auto found = std::find_first_of(a.begin(), a.end(), b.begin(), b.end());
    return found == a.end() ? -1 : *found;
}

}  // namespace swivel::tools
