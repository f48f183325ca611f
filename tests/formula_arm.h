// SPDX-License-Identifier: MIT
//
// An arm solved by the library's formulas over any number type, and where its elbow and wrist then are. Values of these
// types in Eigen's terms.
#pragma once

#include "core/any_arm.h"
#include "tests/test_arm.h"

namespace swivel::test {

template <class T>
Vector<T> mv(const Vector3d& v)
{
    return vector(static_cast<T>(v.x()), static_cast<T>(v.y()), static_cast<T>(v.z()));
}
template <class T>
Rotor<T> mv(const Quaterniond& q)
{
    return rotor(static_cast<T>(q.x()), static_cast<T>(q.y()), static_cast<T>(q.z()), static_cast<T>(q.w()));
}
template <class T>
Vector3d eigen(const Vector<T>& v)
{
    return {v.template at<kE1>(), v.template at<kE2>(), v.template at<kE3>()};
}
template <class T>
Quaterniond eigen(const Rotor<T>& q)
{
    return {q.template at<kScalar>(), q.template at<kI>(), q.template at<kJ>(), q.template at<kK>()};
}
inline Quaterniond eigen(const double (&q)[4]) { return {q[3], q[0], q[1], q[2]}; }

template <class T>
ArmPose<T> solve(const Arm& arm)
{
    const ArmGoal<T> goal{mv<T>(arm.wrist), mv<T>(arm.pole), static_cast<T>(arm.upper), static_cast<T>(arm.fore)};
    return solve_arm(goal);
}

template <class T>
Quaterniond elbow_rotation(const ArmPose<T>& pose)
{
    return Quaterniond(pose.cos_half, -static_cast<double>(pose.sin_half), 0, 0);
}
template <class T>
Vector3d elbow_place(const ArmPose<T>& pose, const Arm& arm)
{
    return eigen(pose.shoulder).normalized() * Vector3d(0, 0, arm.upper);
}
template <class T>
Vector3d wrist_place(const ArmPose<T>& pose, const Arm& arm)
{
    return elbow_place(pose, arm) +
           eigen(pose.shoulder).normalized() * (elbow_rotation(pose).normalized() * Vector3d(0, 0, arm.fore));
}

}  // namespace swivel::test
