// SPDX-License-Identifier: MIT
//
// Reach regions: where the upper arm may point, for groups WITH_REGION. A region is a union of parts, each an
// intersection of half-spaces; forbidden cones are cut out of all parts. Directions are in the arm frame at rest: see
// swivel_arm_axis(). docs/howto/limits.md has pictures.
#pragma once

#include "swivel.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { SWIVEL_MAX_HALF_SPACES = 64, SWIVEL_MAX_REGION_PARTS = 24 };

// The directions whose scalar product with the axis is at least the cosine.
typedef struct swivel_half_space {
    float axis[3];     // unit
    float cosine;      // -1..1
    uint32_t is_edge;  // 0: its boundary bounds nothing
} swivel_half_space;

typedef struct swivel_region {
    size_t size;
    uint32_t cut_count;                           // the first half-spaces, which hold for all parts
    uint32_t part_count;                          // part n is half_space[first[n]] to half_space[first[n + 1] - 1]
    uint32_t first[SWIVEL_MAX_REGION_PARTS + 1];  // first[0] is cut_count
    swivel_half_space half_space[SWIVEL_MAX_HALF_SPACES];
} swivel_region;

// It allows nothing; add to it and forbid in any order.
static inline swivel_region swivel_default_region(void)
{
    swivel_region region;
    memset(&region, 0, sizeof region);
    region.size = sizeof region;
    return region;
}

typedef struct swivel_region_cone {
    float axis[3];  // of any length but zero
    float angle;    // max angle to the axis, 0.01 to pi - 0.01
} swivel_region_cone;

// Adds cones in order, with a bridge between neighbours, which may not be opposite. closed: not 0 to bridge the last
// cone and the first, too. A cone takes one half-space, a bridge four or eight.
SWIVEL_API swivel_status swivel_region_add_cones(swivel_region* region, const swivel_region_cone* cones, uint32_t count,
                                                 uint32_t closed);
// Adds a convex polygon of 3 corners or more, counter-clockwise as seen from outside; its sides are arcs of great
// circles. corners: x, y, z of each, of any length but zero.
SWIVEL_API swivel_status swivel_region_add_polygon(swivel_region* region, const float* corners, uint32_t count);
// Adds 1 to max_cones cones that hold all these directions, each with `margin` radians around it, 0.01 to 1. max_cones:
// 1 to 6. Takes about 0.05 ms a direction.
SWIVEL_API swivel_status swivel_region_add_directions(swivel_region* region, const float* directions, uint32_t count,
                                                      float margin, uint32_t max_cones);
// Cuts a cone out of all parts, also of later ones.
SWIVEL_API swivel_status swivel_region_forbid(swivel_region* region, const swivel_region_cone* cone);
// The region of the same limb on the body's other side, as swivel_mirror() has it. from and to may be the same.
SWIVEL_API swivel_status swivel_region_mirror(const swivel_region* from, swivel_region* to);
// The margin of a direction of any length but zero, as a difference of cosines: 0 or more where it is allowed.
SWIVEL_API swivel_status swivel_region_room(const swivel_region* region, const float direction[3], float* room);

#ifdef __cplusplus
}
#endif
