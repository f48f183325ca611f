// SPDX-License-Identifier: MIT
//
// The constants that formulas take: of plants and grounds as their definition gives them, with what is made of these
// once, of looks, of the half-lines by which elbows point, and of springs.
#pragma once

#include <cstdint>

#include "include/swivel/swivel_bodies.h"

namespace swivel {

inline constexpr double kShortestTime = 1e-6;  // s: shorter times to stop or to fade count as 0

// Lengths are in limb lengths, speeds in limb lengths a second. Speeds are bounded so that no change moves a point by
// more than `lock_radius`.
struct PlantRules {
    swivel_plant given;
    float ahead;                    // s: a point locks as far ahead as it goes in this time
    float fastest_in, fastest_out;  // at a lock, and at a release
    float turn_in, turn_out;        // the same for half-tangents, 1/s
};
constexpr PlantRules plant_rules(const swivel_plant& given)
{
    const auto per = [](float time) { return 1 / (time > kShortestTime ? double(time) : kShortestTime); };
    const double lock = given.lock_radius;
    return {.given = given,
            .ahead = static_cast<float>(double(given.anchor_lead) * given.stop_time / 3),
            .fastest_in = static_cast<float>(3 * lock * per(given.stop_time)),
            // An offset swings out by at most 4/27 of speed times time.
            .fastest_out = static_cast<float>(6.75 * lock * per(given.release_time)),
            .turn_in = static_cast<float>(per(given.stop_time)),
            .turn_out = static_cast<float>(2 * per(given.release_time))};
}

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
    swivel_ground given;
    float cos_half_max, sin_half_max;  // of half the max angle that a foot turns
    SpringRule lift;
};

// The rules of one joint that looks.
struct LookJoint {
    float share;                       // of the turn that is left
    float cos_half_max, sin_half_max;  // of half the joint's max turn
};
// A look fades by the cosine between the incoming line of sight and the line to the target, and by distance.
struct LookFade {
    float cos_none, per_cos;  // per_cos: 1 / (cos_full - cos_none)
    float distance;
};
inline constexpr std::uint32_t kMaxLookJoints = 8;
struct LookRules {
    LookJoint joint[kMaxLookJoints];
    LookFade fade;
    float eye[3], axis[3];  // in the last joint's frame; axis: unit
    float rate;             // radians a second; 0: not eased
};

// With SWIVEL_POLE_HALF_LINE the mirror that turns `behind` into the line to the wrist turns `normal` into the swivel
// plane's normal. Both are unit vectors of the arm frame, at right angles.
struct HalfLine {
    float behind[3], normal[3];
};

}  // namespace swivel
