// SPDX-License-Identifier: MIT
//
// A box in both hands: its place at the chest, and the wrists' places at the box. Knows clips, and what a crowd
// file asks for.
#pragma once

#include <span>
#include <string>

#include "tools/formats/crowd_file.h"
#include "tools/rig/limbs.h"

namespace swivel::tools {

struct CarryPlan {
    double share;  // of the characters, chosen by the seed
    // The box, of a figure of size 1 in the world's unit. Its sides are to the left, up and ahead, as the figure is at
    // rest; its middle is counted from the middle between the shoulders.
    Eigen::Vector3d size, place;
    int chest;                // the joint that the box moves with: where both arms meet
    Eigen::Vector3d middle;   // in the chest's axes and unit
    Eigen::Vector3d palm;     // from the middle of the box's left side to that wrist, in the box's axes
    Eigen::Quaterniond turn;  // from the box's axes to the chest's
    double left;              // where the left arm is along the box's x: 1, or -1 in a mirror
};

// Why the figure cannot carry a box, and what to do; empty if it can. It needs both arms, and a joint where they meet.
std::string why_not_carry(const formats::Clip& clip, std::span<const Limb> limbs);

// asked: a box without a size or place gets one that suits the arms. shortest: the shortest arms of the crowd, as a
// share of the clip's own. up_w, faces_w: of the figure at rest, unit, at right angles. The figure must be able to
// carry.
CarryPlan plan_carry(const formats::Clip& clip, std::span<const Limb> limbs, const formats::CarrySettings& asked,
                     double shortest, const Eigen::Vector3d& up_w, const Eigen::Vector3d& faces_w);

// Where an arm's wrist is at the box's side, in the world. pose_w: of one frame of the clip.
Eigen::Vector3d carrying_wrist(const CarryPlan& plan, formats::LimbName arm,
                               std::span<const formats::JointPose> pose_w);

}  // namespace swivel::tools
