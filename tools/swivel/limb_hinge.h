// SPDX-License-Identifier: MIT
//
// The axis that elbow or knee turn about, where a skeleton does not say it: from the rest pose, the clip, or the way
// the figure faces. docs/rigs.md has the table. Knows clips alone.
#pragma once

#include <string>

#include "tools/formats/clip.h"
#include "tools/formats/limb_name.h"
#include "tools/swivel/figure_front.h"
#include "tools/swivel/limb_chain.h"

namespace swivel::tools {

struct Hinge {
    Eigen::Vector3d axis;  // in the upper joint's axes, unit; flexion turns the lower bone about -axis
    std::string source;    // for people
};

// The first of: the rest pose's bend, above 5 degrees, unless the clip's mean bend is twice as large and more than 30
// degrees off, or larger and more than 120 degrees off; the clip's mean bend, from one degree and if it keeps its side;
// the rest pose's bend above half a degree, if it is within 45 degrees of the table's; elbows bend forwards and knees
// backwards (upwards and downwards where the bone itself points that way). rest: of the chain; parent_w: the upper
// joint's parent at rest. Throws CannotBind where no clip tells, the rest pose is bent by up to 20 degrees, and front
// is in doubt or the bend, above 5 degrees, more than 60 degrees off the table's.
Hinge choose_hinge(const formats::Clip& clip, formats::LimbName limb, const LimbChain& chain, const ChainPose& rest,
                   const formats::JointPose& parent_w, const Front& front);

}  // namespace swivel::tools
