// SPDX-License-Identifier: MIT
//
// Where a clip has its limbs in each of its frames. Knows clips alone.
#pragma once

#include <span>
#include <vector>

#include "tools/swivel/limbs.h"

namespace swivel::tools {

// One limb in one frame: places relative to the root joint, rotations in the world. Words are an arm's.
struct LimbInClip {
    Eigen::Vector3d shoulder, elbow, wrist;
    Eigen::Quaterniond parent, hand, upper, fore;
    Eigen::Quaterniond local_parent;  // of the joint above

    Eigen::Quaterniond local_shoulder() const { return parent.conjugate() * upper; }
    Eigen::Quaterniond local_elbow() const { return upper.conjugate() * fore; }
    Eigen::Quaterniond local_wrist() const { return fore.conjugate() * hand; }
};

class ClipMotion {
public:
    // Takes what it needs from the clip; limbs are joints of it. Memory: 488 bytes a frame for two limbs.
    ClipMotion(const formats::Clip& clip, std::span<const Limb> limbs);

    std::size_t frame_count() const { return roots_.size(); }
    const LimbInClip& at(std::size_t frame, std::size_t limb) const { return limbs_[frame * limb_count_ + limb]; }
    // The root joint in the world.
    const Eigen::Vector3d& root(std::size_t frame) const { return roots_[frame]; }

private:
    std::size_t limb_count_;
    std::vector<LimbInClip> limbs_;  // [frame * limbs + limb]
    std::vector<Eigen::Vector3d> roots_;
};

}  // namespace swivel::tools
