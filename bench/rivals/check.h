// SPDX-License-Identifier: MIT
//
// Are a solver's results right? Forward kinematics in double, sharing nothing with any solver.
#pragma once

#include <span>

#include "bench/rivals/limbs.h"

namespace bench {

// The worst wrist error of the ordinary arms, in arm lengths; infinite for a NaN or an elbow off its pole's side.
double worst_error(std::span<const Limb> limbs, const Poses& poses);

// What results must keep to be timed: the loops' fast arithmetic is off by up to 3e-5.
inline constexpr double kRightWithin = 1e-3;

}  // namespace bench
