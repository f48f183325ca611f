// SPDX-License-Identifier: MIT
#include "tools/swivel/cached_clip.h"

#include <algorithm>

#include "tools/crowd/crowd_plan.h"

namespace swivel::tools {

namespace {

// A joint's place among those that are drawn, or of the nearest one above it; -1 where there is none.
int drawn_at(const formats::Clip& clip, std::span<const std::size_t> drawn, int joint)
{
    for (; joint >= 0; joint = joint_at(clip, joint).parent) {
        const auto at = std::ranges::lower_bound(drawn, static_cast<std::size_t>(joint));
        if (at != drawn.end() && *at == static_cast<std::size_t>(joint)) return static_cast<int>(at - drawn.begin());
    }
    return -1;
}

std::vector<float> positions_of(const formats::Clip& clip, std::span<const std::size_t> drawn)
{
    std::vector<float> positions;
    std::vector<formats::JointPose> pose_w(clip.joints.size());
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        formats::world_pose(clip, frame, pose_w);
        for (const std::size_t n : drawn)
            for (const double coordinate : pose_w[n].position) positions.push_back(static_cast<float>(coordinate));
    }
    return positions;
}

}  // namespace

std::vector<std::size_t> drawn_joints(const formats::Clip& clip, std::span<const Limb> limbs, const CrowdPlan& plan)
{
    std::vector<int> own;
    for (const Limb& limb : limbs) own.insert(own.end(), limb.joints.begin(), limb.joints.end());
    if (plan.look) {
        own.push_back(joint_at(clip, plan.look->joints.front()).parent);
        own.insert(own.end(), plan.look->joints.begin(), plan.look->joints.end());
    }
    std::vector<std::size_t> drawn;
    for (std::size_t n = 0; n < clip.joints.size(); ++n)
        if (clip.joints[n].is_bone || std::ranges::count(own, static_cast<int>(n)) > 0) drawn.push_back(n);
    return drawn;
}

CachedCrowd cached_clip(const ClipNames& names, const formats::Clip& clip, std::span<const Limb> limbs,
                        const CrowdPlan& plan, const ClipMotion& motion)
{
    const std::vector<std::size_t> drawn = drawn_joints(clip, limbs, plan);
    const std::vector<LimbSetup> setups = limb_setups(plan);
    CachedCrowd crowd;
    crowd.title = names.title;
    crowd.clip = names.clip;
    crowd.frame_seconds = clip.frame_time;
    crowd.frame_count = static_cast<std::uint32_t>(clip.frame_count);
    crowd.clip_frames = crowd.frame_count;
    crowd.character_count = plan.characters;
    crowd.budget_blocks = plan.budget_blocks;
    crowd.ground = plan.ground;
    for (const PlannedAgent& agent : plan.agents) crowd.names.push_back(agent.name);
    crowd.has_headings = plan.has_headings();
    for (const std::size_t n : drawn)
        crowd.joints.push_back({clip.joints[n].name, drawn_at(clip, drawn, clip.joints[n].parent)});
    crowd.positions = positions_of(clip, drawn);
    for (std::size_t n = 0; n < limbs.size(); ++n) {
        const auto sources = motion.sources(n);
        crowd.limbs.push_back({limbs[n].name, {}, setups[n], {sources.begin(), sources.end()}});
        for (const int joint : limbs[n].joints) crowd.limbs[n].joints.push_back(drawn_at(clip, drawn, joint));
    }
    if (plan.look) {
        const auto sources = motion.sources(limbs.size());
        crowd.look = {plan.look->setup, {sources.begin(), sources.end()}};
    }
    if (const auto& carry = plan.carry)
        crowd.box = {carry->size.x(), carry->size.y(), carry->size.z(), -carry->palm.z()};
    return crowd;
}

std::optional<PageSkin> page_skin(const MotionFile& file, const CrowdJob& job)
{
    PageSkin skin;
    skin.glb = file.figure_glb();
    if (skin.glb.empty()) return {};
    const formats::Clip& clip = file.clip();
    const std::vector<std::size_t> drawn = drawn_joints(clip, job.limbs, job.plan);
    for (const std::size_t joint : drawn) skin.nodes.push_back(clip.joints[joint].number);
    std::vector<int> heads = look_joints(clip, job.body, job.limbs);
    const auto is_drawn = [&](int joint) { return std::ranges::binary_search(drawn, static_cast<std::size_t>(joint)); };
    while (!heads.empty() && !is_drawn(heads.front())) heads.erase(heads.begin());
    if (!heads.empty() && std::ranges::all_of(heads, is_drawn)) {
        for (const int joint : heads) skin.head.push_back(static_cast<std::size_t>(drawn_at(clip, drawn, joint)));
        const Eigen::Vector3d face = face_of(clip, heads.back(), job.faces_w);
        skin.face = {face.x(), face.y(), face.z()};
    }
    std::vector<formats::JointPose> pose_w(clip.joints.size());
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        formats::world_pose(clip, frame, pose_w);
        for (const std::size_t joint : drawn) {
            for (const double part : pose_w[joint].rotation.coeffs()) skin.turns.push_back(static_cast<float>(part));
            skin.turns.push_back(
                static_cast<float>(pose_w[joint].mirrored ? -pose_w[joint].scale : pose_w[joint].scale));
        }
    }
    return skin;
}

}  // namespace swivel::tools
