// SPDX-License-Identifier: MIT
//
// The axis that elbow or knee turn about, where a skeleton does not say it: from the rest pose, the clip, or the way
// the figure faces. docs/rigs.md has the table. Knows clips, and by name what of a crowd file takes the place of a
// guess.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "tools/formats/clip.h"
#include "tools/formats/limb_name.h"
#include "tools/rig/figure_front.h"
#include "tools/rig/limb_chain.h"

namespace swivel::tools {

struct Hinge {
    Eigen::Vector3d axis;  // in the upper joint's axes, unit; flexion turns the lower bone about -axis
    std::string source;    // for people
};

// Where flexion carries the lower bone that turns about such an axis, both in the upper joint's axes: across the bone,
// unit.
Eigen::Vector3d bend_of_hinge(const Eigen::Vector3d& upper_bone, const Eigen::Vector3d& axis);

// A direction as a crowd file has it, to three decimals.
std::string toml_row(const Eigen::Vector3d& v);

// Why a front may be wrong: a limb that tells its hinge itself, as choose_hinge() has it, and has an elbow more than
// 120, a knee more than 90 degrees off the way that elbows and knees bend in a figure that faces so. Where none is
// within 60 degrees of that and shoulders or hips tell the front, left and right may be exchanged: then also, of the
// limbs that tell none themselves, the one bent most at rest, if by more than 2 degrees and more than 120 degrees off.
// Limbs that point where neither way is known are not asked. Empty if nothing speaks against it. joints: of the limbs
// in the order of formats::kLimbNames, those that are known.
std::string doubt_by_bends(const formats::Clip& clip, const std::array<std::optional<LimbJoints>, 4>& joints,
                           const Front& front);

// What the limb tells itself: the rest pose's bend, above 20 degrees, unless the clip's mean bend is twice as large and
// more than 30 degrees off, or larger and more than 120 degrees off; from 5 to 20 degrees if the clip bends it, too,
// and neither twice as much and more than 30 degrees off nor more than 60 degrees off; else the clip's mean bend, from
// one degree, if it keeps its side and leaves the rest pose's by a degree. If it tells nothing: elbows bend forwards
// and knees backwards, or the rest pose's bend above half a degree if it is within 45 degrees of that, above 5 if
// within 60. rest: of the chain; parent_w: the upper joint's parent at rest.
// Throws CannotBind where the limb tells nothing itself and the rest pose bends by more than 5 degrees and otherwise,
// or by less and front is in doubt, or where it points so that neither way is known: an arm ahead, behind or overhead,
// a leg that does not hang.
Hinge choose_hinge(const formats::Clip& clip, formats::LimbName limb, const LimbChain& chain, const ChainPose& rest,
                   const formats::JointPose& parent_w, const Front& front);

}  // namespace swivel::tools
