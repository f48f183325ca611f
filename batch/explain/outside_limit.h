// SPDX-License-Identifier: MIT
//
// How far a pose is outside of its joint limits, for people.
#pragma once

#include "batch/query/forward.h"
#include "include/swivel/swivel_regions.h"

namespace swivel {

// By how many radians a pose is outside of a limit on the swivel; 0 or less where it keeps it. value: as the limit's
// rows hold it. order: a box's.
double outside_limit(const ArmRotors& arm, swivel_field limit, const float* value, swivel_euler_order order);

// The same of the upper arm's region.
double outside_region(const ArmRotors& arm, const swivel_region& region);

}  // namespace swivel
