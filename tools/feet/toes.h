// SPDX-License-Identifier: MIT
//
// Toes that lie on the ground where a foot would press them into it. Knows clips and where their legs are.
#pragma once

#include "tools/feet/turn_legs.h"

namespace swivel::tools {

// Turns toes up where their tips would be in the ground: a foot that pushes off then stands on its toes, also in a clip
// whose toes never bend. A tip may be as deep below the toe as it is at rest, and deeper by what the toe is over the
// ground. Up is where the foot's ground leads up, as `placed` has it. No bend grows or fades faster than 360 degrees a
// second: it begins earlier.
//
// clip, motion: with the feet placed. Returns the toes that turn in some frame.
std::vector<TurnedJoint> bend_toes(const formats::Clip& clip, const LegMotion& motion, const PlacedFeet& placed,
                                   const Floor& floor);

}  // namespace swivel::tools
