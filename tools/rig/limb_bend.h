// SPDX-License-Identifier: MIT
//
// Which way an elbow or a knee bends. docs/rigs.md has the rule. Knows clips alone.
#pragma once

#include <Eigen/Geometry>
#include <string>

#include "tools/formats/clip.h"
#include "tools/formats/limb_name.h"
#include "tools/rig/facing.h"
#include "tools/rig/limb_chain.h"

namespace swivel::tools {

struct Bend {
    Eigen::Vector3d direction;  // where flexion carries the lower bone: in the upper joint's axes, unit
    std::string source;         // who says so, for people
};

// The rest pose and the clip are asked, in this order. The first that bends the limb clearly is taken, else the first
// that bends it at all.
// - The rest pose bends it by more than 10 degrees, and clearly by more than 20. Its sine counts: a limb folded by 170
//   tells as little as a straight one.
// - The clip bends it by more than 10 degrees in the mean. It is clear above 30, and one way in nine of ten frames.
//   The mean is of the cross products of the unit bones, in the upper joint's axes, so that noise cancels.
// Where neither tells it, the body does: elbows bend forwards and knees backwards in a figure that faces so.
//
// rest: of the chain; parent_w: the upper joint's parent at rest. Throws CannotBind where the body must tell and the
// upper bone points within 30 degrees along that way, or against it; the advice has a bend to write.
Bend choose_bend(const formats::Clip& clip, formats::LimbName limb, const LimbChain& chain, const ChainPose& rest,
                 const formats::JointPose& parent_w, const Facing& facing);

// What the clip says against a bend: it bends the limb to the other side, in the mean, and by more than 30 degrees in
// some frame. One line for people that offers the clip's bend for a crowd file; empty if nothing does.
std::string clip_against(const formats::Clip& clip, formats::LimbName limb, const LimbChain& chain,
                         const ChainPose& rest, const Eigen::Vector3d& bend);

}  // namespace swivel::tools
