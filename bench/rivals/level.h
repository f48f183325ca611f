// SPDX-License-Identifier: MIT
//
// The textbook solvers that swivel is measured against: the same problem P, the same outputs, without swivel's guards
// for degenerate input and with no promise on bits. Built the way their users build them, -O3 -ffast-math, once for
// each level of CPUs, so that a kernel meets loops in registers of its own width.
#pragma once

#include <vector>

#include "bench/rivals/arms.h"
#include "bench/rivals/character.h"
#include "bench/rivals/frames.h"

namespace bench {

// The textbook formula as a loop over arrays.
struct Loop {
    const char* name;
    const char* how;  // what the compiler made of it
    void (*solve)(const Arms& arms, Poses& poses);
};

// An arm and its pose as people keep them who solve one at a time.
struct SingleArm {
    float target[3], pole[3], upper, fore;
};
struct SinglePose {
    float shoulder[4];  // x, y, z, w
    float cos_half, sin_half;
    std::uint32_t flags;
};

struct Level {
    const char* name;   // as -march calls it
    const char* flags;  // of the compiler
    Loop loops[3];      // trig, light, roots: see loop.cpp
    void (*solve_single)(const SingleArm* arms, SinglePose* poses, std::size_t count);
    void (*solve_frame)(const FrameView& frame);                     // one arm at a time, too
    void (*solve_bodies)(BodyCharacter* bodies, std::size_t count);  // one body at a time
    void (*solve_characters)(const Character* in, Character* out, CharacterState* states, std::size_t count);
    const char* ozz_flags;  // null, and so is the next one: built without SWIVEL_OZZ_DIR
    void (*solve_frame_ozz)(const FrameView& frame, const OzzView& given);
};

// The levels that this CPU runs, widest first; none on x86 CPUs older than x86-64-v2.
std::vector<const Level*> runnable_levels();

#ifdef SWIVEL_LEVEL  // in the files that are compiled once for each level
namespace SWIVEL_LEVEL {

void solve_loop_trig(const Arms& arms, Poses& poses);
void solve_loop_light(const Arms& arms, Poses& poses);
void solve_loop_roots(const Arms& arms, Poses& poses);
void solve_single(const SingleArm* arms, SinglePose* poses, std::size_t count);
void solve_frame(const FrameView& frame);
void solve_bodies(BodyCharacter* bodies, std::size_t count);
void solve_characters(const Character* in, Character* out, CharacterState* states, std::size_t count);
void solve_frame_ozz(const FrameView& frame, const OzzView& given);

}  // namespace SWIVEL_LEVEL
#endif

}  // namespace bench
