// SPDX-License-Identifier: MIT
//
// Compiled once for each level: its table. What the compiler made of the loops is a fact of compiler and CPU family,
// written down here and held against the objects by tests/check_rivals.cmake.
#include "bench/rivals/level.h"

namespace bench::SWIVEL_LEVEL {

namespace {

#if defined(__clang__)
constexpr const char* kTrig = "one arm at a time: clang does not vectorise it";
constexpr const char* kRoots = "vectorised by clang";
#elif defined(__x86_64__)
constexpr const char* kTrig = "vectorised by g++ with libmvec";
constexpr const char* kRoots = "vectorised by g++";
#else
constexpr const char* kTrig = "one arm at a time: no acos for vectors here";
constexpr const char* kRoots = "vectorised by g++";
#endif

#ifdef SWIVEL_OZZ_FLAGS
constexpr const char* kOzzFlags = SWIVEL_OZZ_FLAGS;
constexpr auto kSolveFrameOzz = solve_frame_ozz;
#else
constexpr const char* kOzzFlags = nullptr;
constexpr void (*kSolveFrameOzz)(const FrameView&, const OzzView&) = nullptr;
#endif

}  // namespace

extern const Level level;
const Level level{SWIVEL_LEVEL_NAME,
                  SWIVEL_LEVEL_FLAGS,
                  {{"loop_trig", kTrig, solve_loop_trig},
                   {"loop_light", kTrig, solve_loop_light},
                   {"loop_roots", kRoots, solve_loop_roots}},
                  solve_single,
                  solve_frame,
                  solve_bodies,
                  solve_characters,
                  kOzzFlags,
                  kSolveFrameOzz};

}  // namespace bench::SWIVEL_LEVEL
