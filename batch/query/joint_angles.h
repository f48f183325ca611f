// SPDX-License-Identifier: MIT
//
// A pose as joint angles, for people and files.
#pragma once

#include "batch/query/forward.h"
#include "core/angle_limits.h"
#include "include/swivel/swivel.h"

namespace swivel {

struct JointAngles {
    double shoulder[3], flexion, wrist[3];
};
JointAngles joint_angles(const ArmRotors& arm, swivel_euler_order shoulder_order, swivel_euler_order wrist_order,
                         int family);

// The three angles of R = R_p(first) R_q(middle) R_r(last), of a family: see swivel_joint_angles().
void euler_angles(const Rotor<double>& q, const EulerOrder& order, int family, double (&angles)[3]);

}  // namespace swivel
