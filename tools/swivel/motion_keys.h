// SPDX-License-Identifier: MIT
//
// The first character's solved rotations, kept for a file of motion that is written at the end.
#pragma once

#include <span>
#include <vector>

#include "tools/crowd/clip_crowd.h"
#include "tools/swivel/motion_file.h"

namespace swivel::tools {

class MotionKeys {
public:
    // Of a limb three joints, or two where the hand is not solved, and the joint above one with a clavicle; and those
    // that look. limbs and plan must outlive it.
    MotionKeys(std::span<const Limb> limbs, const CrowdPlan& plan)
        : limbs_(limbs), plans_(plan.limbs), keys_(3 * limbs.size()), clavicles_(limbs.size())
    {
        if (plan.look) look_joints_ = plan.look->joints;
        looking_.resize(look_joints_.size());
    }

    // Takes the frame that the crowd has solved.
    void add(const ClipCrowd& crowd);

    // Throws, before any work is done, for what write() could not hold.
    void require_can_write(const MotionFile& file) const;

    // Writes the clip's file with them; throws as MotionFile::write() does.
    void write(const std::filesystem::path& out, const MotionFile& file) const;

private:
    std::vector<formats::JointKeys> overrides(const formats::Clip& clip) const;

    std::span<const Limb> limbs_;
    std::span<const LimbPlan> plans_;
    std::vector<std::vector<Eigen::Quaterniond>> keys_, clavicles_;  // [3 * limb + joint][frame], [limb][frame]
    std::vector<int> look_joints_;
    std::vector<std::vector<Eigen::Quaterniond>> looking_;  // [look joint][frame]
};

}  // namespace swivel::tools
