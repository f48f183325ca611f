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

// joints: of the limbs in the order of formats::kLimbNames, those that are known. Up is from the hips to the shoulders,
// else along the legs, else +Y. Forwards is where the toes point (all joints below the feet called toe or ball, or else
// the only one), unless they point steeply; else from right to left and up, by shoulders or else hips, mirrors
// considered; else +Z, as glTF has it. In doubt is what some of these tell otherwise than others by more than 60
// degrees; joints that do not hang on one trunk; shoulders and hips too close together to tell left from right, without
// toes; a figure below a mirror and without toes, whose left and right may or may not be exchanged; and where the
// file's axes are taken, a trunk or leg more than 60 degrees off +Y, a limb not on its own side, and one that does not
// say where its side is.
Front figure_front(const formats::Clip& clip, const std::array<std::optional<LimbJoints>, 4>& joints);

}  // namespace swivel::tools
