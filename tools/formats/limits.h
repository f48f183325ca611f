#pragma once
// SPDX-License-Identifier: MIT
// What the engine asks of numbers in files, so that a file that it would not solve is refused by file and line.

namespace swivel::formats {

// The longest target or axis that the engine solves. None in any file may be longer, and scales lie between 1/kMaxNorm
// and kMaxNorm.
constexpr double kMaxNorm = 1e15;

// The most twist bones of one limb.
constexpr unsigned kMaxTwistBones = 7;

}  // namespace swivel::formats
