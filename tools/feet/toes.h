// SPDX-License-Identifier: MIT
//
// Toes that lie on the ground where a foot would press them into it. Knows clips and where their legs are.
#pragma once

#include "tools/feet/turn_legs.h"

namespace swivel::tools {

// Turns toes up where their tips would be in the ground: a foot that pushes off then stands on its toes, also in a clip
// whose toes never bend. A tip may be as far below the toe joint as at rest, plus the toe joint's height over the
// ground. Up is the normal of the foot's ground, as `placed` turns the foot. Toes bend about the foot's own axis
// across, by up to 90 degrees. Bends change by at most 360 degrees a second: they begin earlier and end later.
//
// clip, motion: with the feet placed, of a frame or more. Returns the toes that turn in some frame.
std::vector<TurnedJoint> bend_toes(const formats::Clip& clip, const LegMotion& motion, const PlacedFeet& placed,
                                   const Floor& floor);

}  // namespace swivel::tools
