// SPDX-License-Identifier: MIT
//
// A whole limb in Eigen's terms, solved by the library's formula over any number type, and where it then is.
#pragma once

#include "core/limb.h"
#include "tests/formula_arm.h"

namespace swivel::test {

template <class T>
Rotor<T> mv(const Quaterniond& q)
{
    return rotor(static_cast<T>(q.x()), static_cast<T>(q.y()), static_cast<T>(q.z()), static_cast<T>(q.w()));
}
template <class T>
Turned<T> turned(double angle)
{
    return {static_cast<T>(std::cos(angle)), static_cast<T>(std::sin(angle))};
}

// An arm as a goal, everything else at rest: what changes nothing.
template <class T>
LimbGoal<T> limb_goal(const Arm& arm)
{
    LimbGoal<T> goal{};
    goal.arm = {mv<T>(arm.wrist), mv<T>(arm.pole), static_cast<T>(arm.upper), static_cast<T>(arm.fore)};
    goal.hand = one<T>();
    goal.angle = {T(1), T(0)};
    goal.incoming = {one<T>(), one<T>(), one<T>()};
    goal.weights = {T(1), T(1), T(1)};
    goal.reach = {T(0), T(0), T(1), T(0)};
    goal.continuity.most = {T(-1), T(0)};
    goal.aim = {vector(T(0), T(0), T(1)), T(1), T(0)};
    const Range<T> all{{T(1), T(0)}, {T(-1), T(0)}};
    JointLimits<T>& limits = goal.limits;
    limits.flexion = {T(1), T(0)};
    limits.shoulder_cone = limits.hand_cone = {vector(T(0), T(0), T(1)), T(-1)};
    limits.humeral_twist = limits.forearm_twist = all;
    limits.hand_twist = {vector(T(0), T(0), T(1)), all};
    for (int n = 0; n < 3; ++n) limits.shoulder_box[n] = limits.wrist_box[n] = all;
    return goal;
}

template <class T>
struct Solved {
    SolvedLimb<T> pose;
    Vector3d elbow = Vector3d::Zero(), wrist = elbow,
             hinge = elbow;  // places, and the direction of the swivel plane's normal
    Quaterniond hand = Quaterniond::Identity();
};
template <class T>
Solved<T> solve(const LimbUse& use, const LimbGoal<T>& goal)
{
    Solved<T> out;
    out.pose = use.aim ? solve_limb<true>(use, goal, Mask<T>(true)) : solve_limb<false>(use, goal, Mask<T>(true));
    const Quaterniond shoulder = eigen(out.pose.arm.shoulder).normalized();
    const Quaterniond fore = shoulder * elbow_rotation(out.pose.arm).normalized();
    const double stretch = out.pose.stretch;
    out.elbow = stretch * (shoulder * Vector3d(0, 0, goal.arm.upper));
    out.wrist = out.elbow + stretch * (fore * Vector3d(0, 0, goal.arm.fore));
    out.hinge = shoulder * Vector3d::UnitX();
    out.hand = use.hand ? fore * eigen(out.pose.wrist).normalized() : fore;
    return out;
}

inline Arm random_reachable(Random& random)
{
    const double upper = random.between(0.2, 0.5), fore = upper * random.between(0.6, 1.6);
    const double near = std::fabs(upper - fore), far = upper + fore;
    const Vector3d line = random.direction();
    return rounded(Arm{(near + random.between(0.05, 0.95) * (far - near)) * line,
                       random.between(-1, 1) * line + random.spread(0.1, 1) * random.across(line), upper, fore});
}

}  // namespace swivel::test
