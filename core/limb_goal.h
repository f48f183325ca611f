// SPDX-License-Identifier: MIT
//
// What a goal may ask of a limb beyond its wrist, its pole and its bones, and which parts of it a group uses.
// Everything is in the arm frame. Parts that a group does not use may hold anything.
#pragma once

#include "core/joint_limits.h"

namespace swivel::inline SWIVEL_ISA {

enum class Wish { pole, normal, incoming };  // what says where the elbow goes

// What a group uses.
struct LimbUse {
    bool hand = false, effector = false, angle = false, incoming = false, weights = false, reach = false,
         continuity = false, aim = false;
    Wish wish = Wish::pole;
    LimitUse limits;
};

template <class T>
struct IncomingPose {
    Rotor<T> shoulder, elbow, wrist;  // of lengths 1/4 to 2; the elbow may turn about any axis
};

// Weights are 0 to 1: 0 keeps the incoming pose's, 1 takes the goal's.
template <class T>
struct Weights {
    T position, hand, pole;
};

// Fractions of the arm's length, except the stretch, which is a factor of 1 or more.
template <class T>
struct ReachGoal {
    T soft_far, soft_near, most_stretch, least_distance;
};

template <class T>
struct Continuity {
    Vector<T> previous_normal;  // zero: none
    Turned<T> most;             // swivel in a frame, 0 to pi
};

// The line of the hand that goes through the target, from the effector on, and half the flexion that the elbow then
// has.
template <class T>
struct AimGoal {
    Vector<T> axis;  // in the hand's frame, of any length; a kernel checks the one that is given
    T cos_half, sin_half;
};

template <class T>
struct LimbGoal {
    ArmGoal<T> arm;  // wrist: the effector's target; pole: a pole, or the swivel plane's normal
    Rotor<T> hand;   // orientation, the identity at rest; with aim the wrist's rotation from the forearm; of any length
    Vector<T> effector;  // in the hand's frame
    Turned<T> angle;     // turns the wish about the line from shoulder to wrist; of any length
    IncomingPose<T> incoming;
    Weights<T> weights;
    ReachGoal<T> reach;
    Continuity<T> continuity;
    AimGoal<T> aim;
    JointLimits<T> limits;
};

template <class T>
SWIVEL_INLINE constexpr Mask<T> is_share(const T& x)
{
    return is_within(x, 0, 1);
}
// Whether the square of a length is that of a unit one. Numbers rounded from double are off by at most 1.2e-7 in it,
// and this sum in floats by 1.8e-7. So 1e-6 refuses none of them. The floats nearest to the two bounds are 1 - 1.01e-6
// and 1 + 9.5e-7.
template <class T>
SWIVEL_INLINE constexpr Mask<T> is_unit2(const T& length2)
{
    return is_within(length2, 1 - 1e-6, 1 + 1e-6);
}
template <class T>
SWIVEL_INLINE constexpr Mask<T> is_valid(const Range<T>& range)
{
    return is_unit2(range.middle.cos * range.middle.cos + range.middle.sin * range.middle.sin) &
           is_unit2(range.half.cos * range.half.cos + range.half.sin * range.half.sin) & (range.half.sin >= T(0));
}
template <class T>
SWIVEL_INLINE constexpr Mask<T> is_valid(const Cone<T>& cone)
{
    return is_unit2(len2(cone.axis)) & (abs(cone.cos_opening) <= T(1));
}

template <class T>
SWIVEL_INLINE constexpr Mask<T> is_valid(const LimitUse& use, const JointLimits<T>& limits)
{
    Mask<T> valid = T(0) == T(0);
    if (use.flexion)
        valid = valid & is_share(limits.flexion.cos_half_least) & is_share(limits.flexion.cos_half_most) &
                (limits.flexion.cos_half_least >= limits.flexion.cos_half_most);
    if (use.shoulder_cone) valid = valid & is_valid(limits.shoulder_cone);
    if (use.hand_cone) valid = valid & is_valid(limits.hand_cone);
    if (use.humeral_twist) valid = valid & is_valid(limits.humeral_twist);
    if (use.forearm_twist) valid = valid & is_valid(limits.forearm_twist);
    if (use.hand_twist) valid = valid & is_valid(limits.hand_twist.range) & is_unit2(len2(limits.hand_twist.axis));
    for (int n = 0; n < 3; ++n) {
        if (use.shoulder_box) valid = valid & is_valid(limits.shoulder_box[n]);
        if (use.wrist_box) valid = valid & is_valid(limits.wrist_box[n]);
    }
    return valid;
}

template <class T>
SWIVEL_INLINE constexpr Mask<T> is_valid(const LimbUse& use, const LimbGoal<T>& goal)
{
    Mask<T> valid = (len2(goal.arm.wrist) <= T(kHuge2)) & (len2(goal.arm.pole) <= T(kHuge2)) &
                    is_length(goal.arm.upper) & is_length(goal.arm.fore) & is_valid(use.limits, goal.limits);
    // A product of two rotors as is_orientation() allows them.
    if (use.hand) valid = valid & is_within(len2(goal.hand), 1e-37, 1e37);
    if (use.effector) valid = valid & (len2(goal.effector) <= T(kHuge2));
    if (use.angle) {
        const T length2 = goal.angle.cos * goal.angle.cos + goal.angle.sin * goal.angle.sin;
        valid = valid & is_within(length2, 1e-18, 1e18);
    }
    if (use.incoming)
        valid = valid & is_orientation(goal.incoming.shoulder) & is_orientation(goal.incoming.elbow) &
                is_orientation(goal.incoming.wrist);
    if (use.aim)
        valid = valid & (goal.aim.cos_half >= T(0)) & (goal.aim.sin_half >= T(0)) &
                is_unit2(goal.aim.cos_half * goal.aim.cos_half + goal.aim.sin_half * goal.aim.sin_half);
    if (use.weights)
        valid = valid & is_share(goal.weights.position) & is_share(goal.weights.hand) & is_share(goal.weights.pole);
    if (use.reach)
        valid = valid & is_share(goal.reach.soft_far) & is_share(goal.reach.soft_near) &
                is_share(goal.reach.least_distance) & (goal.reach.most_stretch >= T(1)) &
                (goal.reach.most_stretch <= T(1e3));
    if (use.continuity)
        valid = valid & (len2(goal.continuity.previous_normal) <= T(1.01)) & (goal.continuity.most.sin >= T(-1e-6)) &
                is_unit2(goal.continuity.most.cos * goal.continuity.most.cos +
                         goal.continuity.most.sin * goal.continuity.most.sin);
    return valid;
}

}  // namespace swivel::inline SWIVEL_ISA
