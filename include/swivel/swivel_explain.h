// SPDX-License-Identifier: MIT
//
// Answers about single limbs in words, for tools, and for binding a skeleton. They link apart from the solver: the
// target swivel::explain, or the shared library.
#pragma once

#include "swivel_bodies.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { SWIVEL_EXPLANATION_BYTES = 8192 };  // enough for every text
#define SWIVEL_EVERY_GROUP UINT32_MAX      // for swivel_explain(): all groups of a body

// Explains a limb's state in a sentence or two, from its present inputs: the input that is bad, how far out of reach
// the target is, the limit that turned the elbow, why a point stands or slides, and which unit or time looks wrong.
// With SWIVEL_EVERY_GROUP it explains all groups of body `limb`, a line each. Body groups need WITH_RECORD. text gets
// at most size bytes, its 0 among them.
SWIVEL_API swivel_status swivel_explain(const swivel_crowd* crowd, uint32_t group, uint32_t limb, char* text,
                                        size_t size);

// Compares a pose, as a job has it, with where your engine has a limb of one body in the world, and says which input
// disagrees: the order of quaternions, the form or the space, another joint, a unit, an axis, the root. Call it for
// each limb when you bind a skeleton. agrees: unless null, becomes 1 where all are within 1e-3 of the limb's length,
// else 0.
SWIVEL_API swivel_status swivel_compare(const swivel_crowd* crowd, uint32_t group, uint32_t body,
                                        const swivel_pose* pose, const double shoulder[3], const double elbow[3],
                                        const double wrist[3], char* text, size_t size, int* agrees);

#ifdef __cplusplus
}
#endif
