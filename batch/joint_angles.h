// SPDX-License-Identifier: MIT
//
// A pose as joint angles, for people and files. With angles.cpp the only place with trigonometry.
#pragma once

#include "batch/edge.h"

namespace swivel {

struct JointAngles {
    double shoulder[3], flexion, wrist[3];
};
JointAngles joint_angles(const ArmRotors& arm, swivel_euler_order shoulder_order, swivel_euler_order wrist_order,
                         int family);

}  // namespace swivel
