// SPDX-License-Identifier: MIT
//
// What whole limbs are given beside their arms: random values of the shape that each field has.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tools/corpus/arms.h"

namespace swivel::corpus {

// Every other run of 64 limbs has hard numbers among its values.
inline constexpr std::uint32_t kRunLimbs = 64;
inline bool is_spoilt_run(std::uint32_t limb) { return limb / kRunLimbs % 2 == 0; }

// component_count() floats for each limb of a group.
std::vector<float> limb_values(const Recipe& recipe, Field field, std::uint32_t group, std::span<const Arm> arms);

}  // namespace swivel::corpus
