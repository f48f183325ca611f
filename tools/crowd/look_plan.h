// SPDX-License-Identifier: MIT
//
// Heads that look at a point: the joints that turn, and the solver's constants of them. A look is one more limb of a
// crowd: see goal_source. Knows clips and the solver's terms; no file format.
#pragma once

#include <span>
#include <vector>

#include "tools/crowd/limb_setup.h"
#include "tools/rig/body_parts.h"
#include "tools/rig/limbs.h"

namespace swivel::tools {

struct LookPlan {
    std::vector<int> joints;  // of the clip: one to three, each the parent of the next; the last one is the head
    LimbSetup setup;
};

// The joints of neck and head, from the head inwards as far as no limb hangs below them and none is mirrored or changes
// its size. Empty: no such head is known.
std::vector<int> look_joints(const formats::Clip& clip, const std::vector<BodyPart>& body, std::span<const Limb> limbs);
// The direction of the face, in the axes of the head's joint. faces_w: the figure's forwards at rest.
Eigen::Vector3d face_of(const formats::Clip& clip, int head, const Eigen::Vector3d& faces_w);

// joints: of look_joints(), at least one. target_w: the point that all heads look at. max: each joint's max turn,
// radians.
LookPlan plan_look(const formats::Clip& clip, std::vector<int> joints, const Eigen::Vector3d& faces_w,
                   const Eigen::Vector3d& target_w, double max);

// The source of one frame. pose_w: of the clip. root: the limbs' root.
goal_source look_source(const formats::Clip& clip, std::span<const int> joints,
                        std::span<const formats::JointPose> pose_w, const Eigen::Vector3d& root);

}  // namespace swivel::tools
