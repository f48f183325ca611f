// SPDX-License-Identifier: MIT
//
// A box in both hands: where it is on the chest, and where that puts the wrists. Knows clips alone.
#pragma once

#include <optional>
#include <span>

#include "tools/rig/limbs.h"

namespace swivel::tools {

struct CarryPlan {
    double share;  // of the characters, chosen by the seed
    // The box, of a figure of size 1 in the world's unit. Its sides are to the left, up and ahead, as the figure is at
    // rest; its middle is counted from the middle between the shoulders.
    Eigen::Vector3d size, place;
    int chest;                // the joint that it goes along with: where both arms meet
    Eigen::Vector3d middle;   // in the chest's axes and unit
    Eigen::Vector3d palm;     // from the middle of the box's left side to that wrist, in the box's axes
    Eigen::Quaterniond turn;  // from the box's axes to the chest's
};

// Whether both arms are there and meet at a joint that has a size.
bool can_carry(const formats::Clip& clip, std::span<const Limb> limbs);

// A box that suits the arms, unless size or place are given. up_w, faces_w: of the figure at rest, unit, at right
// angles. can_carry() must be true.
CarryPlan plan_carry(const formats::Clip& clip, std::span<const Limb> limbs, double share,
                     const std::optional<Eigen::Vector3d>& size, const std::optional<Eigen::Vector3d>& place,
                     const Eigen::Vector3d& up_w, const Eigen::Vector3d& faces_w);

// Where an arm's wrist is at the box's side, in the world. pose_w: of one frame of the clip.
Eigen::Vector3d carrying_wrist(const CarryPlan& plan, formats::LimbName arm,
                               std::span<const formats::JointPose> pose_w);

}  // namespace swivel::tools
