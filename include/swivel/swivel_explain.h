// SPDX-License-Identifier: MIT
//
// Answers about limbs and bodies in words and lines. They link apart from the solver: the target swivel::explain, or
// the shared library.
#pragma once

#include "swivel_bodies.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { SWIVEL_EXPLANATION_BYTES = 8192 };  // enough for every text
#define SWIVEL_EVERY_GROUP UINT32_MAX      // all groups of a body

// Explains a limb's state from its present inputs: which input is bad, how far out of reach the target is, which limit
// turned the elbow, why a point stands or slides, which unit or time looks wrong. SWIVEL_EVERY_GROUP: all groups of
// body `limb`, a line each. Body groups need WITH_RECORD. text gets at most size bytes, its 0 among them.
SWIVEL_API swivel_status swivel_explain(const swivel_crowd* crowd, uint32_t group, uint32_t limb, char* text,
                                        size_t size);

// Compares a pose, as a job has it, with where your engine has a limb of one body in the world, and says which input
// disagrees: the order of quaternions, form, space, a joint, a unit, an axis, the root. Call it for each limb when you
// bind a skeleton. *agrees, unless null: 1 where all are within 1e-3 of the limb's length, else 0.
SWIVEL_API swivel_status swivel_compare(const swivel_crowd* crowd, uint32_t group, uint32_t body,
                                        const swivel_pose* pose, const double shoulder[3], const double elbow[3],
                                        const double wrist[3], char* text, size_t size, int* agrees);

// Shapes of swivel_draw(), with their colours.
typedef enum swivel_shape_kind {
    SWIVEL_SHAPE_BONE,       // white: as solved, between joints that limbs and looks need, and from the root
    SWIVEL_SHAPE_INCOMING,   // grey: bones as they came; by a record, after looks
    SWIVEL_SHAPE_BEND,       // salmon: from the elbow as it came to where flexion carries the forearm
    SWIVEL_SHAPE_AXIS_X,     // red; these three: how a root, wanted hand or prop is turned
    SWIVEL_SHAPE_AXIS_Y,     // green
    SWIVEL_SHAPE_AXIS_Z,     // blue
    SWIVEL_SHAPE_TARGET,     // yellow: as written for a limb, look or prop
    SWIVEL_SHAPE_GOAL,       // orange: where a plant or grip sends its limb
    SWIVEL_SHAPE_MISS,       // red: from the wrist or effector to where it should be
    SWIVEL_SHAPE_EFFECTOR,   // light grey: from the wrist
    SWIVEL_SHAPE_POLE,       // magenta: from the elbow to or along its pole; from the shoulder along pole_behind
    SWIVEL_SHAPE_NORMAL,     // violet: the wished normal of the swivel plane
    SWIVEL_SHAPE_WISH,       // pink: the elbow without limits
    SWIVEL_SHAPE_ALLOWED,    // light green: arcs where limits allow the elbow
    SWIVEL_SHAPE_CONE,       // cyan: a limit of the upper arm or hand
    SWIVEL_SHAPE_REGION,     // teal: the border of the upper arm's region
    SWIVEL_SHAPE_ANCHOR,     // gold: a locked point, and a circle of unlock_radius
    SWIVEL_SHAPE_PROBE,      // sky blue: where ground is sampled, and the way there
    SWIVEL_SHAPE_GROUND,     // brown: a square of the plane below a foot, and its normal
    SWIVEL_SHAPE_SIGHT,      // lime: a line of sight, or an aiming hand's ray
    SWIVEL_SHAPE_SHIFT,      // purple: of the root
    SWIVEL_SHAPE_PROP,       // beige: from a prop to the grips on it
    SWIVEL_SHAPE_BAD_INPUT,  // crimson: the shoulder or root of a limb or group that has some
    SWIVEL_SHAPE_END
} swivel_shape_kind;

// A line, or a point, whose ends are equal.
typedef struct swivel_shape {
    // Bodies: in the world. Free limbs: in the space of their rows, from their origin; without WORLD in the arm frame.
    double from[3], to[3];
    const char* name;  // such as "bone"; a constant
    swivel_shape_kind kind;
    uint32_t color;  // 0xRRGGBBAA
    uint32_t group;  // SWIVEL_EVERY_GROUP: of the body itself
} swivel_shape;

// Draws a free limb, or a body with one or all of its groups, as lines and points for a debug renderer. Shapes that
// are not finite are left out. It allocates nothing, and threads may draw together.
//
// pose: of a body, the last solve's, which took all its groups, with the root as it went in. After swivel_load() solve
// first: all but what is carried is from before. Bones as they came need results apart from rotations, or WITH_RECORD,
// which misses, poles and limits of bodies also need.
// shapes: gets at most capacity of the *shape_count shapes, in a fixed order; null with capacity 0 asks for the count.
SWIVEL_API swivel_status swivel_draw(const swivel_crowd* crowd, uint32_t group, uint32_t limb, const swivel_pose* pose,
                                     swivel_shape* shapes, uint32_t capacity, uint32_t* shape_count);

#ifdef __cplusplus
}
#endif
