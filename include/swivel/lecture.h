// SPDX-License-Identifier: MIT
//
// For people who learn or check the formulas. It gives the lecture's five steps for one arm, entity by entity, and
// checks swivel's formulas against them. Source: D. Hildenbrand, Inverse Kinematics of a Virtual Character (TU
// Darmstadt, 2019). swivel_solve() takes other formulas, which hold for every arm. The static library swivel_lecture
// has these functions and needs no other library. Any thread may call them. They allocate nothing, and do not depend on
// the caller's floating-point environment.
#pragma once

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// An entity. It has one coefficient for each of the 32 blades of G(4,1). Bits 0 to 4 of a blade's number say whether
// e1, e2, e3, einf and e0 are in it. A blade with exactly two of e1, e2 and e3 uses the lecture's units i = e3^e2, j =
// e1^e3 and k = e2^e1, such as k^einf. swivel_blade_name() names every blade. A cosine has a scalar part alone.
typedef struct swivel_entity {
    const char* name;     // as the lecture calls it, such as "S1"; a constant, as is the next
    const char* meaning;  // in a few words
    uint32_t step;        // 1 to 5
    double coefficients[32];
} swivel_entity;

enum { SWIVEL_ENTITY_COUNT = 18 };

// The entities of one arm, in the order of the steps, in double, in the arm frame. All lengths are in one unit, the
// caller's.
// target: where the wrist goes, 3 components of at most 1e15 in magnitude.
// pole: a point on the elbow's side, 3 components, likewise; at least 1e-15 from the shoulder.
// upper, fore: the bones' lengths, 1e-15..1e15.
// closing_error: becomes the distance from the target to the wrist that the rotors give, in arm lengths.
//
// Returns null if the arm has its entities. Otherwise it returns one line that says why, and writes nothing: for values
// outside these ranges, and for an arm whose formulas divide by zero. Such an arm has its target out of reach or on the
// shoulder, or is straight or folded. Or its pole is on the line to the target, or its upper arm along e3 or -e3. The
// line is this thread's until its next call. No pointer may be null.
const char* swivel_steps(const double target[3], const double pole[3], double upper, double fore,
                         swivel_entity entities[SWIVEL_ENTITY_COUNT], double* closing_error);
// The name of a blade, such as "e1^einf"; null from 32 on.
const char* swivel_blade_name(uint32_t blade);

// One line of a check: an error measured over many arms against its limit.
typedef struct swivel_check {
    const char* name;  // what is compared, e.g. "production<float>, wrist to target"
    const char* set;   // over which arms, e.g. "reach 5-98 %"
    uint64_t arm_count;
    double max, rms;              // in arm lengths, or as the name says
    double max_limit, rms_limit;  // an rms_limit of 0: not limited
} swivel_check;

// Checks the formulas. It compares the lecture's steps with a slow reference implementation, and the solver's wrists
// with their targets by forward kinematics. The solver's check takes arm_count random arms in each of five bands of
// reach, with bone ratios from 1:1 to 1000:1. The steps' check takes a hundredth of them, 100 to 4,000, away from the
// arms that have no steps. Hard poses are the same in every call. It calls report, unless that is null, once for each
// line, in the caller's floating-point environment. Returns 1 if every limit was kept and there were arms, else 0.
// Takes about a microsecond an arm. The same seed gives the same arms everywhere.
int swivel_verify(uint64_t arm_count, uint64_t seed, void (*report)(const swivel_check* check, void* user), void* user);

#ifdef __cplusplus
}
#endif
