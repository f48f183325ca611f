// SPDX-License-Identifier: MIT
//
// The axis that elbow or knee turn about, where a skeleton does not say it: from the rest pose, the clip, or the way
// the figure faces. docs/rigs.md has the table. Knows clips alone.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "tools/formats/clip.h"
#include "tools/formats/limb_name.h"
#include "tools/swivel/limb_chain.h"

namespace swivel::tools {

// Which way a figure faces and stands at rest, in the world; unit.
struct Front {
    Eigen::Vector3d forwards = Eigen::Vector3d::UnitZ();
    Eigen::Vector3d up = Eigen::Vector3d::UnitY();
    std::string source = "the file's +Z";     // of forwards, for people
    std::string up_source = "the file's +Y";  // of up
};

// joints: of the limbs in the order of formats::kLimbNames, those that are known. By the toes, all joints
// below the feet called toe or ball or else the only one, where they point within 60 degrees of what comes next or, if
// called so, of its opposite; else by shoulders (or hips) from right to left and up, mirrors considered; else +Z, as
// glTF has it. Up is from the hips to the shoulders,
// or along the legs, or +Y.
Front figure_front(const formats::Clip& clip, const std::array<std::optional<LimbJoints>, 4>& joints);

struct Hinge {
    Eigen::Vector3d axis;  // in the upper joint's axes, unit; flexion turns the lower bone about -axis
    std::string source;    // for people
};

// The first of: the rest pose's bend, from 5 degrees, unless the clip's mean bend is twice as large and more than 30
// degrees off, or larger and more than 120 degrees off; the clip's mean bend, from one degree and if it keeps its side;
// the rest pose's bend from half a degree, if it is within 45 degrees of the table's; elbows bend forwards and knees
// backwards (upwards and downwards where the bone itself points that way). rest: of the chain; parent_w: the upper
// joint's parent at rest.
Hinge choose_hinge(const formats::Clip& clip, formats::LimbKind kind, const LimbChain& chain, const ChainPose& rest,
                   const formats::JointPose& parent_w, const Front& front);

}  // namespace swivel::tools
