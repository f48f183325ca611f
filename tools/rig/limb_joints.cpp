// SPDX-License-Identifier: MIT
#include "tools/rig/limb_joints.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/rig/joint_names.h"
#include "tools/rig/name_search.h"

namespace swivel::tools {

namespace {

using formats::Clip;
using formats::LimbKind;
using formats::LimbName;

// The joints that VRM calls so, if it knows any of the three.
std::optional<FoundJoints> said_joints(const Clip& clip, LimbName limb)
{
    const bool is_arm = limb.kind == LimbKind::arm;
    const std::array<std::string, 3> parts = is_arm ? std::array<std::string, 3>{"UpperArm", "LowerArm", "Hand"}
                                                    : std::array<std::string, 3>{"UpperLeg", "LowerLeg", "Foot"};
    FoundJoints found{LimbJoints{-1, -1, -1}, "the file's humanoid", {}, {}};
    std::size_t known = 0;
    for (std::size_t n = 0; n < parts.size(); ++n) {
        const std::string bone = std::string(side_name(limb.side)) + parts[n];
        const auto said = clip.human_bones.find(bone);
        if (said == clip.human_bones.end()) {
            found.problem = fmt::format("the file's humanoid has no {}", bone);
            continue;
        }
        (*found.joints)[n] = said->second;
        ++known;
    }
    if (known == 0) return std::nullopt;
    if (found.problem.empty() && !is_chain(clip, *found.joints))
        found.problem = fmt::format("the joints of the file's humanoid for it do not lie above one another");
    if (!found.problem.empty()) found.joints.reset();
    return found;
}

}  // namespace

bool is_above(const Clip& clip, int top, int joint)
{
    do {
        joint = joint_at(clip, joint).parent;
    } while (joint >= 0 && joint != top);
    return joint >= 0;
}

bool is_chain(const Clip& clip, const LimbJoints& joints)
{
    return is_above(clip, joints[0], joints[1]) && is_above(clip, joints[1], joints[2]);
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
    const auto said = clip.human_bones.find(std::string(side_name(side)) + "Toes");
    if (said != clip.human_bones.end()) return {said->second};
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

int shared_joint(std::span<const int> a, std::span<const int> b)
{
    const auto found = std::find_first_of(a.begin(), a.end(), b.begin(), b.end());
    return found == a.end() ? -1 : *found;
}

std::array<FoundJoints, 4> joints_by_file(const Clip& clip)
{
    const NamedJoints named(clip);
    std::array<FoundJoints, 4> found;
    for (std::size_t n = 0; n < found.size(); ++n) {
        const LimbName limb = formats::kLimbNames[n];
        std::optional<FoundJoints> said = said_joints(clip, limb);
        found[n] = said ? std::move(*said) : joints_by_name(named, limb);
    }
    return found;
}

}  // namespace swivel::tools
