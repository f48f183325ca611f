// SPDX-License-Identifier: MIT
//
// The axes and ranges by which one writes a limb's limits: which way its own frame's axes point, and where a clip takes
// its bones in that frame. For reports alone: angles are taken by arc functions, which nothing that is solved may.
// Knows clips and limbs.
#pragma once

#include <optional>
#include <string>

#include "tools/rig/limb_bind.h"

namespace swivel::tools {

// A direction of the world as the figure itself says it: "left", or of what lies between "left and down".
std::string direction_words(const Eigen::Vector3d& direction_w, const Facing& facing);

// The least and the most of an angle, in degrees.
struct AngleRange {
    double min = 180, max = 0;
};

// Where all of a clip lies, as a crowd file's limits say it. All frames fit into them, if the limb is bound with this
// bend: the frame's x and y turn with it.
struct LimbRange {
    Eigen::Vector3d bend;  // the limb's to three decimals, in the upper joint's axes; near 1 long
    Eigen::Vector3d axis;  // the upper bone's mean direction in the frame of that bend, to three decimals
    double opening_deg;    // the upper bone's largest angle to it, up to the next tenth
    AngleRange from_z;     // the upper bone's angle to the frame's z, where it lies at rest
    AngleRange flexion;    // the angle between both bones, outwards to the next tenth
};

// Nothing for a clip of one frame, and for a limb that never moves by a tenth of a degree: a T-pose tells no limits.
// Takes every frame's pose of the limb: what lies between frames may leave the range.
std::optional<LimbRange> range_of(const formats::Clip& clip, const Limb& limb);

}  // namespace swivel::tools
