// SPDX-License-Identifier: MIT
#include "tools/swivel/clip_motion.h"

namespace swivel::tools {

ClipMotion::ClipMotion(const formats::Clip& clip, std::span<const Limb> limbs) : limb_count_(limbs.size())
{
    std::vector<formats::JointPose> pose_w(clip.joints.size());
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        formats::world_pose(clip, frame, pose_w);
        const auto at = [&](int joint) -> const formats::JointPose& { return pose_w[static_cast<std::size_t>(joint)]; };
        const Eigen::Vector3d root = pose_w[0].position;
        roots_.push_back(root);
        for (const Limb& limb : limbs) {
            const int parent = clip.joints[static_cast<std::size_t>(limb.upper())].parent;
            limbs_.push_back(
                {at(limb.upper()).position - root, at(limb.lower()).position - root, at(limb.end()).position - root,
                 parent < 0 ? Eigen::Quaterniond::Identity() : at(parent).rotation, at(limb.end()).rotation,
                 at(limb.upper()).rotation, at(limb.lower()).rotation,
                 parent < 0 ? Eigen::Quaterniond::Identity()
                            : clip.rotation[frame * clip.joints.size() + static_cast<std::size_t>(parent)]});
        }
    }
}

}  // namespace swivel::tools
