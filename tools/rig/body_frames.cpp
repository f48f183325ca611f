// SPDX-License-Identifier: MIT
#include "tools/rig/body_frames.h"

#include <fmt/format.h>

#include "tools/rig/facing.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

using formats::Clip;

std::string SomeFrames::words() const { return fmt::format("in {} of {} frames, from frame {}", count, all, first); }

BodyFrames::BodyFrames(const Clip& clip, const std::vector<BodyPart>& parts)
    : clip_(clip),
      limbs_(limbs_of(parts)),
      up_w_(nearest_axis(facing_of(clip, limbs_).up_w)),
      slots_(clip.joints.size())
{
    for (std::size_t side = 0; side < 2; ++side)
        if (const std::vector<int> toes = joints_of(parts, side == 0 ? "leftToes" : "rightToes"); !toes.empty())
            toes_[side] = toes.front();
    const std::vector<formats::JointPose> rest_w = formats::rest_pose(clip);
    if (const std::vector<int> hips = joints_of(parts, "hips"); !hips.empty()) {
        hips_ = hips.front();
        is_mirrored_ = rest_w[static_cast<std::size_t>(hips_)].mirrored;
    }
    const auto see = [&](int joint) {
        if (joint < 0) return;
        slots_[static_cast<std::size_t>(joint)] = seen_.size();
        seen_.push_back(static_cast<std::size_t>(joint));
    };
    for (const auto& limb : limbs_)
        for (std::size_t n = 0; limb && n < 3; ++n) see((*limb)[n]);
    for (const int joint : {toes_[0], toes_[1], hips_}) see(joint);
    rest_w_ = places_of(rest_w);
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame)
        frames_w_.push_back(places_of(formats::world_pose(clip, frame)));
}

double BodyFrames::leg_length() const
{
    const std::size_t leg = limbs_[2] ? 2 : 3;
    return bone_w(rest_w_, leg, 0).norm() + bone_w(rest_w_, leg, 1).norm();
}

BodyFrames::Places BodyFrames::places_of(const std::vector<formats::JointPose>& pose_w) const
{
    Places places_w;
    for (const std::size_t joint : seen_) places_w.push_back(pose_w[joint].position);
    return places_w;
}

}  // namespace swivel::tools
