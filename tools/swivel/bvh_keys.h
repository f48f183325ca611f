// SPDX-License-Identifier: MIT
//
// The first character's solved rotations, kept for a BVH file that is written at the end.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "tools/formats/bvh.h"
#include "tools/swivel/clip_crowd.h"

namespace swivel::tools {

class BvhKeys {
public:
    // Of a limb three joints, or two where the hand is not solved, and the joint above one with a clavicle. limbs and
    // plan must outlive it.
    BvhKeys(std::span<const Limb> limbs, const CrowdPlan& plan)
        : limbs_(limbs), plans_(plan.limbs), keys_(3 * limbs.size()), clavicles_(limbs.size())
    {
    }

    // Takes the frame that the crowd has solved.
    void add(const ClipCrowd& crowd);

    // Writes the clip's file with them; throws as formats::write_bvh() does.
    void write(const std::filesystem::path& path, const formats::BvhFile& file) const;

private:
    std::span<const Limb> limbs_;
    std::span<const LimbPlan> plans_;
    std::vector<std::vector<Eigen::Quaterniond>> keys_, clavicles_;  // [3 * limb + joint][frame], [limb][frame]
};

}  // namespace swivel::tools
