// SPDX-License-Identifier: MIT
//
// The constants of a look (look.h).
#pragma once

#include <cstdint>

namespace swivel {

// The rules of one joint.
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

}  // namespace swivel
