// SPDX-License-Identifier: MIT
#include "tools/crowd/proportions.h"

#include <algorithm>
#include <array>

#include "tools/crowd/clip_parts.h"
#include "tools/rig/limb_joints.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

using Eigen::Vector3d;
using formats::Clip;
using formats::JointPose;

// Scales the places of all joints that hang on a chain from `top` down to right above `joint`: they lie along its
// bones.
void scale_bones(const Clip& clip, int top, int joint, double factor, std::vector<double>& factors)
{
    do {
        joint = joint_at(clip, joint).parent;
        for (const int child : child_joints(clip, joint)) factors[static_cast<std::size_t>(child)] = factor;
    } while (joint != top);
}

// The factor of each joint's place in the frame of the joint above.
std::vector<double> factors_of(const Clip& clip, const std::vector<BodyPart>& body, const Proportions& to)
{
    std::vector<double> factors(clip.joints.size(), 1.0);
    const auto first = [&](const std::string& name) { return joints_of(body, name).front(); };
    const auto scale_limb = [&](const std::string& upper, const std::string& end, double factor) {
        if (factor != 1) scale_bones(clip, first(upper), first(end), factor, factors);
    };
    if (to.spine != 1) {
        const std::vector<int> spine = joints_of(body, "spine");
        factors[static_cast<std::size_t>(spine.front())] = to.spine;
        for (const int joint : spine)
            for (const int child : child_joints(clip, joint)) factors[static_cast<std::size_t>(child)] = to.spine;
    }
    for (const std::string side : {"left", "right"}) {
        scale_limb(side + "UpperLeg", side + "Foot", to.legs);
        scale_limb(side + "UpperArm", side + "Hand", to.arms);
    }
    return factors;
}

// How legs carry a body: in each frame how far the middle of both hips is from where that starts, at the height of an
// ankle that stands. The root takes the way along the ground, the hips that along Y, so roots on the ground stay there.
struct LegsWay {
    int root = -1, hips = -1;
    std::vector<Vector3d> middle;
    std::vector<JointPose> above;  // the hips

    Vector3d way_of(int joint, std::size_t frame) const
    {
        Vector3d way = Vector3d::Zero();
        if (joint == root) way += Vector3d(middle[frame].x(), 0, middle[frame].z());
        if (joint == hips)
            way += above[frame].rotation.conjugate() * Vector3d(0, middle[frame].y() / above[frame].scale, 0);
        return way;
    }
};
LegsWay legs_way(const Clip& clip, const std::vector<BodyPart>& body, std::span<const Proportions> builds)
{
    LegsWay way;
    if (std::ranges::all_of(builds, [](const Proportions& build) { return build.legs == 1; })) return way;
    const auto both = [&](const std::string& name) {
        return std::array{joints_of(body, "left" + name).front(), joints_of(body, "right" + name).front()};
    };
    const std::array upper = both("UpperLeg"), feet = both("Foot");
    way.hips = joints_of(body, "hips").front();
    way.root = root_of(clip, way.hips);
    std::vector<JointPose> pose_w(clip.joints.size());
    std::vector<double> lower;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        formats::world_pose(clip, frame, pose_w);
        const auto at = [&](int joint) { return pose_w[static_cast<std::size_t>(joint)]; };
        const int above = joint_at(clip, way.hips).parent;
        way.middle.push_back(0.5 * (at(upper[0]).position + at(upper[1]).position));
        way.above.push_back(above < 0 ? JointPose() : at(above));
        lower.push_back(std::min(at(feet[0]).position.y(), at(feet[1]).position.y()));
    }
    const Vector3d start(way.middle[0].x(), quantile(std::move(lower), 0.25), way.middle[0].z());
    for (Vector3d& place : way.middle) place -= start;
    return way;
}

}  // namespace

std::string unknown_part(const std::vector<BodyPart>& body, const Proportions& asked)
{
    std::vector<std::string> needed;
    for (const std::string side : {"left", "right"}) {
        if (asked.legs != 1) needed.insert(needed.end(), {side + "UpperLeg", side + "Foot", "hips"});
        if (asked.arms != 1) needed.insert(needed.end(), {side + "UpperArm", side + "Hand"});
    }
    if (asked.spine != 1) needed.push_back("spine");
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
    Clip all = frames_of(clip, {});
    all.track_count = 0, all.frame_count = builds.size() * clip.frame_count;
    for (std::size_t n = 0; n < joints; ++n) {
        const bool carries = static_cast<int>(n) == legs.root || static_cast<int>(n) == legs.hips;
        const bool moves = clip.joints[n].track >= 0 || carries ||
                           std::ranges::any_of(factors, [&](const auto& factor) { return factor[n] != 1; });
        all.joints[n].track = moves ? static_cast<int>(all.track_count++) : -1;
    }
    for (std::size_t build = 0; build < builds.size(); ++build)
        for (std::size_t frame = 0; frame < clip.frame_count; ++frame)
            for (std::size_t n = 0; n < joints; ++n) {
                if (all.joints[n].track < 0) continue;
                Vector3d place = factors[build][n] * formats::local_translation(clip, frame, n);
                if (builds[build].legs != 1)
                    place += (builds[build].legs - 1) * legs.way_of(static_cast<int>(n), frame);
                all.translation.push_back(place);
            }
    for (std::size_t build = 0; build < builds.size(); ++build) {
        all.rotation.insert(all.rotation.end(), clip.rotation.begin(), clip.rotation.end());
        all.scale.insert(all.scale.end(), clip.scale.begin(), clip.scale.end());
    }
    return all;
}

}  // namespace swivel::tools
