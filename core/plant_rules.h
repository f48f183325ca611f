// SPDX-License-Identifier: MIT
//
// The constants of a group that plants, made from its swivel_plant; and how the shift of a body is eased.
#pragma once

namespace swivel {

// Lengths are in limb lengths, speeds in limb lengths a second. The bounds of speeds let none add more than
// `lock_radius` to the way of a point.
struct PlantRules {
    float lock_radius, unlock_radius, relock_speed, reset_time, stop_time, release_time;
    float ahead;                    // s: how long a point that locks goes on at its speed to its anchor
    float fastest_in, fastest_out;  // at a lock, and at a release
    float turn_in, turn_out;        // the same of half-tangents, 1/s
    float speed_on, speed_off, height_on, height_off;
};
inline constexpr double kShortestTime = 1e-6;  // s: shorter times to stop or to fade count as 0

inline constexpr double kShortestHalf = 1e-4;  // s
inline constexpr double kSettled = 60;         // stiffness times time, after which a spring rests, but for rounding
// Constants of a spring that makes up half of a distance from rest in the time `half`: its stiffness, 1/s, and the
// longest step, after which it rests.
struct SpringRule {
    float stiffness, longest;
};
constexpr SpringRule spring_rule(float half)
{
    const double stiffness = 1.678347 / (half > kShortestHalf ? double(half) : kShortestHalf);  // (1 + x) exp(-x) = 1/2
    return {static_cast<float>(stiffness), static_cast<float>(kSettled / stiffness)};
}

// How the feet of a group stand on ground. Lengths are in the bones' unit.
struct GroundRules {
    float heel[3];  // in the wrist joint's frame
    float toe_clearance, heel_clearance;
    float cos_half_max, sin_half_max;  // of the angle that a foot turns at most
    SpringRule lift;
};

}  // namespace swivel
