// SPDX-License-Identifier: MIT
//
// The poses of a clip's limbs in all frames. Knows clips alone.
#pragma once

#include <span>
#include <vector>

#include "tools/crowd/crowd_plan.h"

namespace swivel::tools {

// One limb in one frame, as the solver sees it: two bones that at rest point where the limb's do. All is in the world's
// axes, and places are counted from its shoulder. Joints have the axes that the limb is solved in. Words are an arm's.
struct LimbInClip {
    Eigen::Vector3d elbow, wrist;
    Eigen::Quaterniond parent, hand, upper, fore;
    Eigen::Quaterniond local_parent = Eigen::Quaterniond::Identity();  // of the joint above
    Eigen::Quaterniond upper_aim, fore_aim;  // the bone's direction at rest to this frame's, in its joint's axes

    double upper_length() const { return elbow.norm(); }
    double fore_length() const { return (wrist - elbow).norm(); }

    Eigen::Quaterniond local_wrist() const { return fore.conjugate() * hand; }
};

class ClipMotion {
public:
    // Takes what it needs from the clip; limbs are joints of it, and the plan's. Memory: 1,000 bytes a frame for two
    // limbs.
    ClipMotion(const formats::Clip& clip, std::span<const Limb> limbs, const CrowdPlan& plan);

    std::size_t frame_count() const { return frame_count_; }
    const LimbInClip& at(std::size_t frame, std::size_t limb) const { return limbs_[frame * limb_count_ + limb]; }
    // The limb's shoulder in the world.
    Eigen::Vector3d origin(std::size_t frame, std::size_t limb) const
    {
        return Eigen::Vector3d(sources_[limb][frame].origin);
    }
    // The sources of one limb's goals, frame by frame; the look comes after the limbs. Lengths are the limb's own at
    // rest, unless the clip stretches its bones by more than 1e-7 of their length.
    std::span<const goal_source> sources(std::size_t limb) const { return sources_[limb]; }

private:
    std::size_t limb_count_;
    std::vector<LimbInClip> limbs_;                  // [frame * limbs + limb]
    std::vector<std::vector<goal_source>> sources_;  // [limb][frame]
    std::size_t frame_count_;
};

}  // namespace swivel::tools
