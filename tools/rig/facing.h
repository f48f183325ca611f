// SPDX-License-Identifier: MIT
//
// A figure's front and up at rest. Knows clips alone.
#pragma once

#include <string>
#include <vector>

#include "tools/formats/clip.h"
#include "tools/rig/limb_joints.h"

namespace swivel::tools {

// In the world, unit.
struct Facing {
    Eigen::Vector3d forwards_w = Eigen::Vector3d::UnitZ();
    Eigen::Vector3d up_w = Eigen::Vector3d::UnitY();
    std::string forwards_source = "the file's +Z";  // the source of forwards, for people
    std::string up_source = "the file's +Y";
};

// Up leads from the hips to the shoulders, else it is +Y. Forwards is where the toes point, as toes_of() has them.
// Without toes it is at right angles to up and to the line from right to left, of the shoulders or else of the hips. A
// mirror above exchanges left and right. Else it is +Z, as in glTF. Toes and lines within 30 degrees of up are ignored.
Facing facing_of(const formats::Clip& clip, const KnownLimbs& joints);

}  // namespace swivel::tools
