// SPDX-License-Identifier: MIT
//
// The constants of a group that plants, made from its swivel_plant, and of the springs that ease shifts and lifts.
#pragma once

namespace swivel {

// Lengths are in limb lengths, speeds in limb lengths a second. Speeds are bounded so that no change moves a point by
// more than `lock_radius`.
struct PlantRules {
    float lock_radius, unlock_radius, relock_speed, reset_time, stop_time, release_time;
    float ahead;                    // s: a point locks as far ahead as it goes in this time
    float fastest_in, fastest_out;  // at a lock, and at a release
    float turn_in, turn_out;        // the same for half-tangents, 1/s
    float speed_on, speed_off, height_on, height_off;
};
inline constexpr double kShortestTime = 1e-6;  // s: shorter times to stop or to fade count as 0

inline constexpr double kShortestHalf = 1e-4;  // s
inline constexpr double kSettled = 60;         // stiffness times time after which a spring is at rest within rounding
// A spring's stiffness, 1/s, and the longest step that matters: after it the spring is at rest. half: the time, s, in
// which the spring covers half of its distance from rest.
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
    float cos_half_max, sin_half_max;  // of half the max angle that a foot turns
    SpringRule lift;
};

}  // namespace swivel
