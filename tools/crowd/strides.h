// SPDX-License-Identifier: MIT
//
// The ground of a foot whose clip walks on a level floor: one plane while it stands, and in a swing a plane that goes
// smoothly from one stand's to the next one's. So steps, curbs and gaps cause no jerks. Only + - * /, floor and sqrt,
// so all CPUs agree.
#pragma once

#include <span>

#include "tools/crowd/goals.h"

namespace swivel::tools {

// Heights and positions are in the world.
struct Stride {
    double plane[3];   // a point of its plane: below the toe, which is moved aside from an edge that it cannot stand on
    double slopes[2];  // of the plane, along x and z
    double room;       // how far the toe is above its clearance over the clip's floor; at least 0
    double levels[2];  // heights of the stand that it comes from, and of the next one
    double share;      // of the way from the one to the other, 0 to 1; 0 while it stands
};

// The stride of a leg in a frame of its clip. sources: of the leg, one for each frame. character: not yet raised to the
// ground. Any thread; no allocation.
Stride stride_at(const goal_plan& plan, const goal_source* sources, uint32_t frame, const goal_character& character,
                 const goal_ground& ground, const float* heights);

// The height of the ground below a body: its lower foot's. A foot that has gone a share of its way counts by that share
// at its next stand and else at its last one; each combination of feet counts by the product of their shares. So a body
// rises while a foot swings, and not before the foot behind has left its step. strides: one or more.
double body_level(std::span<const Stride> strides);

}  // namespace swivel::tools
