// SPDX-License-Identifier: MIT
//
// Axes and ranges that help to write a limb's limits: the directions of its own frame's axes, and the range of a clip's
// bones in that frame. For reports alone: it uses arc functions, which solves may not. Knows clips and limbs.
#pragma once

#include <optional>
#include <string>

#include "tools/rig/limb_bind.h"

namespace swivel::tools {

// A direction of the world in the figure's words: "left", or between two axes "left and down".
std::string direction_words(const Eigen::Vector3d& direction_w, const Facing& facing);

// The min and max of an angle, in degrees.
struct AngleRange {
    double min = 180, max = 0;
};

// Limits of a crowd file that all frames of a clip keep if the limb is bound with this bend: the frame's x and y turn
// with the bend.
struct LimbRange {
    Eigen::Vector3d bend;  // the limb's to three decimals, in the upper joint's axes; near 1 long
    Eigen::Vector3d axis;  // the upper bone's mean direction in the frame of that bend, to three decimals
    double opening_deg;    // the upper bone's largest angle to it, up to the next tenth
    AngleRange from_z;     // the upper bone's angle to the frame's z, where it lies at rest
    AngleRange flexion;    // the angle between both bones, outwards to the next tenth
};

// Nothing for a clip of one frame, or a limb that never moves by a tenth of a degree, such as in a T-pose. Looks at
// frames only: the motion between them may leave the range.
std::optional<LimbRange> range_of(const formats::Clip& clip, const Limb& limb);

}  // namespace swivel::tools
