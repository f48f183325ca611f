// SPDX-License-Identifier: MIT
//
// The limb that productions ask for: a goal in the world, a skeleton's rotations, a hand, the incoming pose with
// weights, soft reach, a flexion limit and a shoulder cone. It comes from an engine's own structures of 308 bytes.
#pragma once

#include "bench/rivals/framed_crowd.h"
#include "bench/rivals/frames.h"
#include "bench/rivals/limbs.h"

namespace bench {

inline constexpr swivel_features kProduction = kFullArm | SWIVEL_JOINTS | SWIVEL_WITH_REACH;

struct ProductionLimb {
    JointPose parent;          // in the world; the position is the shoulder's
    float incoming[3][4];      // local rotations of shoulder, elbow and wrist, before
    float solved[3][4];        // and after
    float target[4], pole[4];  // points in the world
    float hand[4];             // wanted orientation in the world
    float lengths[2], weights[3], reach[4], flexion[2], cone[4];
    float stretch;
    std::uint32_t flags;
    float other[12];  // what an engine keeps beside
};
static_assert(sizeof(ProductionLimb) == 308);

// A crowd of made-up limbs whose frame views these structures. It fills them first.
FramedCrowd production_crowd(std::vector<ProductionLimb>& limbs);

}  // namespace bench
