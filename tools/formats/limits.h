#pragma once
// SPDX-License-Identifier: MIT
// The engine's bounds of numbers, so that readers refuse a file that it would not solve, by file and line.

namespace swivel::formats {

// The max length of targets and axes in files. Scales lie between 1/kMaxNorm and kMaxNorm.
constexpr double kMaxNorm = 1e15;

// The max number of a limb's twist bones.
constexpr unsigned kMaxTwistBones = 7;

}  // namespace swivel::formats
