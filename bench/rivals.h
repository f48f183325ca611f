// SPDX-License-Identifier: MIT
//
// The textbook solvers that swivel is measured against: the same problem P, the same outputs, without swivel's guards
// for degenerate input and with no promise on bits. Both are built the way their users build them: -O3 -march=native
// -ffast-math.
#pragma once

#include "arms.h"

namespace bench {

// One arm at a time on glm: law of cosines, acos, a look-at frame, angleAxis. The arms are an array of structures.
struct SingleCrowd;
SingleCrowd* make_single(const Arms& arms);
void free_single(SingleCrowd* crowd);
void solve_single(SingleCrowd& crowd);
void read_single(const SingleCrowd& crowd, Poses& poses);

// The same formulas as a plain loop over arrays that the compiler turns into vectors, in three writings. Trig: acos and
// cosines (libmvec's) for flexion and lift, as textbooks have it. Light: the fastest we found that still goes through
// an angle, the flexion's; the lift by its cosine and a root. Roots: half-angle formulas throughout, no angle at all;
// the fastest loop we found.
void solve_loop_trig(const Arms& arms, Poses& poses);
void solve_loop_light(const Arms& arms, Poses& poses);
void solve_loop_roots(const Arms& arms, Poses& poses);

// Problem P's memory traffic and nothing else: of each block of 16 arms 8 rows are read and 7 written, past the cache
// where the CPU can.
void copy_rows(const float* input, float* results, std::size_t block_count);

const char* rival_compiler();

}  // namespace bench
