// SPDX-License-Identifier: MIT
#include "tools/swivel/page_skin.h"

#include <algorithm>

#include "tools/swivel/cached_clip.h"

namespace swivel::tools {

std::optional<PageSkin> page_skin(const MotionFile& file, const CrowdJob& job)
{
    PageSkin skin;
    skin.glb = file.figure_glb();
    if (skin.glb.empty()) return {};
    const formats::Clip& clip = file.clip();
    const std::vector<std::size_t> drawn = drawn_joints(clip, job.limbs, job.plan);
    for (const std::size_t joint : drawn) skin.nodes.push_back(clip.joints[joint].number);
    const auto place_of = [&](int joint) {
        return static_cast<std::size_t>(std::ranges::lower_bound(drawn, static_cast<std::size_t>(joint)) -
                                        drawn.begin());
    };
    std::vector<int> heads = look_joints(clip, job.body, job.limbs);
    const auto is_drawn = [&](int joint) { return std::ranges::binary_search(drawn, static_cast<std::size_t>(joint)); };
    while (!heads.empty() && !is_drawn(heads.front())) heads.erase(heads.begin());
    if (!heads.empty() && std::ranges::all_of(heads, is_drawn)) {
        for (const int joint : heads) skin.head.push_back(place_of(joint));
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
