// SPDX-License-Identifier: MIT
//
// Which way a figure faces, told from its limbs at rest. Knows clips alone.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "tools/formats/clip.h"
#include "tools/rig/limb_joints.h"

namespace swivel::tools {

// Which way a figure faces and stands at rest, in the world; unit.
struct Front {
    Eigen::Vector3d forwards = Eigen::Vector3d::UnitZ();
    Eigen::Vector3d up = Eigen::Vector3d::UnitY();
    std::string source = "the file's +Z";     // of forwards, for people
    std::string up_source = "the file's +Y";  // of up
    std::string doubt;                        // why either may be wrong, for people; empty: nothing speaks against them
    bool is_told = false;                     // forwards is the figure's own, not the file's
    bool is_by_named_toes = false;            // which tell forwards without left and right
};

// joints: of the limbs in the order of formats::kLimbNames, those that are known. Up is from the hips to the shoulders,
// else along the legs, else +Y. Forwards is where the toes point (all joints right below both feet called toe or ball,
// or else the only one), unless they point steeply; else from right to left and up, by shoulders or else hips, mirrors
// considered; else +Z, as glTF has it. Pairs closer together than a quarter of their upper bones do not tell, nor a
// trunk shorter than a tenth of a leg, nor a leg folded to less than 0.3 of its length. In doubt is
// - what some of these tell otherwise than others by more than 60 degrees, unless a mirror above explains the toes;
// - limbs on no common joint, or on one that is farther from the hips than three quarters of a leg;
// - a pair of limbs of which nothing tells left from right, or which is below a mirror and without toes;
// - an arm that crosses the body, a leg more than 60 degrees off the trunk, a foot more than 45 degrees off forwards:
//   such limbs are turned about their own bones, too;
// - where the file's axes are taken: a trunk, leg or what an arm hangs on more than 60 degrees off +Y, a limb on the
//   wrong side of a figure that faces +Z, limbs that do not say where their side is. (Where nothing is above a limb
//   that could speak against +Y it is taken, as files of every kind keep to it.)
Front figure_front(const formats::Clip& clip, const std::array<std::optional<LimbJoints>, 4>& joints);

}  // namespace swivel::tools
