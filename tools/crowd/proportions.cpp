// SPDX-License-Identifier: MIT
#include "tools/crowd/proportions.h"

#include <algorithm>
#include <array>

#include "tools/rig/limb_joints.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

using Eigen::Vector3d;
using formats::Clip;
using formats::JointPose;

// Scales the bones between two joints, or down from a joint `top`.
void scale_bones(const Clip& clip, int top, int joint, double factor, std::vector<double>& factors)
{
    for (; joint >= 0 && joint != top; joint = joint_at(clip, joint).parent)
        factors[static_cast<std::size_t>(joint)] = factor;
}

// Of each joint, for its place in the frame of the one above.
std::vector<double> factors_of(const Clip& clip, const std::vector<BodyPart>& body, const Proportions& to)
{
    std::vector<double> factors(clip.joints.size(), 1.0);
    const auto first = [&](const std::string& name) { return joints_of(body, name).front(); };
    for (const std::string side : {"left", "right"}) {
        if (to.legs != 1) scale_bones(clip, first(side + "UpperLeg"), first(side + "Foot"), to.legs, factors);
        if (to.arms != 1) scale_bones(clip, first(side + "UpperArm"), first(side + "Hand"), to.arms, factors);
    }
    if (to.spine != 1) {
        const int hips = first("hips"), chest = joints_of(body, "spine").back();
        scale_bones(clip, hips, chest, to.spine, factors);
        for (std::size_t n = 0; n < clip.joints.size(); ++n)
            if (clip.joints[n].parent == chest) factors[n] = to.spine;
    }
    return factors;
}

// How the legs carry a body: the joint that they all hang on, and in each frame the middle of both hips, from where
// that starts at the height of an ankle that stands.
struct LegsWay {
    int root = -1;
    std::vector<Vector3d> hips;
};
LegsWay legs_way(const Clip& clip, const std::vector<BodyPart>& body, std::span<const Proportions> builds)
{
    LegsWay way;
    if (std::ranges::all_of(builds, [](const Proportions& build) { return build.legs == 1; })) return way;
    const auto both = [&](const std::string& name) {
        return std::array{joints_of(body, "left" + name).front(), joints_of(body, "right" + name).front()};
    };
    const std::array upper = both("UpperLeg"), feet = both("Foot");
    way.root = upper[0];
    while (joint_at(clip, way.root).parent >= 0) way.root = joint_at(clip, way.root).parent;
    std::vector<JointPose> pose_w(clip.joints.size());
    std::vector<double> lower;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        formats::world_pose(clip, frame, pose_w);
        const auto at = [&](int joint) { return pose_w[static_cast<std::size_t>(joint)].position; };
        way.hips.push_back(0.5 * (at(upper[0]) + at(upper[1])));
        lower.push_back(std::min(at(feet[0]).y(), at(feet[1]).y()));
    }
    const Vector3d start(way.hips[0].x(), quantile(std::move(lower), 0.25), way.hips[0].z());
    for (Vector3d& place : way.hips) place -= start;
    return way;
}

}  // namespace

std::string unknown_part(const std::vector<BodyPart>& body, const Proportions& asked)
{
    std::vector<std::string> needed;
    for (const std::string side : {"left", "right"}) {
        if (asked.legs != 1) needed.insert(needed.end(), {side + "UpperLeg", side + "Foot"});
        if (asked.arms != 1) needed.insert(needed.end(), {side + "UpperArm", side + "Hand"});
    }
    if (asked.spine != 1) needed.insert(needed.end(), {"hips", "spine"});
    for (const std::string& name : needed)
        if (joints_of(body, name).empty()) return name;
    return {};
}

Clip proportioned(const Clip& clip, const std::vector<BodyPart>& body, std::span<const Proportions> builds)
{
    const std::size_t joints = clip.joints.size();
    std::vector<std::vector<double>> factors;
    for (const Proportions& build : builds) factors.push_back(factors_of(clip, body, build));
    const LegsWay legs = legs_way(clip, body, builds);
    Clip all = clip;
    all.rotation.clear(), all.translation.clear(), all.scale.clear();
    all.track_count = 0, all.frame_count = builds.size() * clip.frame_count;
    for (std::size_t n = 0; n < joints; ++n) {
        const bool moves = clip.joints[n].track >= 0 || static_cast<int>(n) == legs.root ||
                           std::ranges::any_of(factors, [&](const auto& of) { return of[n] != 1; });
        all.joints[n].track = moves ? static_cast<int>(all.track_count++) : -1;
    }
    for (std::size_t build = 0; build < builds.size(); ++build)
        for (std::size_t frame = 0; frame < clip.frame_count; ++frame)
            for (std::size_t n = 0; n < joints; ++n) {
                if (all.joints[n].track < 0) continue;
                Vector3d place = factors[build][n] * formats::local_translation(clip, frame, n);
                if (static_cast<int>(n) == legs.root) place += (builds[build].legs - 1) * legs.hips[frame];
                all.translation.push_back(place);
            }
    for (std::size_t build = 0; build < builds.size(); ++build) {
        all.rotation.insert(all.rotation.end(), clip.rotation.begin(), clip.rotation.end());
        all.scale.insert(all.scale.end(), clip.scale.begin(), clip.scale.end());
    }
    return all;
}

}  // namespace swivel::tools
