// SPDX-License-Identifier: MIT
//
// Moves a clip's body and turns its legs to bring its feet to their places. The library solves the legs as bodies, one
// for each frame. Knows clips, limbs and the public interface.
#pragma once

#include "tools/feet/place_feet.h"

namespace swivel::tools {

// New local values of one joint, one for each frame; of a leg's joints rotations, of the carrier translations.
struct TurnedJoint {
    int joint;
    std::vector<Eigen::Quaterniond> rotation;
    std::vector<Eigen::Vector3d> translation;
};

// legs: those of the motion, in its order. Throws InputError, naming `file` and the frame, where a leg cannot be
// solved: below a mirror, below scales that are not uniform, and beyond 1e15.
std::vector<TurnedJoint> turn_legs(const formats::Clip& clip, std::span<const Limb> legs, const LegMotion& motion,
                                   const PlacedFeet& placed, const std::filesystem::path& file);

// The clip with these values.
formats::Clip with_joints(formats::Clip clip, std::span<const TurnedJoint> joints);

// Turns toes up where their tips would be in the ground: a foot that pushes off then stands on its toes, also in a clip
// whose toes never bend. A tip may be as far below the toe joint as at rest, plus the toe joint's height over the
// ground. Up is the normal of the foot's ground, as `placed` turns the foot. Toes bend about the foot's own axis
// across, by up to 90 degrees. Bends change by at most 360 degrees a second: they begin earlier and end later.
//
// clip, motion: with the feet placed, of a frame or more. Returns the toes that turn in some frame.
std::vector<TurnedJoint> bend_toes(const formats::Clip& clip, const LegMotion& motion, const PlacedFeet& placed,
                                   const Floor& floor);

}  // namespace swivel::tools
