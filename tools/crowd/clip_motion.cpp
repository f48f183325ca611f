// SPDX-License-Identifier: MIT
#include "tools/crowd/clip_motion.h"

#include <cmath>

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::JointPose;

LimbInClip limb_in(const Limb& limb, const ChainPose& pose, const JointPose& parent_w)
{
    const Quaterniond parent = parent_w.mirrored ? formats::mirrored(parent_w.rotation) : parent_w.rotation;
    const auto from_shoulder = [&](std::size_t part) {
        return Vector3d(parent_w.scale * (parent * (pose.position[part] - pose.position[0])));
    };
    LimbInClip in;
    in.shoulder = Vector3d::Zero();
    in.elbow = from_shoulder(1);
    in.wrist = from_shoulder(2);
    in.upper_aim = aim(limb.upper_bone, pose.upper_bone());
    in.fore_aim = aim(limb.lower_bone, pose.lower_bone());
    in.parent = parent;
    in.upper = parent * pose.turn[0] * in.upper_aim;
    in.fore = parent * pose.turn[1] * in.fore_aim;
    in.hand = parent * pose.turn[2];
    return in;
}

bool differ(double length, float at_rest) { return std::abs(length - at_rest) > 1e-7 * length; }

}  // namespace

ClipMotion::ClipMotion(const formats::Clip& clip, std::span<const Limb> limbs)
    : limb_count_(limbs.size()), stretches_(limbs.size()), frame_count_(clip.frame_count)
{
    std::vector<JointPose> pose_w(clip.joints.size());
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        formats::world_pose(clip, frame, pose_w);
        for (std::size_t n = 0; n < limbs.size(); ++n) {
            const Limb& limb = limbs[n];
            const int parent = joint_at(clip, limb.upper()).parent;
            const JointPose parent_w = parent < 0 ? JointPose() : pose_w[static_cast<std::size_t>(parent)];
            limbs_.push_back(limb_in(limb, chain_pose(clip, frame, limb.chain), parent_w));
            if (parent >= 0)
                limbs_.back().local_parent =
                    clip.rotation[frame * clip.joints.size() + static_cast<std::size_t>(parent)];
            origins_.push_back(pose_w[static_cast<std::size_t>(limb.upper())].position);
            if (differ(limbs_.back().upper_length(), limb.bound.lengths[0]) ||
                differ(limbs_.back().fore_length(), limb.bound.lengths[1]))
                stretches_[n] = true;
        }
    }
}

}  // namespace swivel::tools
