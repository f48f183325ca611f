// SPDX-License-Identifier: MIT
//
// Arms at which formulas break: poses, parents and hands by name, and the numbers that spoil any value.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "tools/corpus/arms.h"
#include "tools/corpus/random.h"

namespace swivel::corpus {

// Named poses and frames, and each number of a good arm replaced by each of some bad ones.
std::uint32_t hard_case_count();
// The number of first cases that whole limbs have; all are poses. It is a constant, so that new rows change no whole
// limb.
inline constexpr std::uint32_t kLimbCaseCount = 101;
// Case n. Each further pass through the cases has the poses in another size and along other axes, exactly.
Arm hard_case(std::uint32_t n);

// Replaces values, one in `one_in`, by numbers at which formulas break.
void spoil(Random& random, std::span<float> values, std::uint32_t one_in);
void spoil(Random& random, std::span<double> values, std::uint32_t one_in);

inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();

}  // namespace swivel::corpus
