// SPDX-License-Identifier: MIT
//
// Which way a figure faces, told from its limbs at rest. Knows clips alone.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "tools/formats/clip.h"
#include "tools/swivel/limb_joints.h"

namespace swivel::tools {

// Which way a figure faces and stands at rest, in the world; unit.
struct Front {
    Eigen::Vector3d forwards = Eigen::Vector3d::UnitZ();
    Eigen::Vector3d up = Eigen::Vector3d::UnitY();
    std::string source = "the file's +Z";     // of forwards, for people
    std::string up_source = "the file's +Y";  // of up
    std::string doubt;                        // why either may be wrong, for people; empty: nothing speaks against them
};

// joints: of the limbs in the order of formats::kLimbNames, those that are known. By the toes, all joints
// below the feet called toe or ball or else the only one, where they point within 60 degrees of what comes next or, if
// called so, of its opposite; else by shoulders (or hips) from right to left and up, mirrors considered; else +Z, as
// glTF has it. Up is from the hips to the shoulders, or along the legs, or +Y.
// In doubt is what faces by a pair below a mirror, which may or may not have exchanged left and right; a pair one above
// the other; and where the file's axes are taken, a trunk more than 60 degrees off +Y and a limb not on its side of it.
Front figure_front(const formats::Clip& clip, const std::array<std::optional<LimbJoints>, 4>& joints);

}  // namespace swivel::tools
