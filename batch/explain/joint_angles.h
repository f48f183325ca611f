// SPDX-License-Identifier: MIT
//
// A pose as joint angles, and their limits, for people and files.
#pragma once

#include "batch/query/forward.h"
#include "include/swivel/swivel.h"

namespace swivel {

struct JointAngles {
    double shoulder[3], flexion, wrist[3];
};
JointAngles joint_angles(const ArmRotors& arm, swivel_euler_order shoulder_order, swivel_euler_order wrist_order,
                         int family);

// By how many radians a pose is outside of a limit on the swivel; 0 or less where it keeps it. value: as the limit's
// rows hold it. order: a box's.
double outside_limit(const ArmRotors& arm, swivel_field limit, const float* value, swivel_euler_order order);

// The same of the upper arm's region.
double outside_region(const ArmRotors& arm, const swivel_region& region);

}  // namespace swivel
