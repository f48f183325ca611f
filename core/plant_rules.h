// SPDX-License-Identifier: MIT
//
// What the limbs of a group that plants share, made from its swivel_plant.
#pragma once

namespace swivel {

// Lengths are in limb lengths, speeds in limb lengths a second. The bounds of speeds let none add more than `lock` to
// the way of a point.
struct PlantRules {
    float lock, unlock, again, longest, stop, blend;
    float ahead;                    // s: how long a point that locks goes on at its speed to its anchor
    float fastest_in, fastest_out;  // at a lock, and at a release
    float turn_in, turn_out;        // the same of half-tangents, 1/s
    float speed_on, speed_off, height_on, height_off;
};
inline constexpr double kShortestTime = 1e-6;  // s: a shorter one to stop or to fade is none

}  // namespace swivel
