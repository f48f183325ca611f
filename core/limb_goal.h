// SPDX-License-Identifier: MIT
//
// The goal of a whole limb, but for the wish for its elbow (wish.h). Everything is in the arm frame. Formulas take the
// group's features with it: parts of the goal that these do not use may hold anything.
#pragma once

#include "core/joint_limits.h"

namespace swivel::inline SWIVEL_ISA {

template <class T>
struct IncomingPose {
    Rotor<T> shoulder, elbow, wrist;  // of lengths 1/4 to 2; the elbow may turn about any axis
};

// 0 to 1: 0 keeps the incoming pose, 1 takes the goal.
template <class T>
struct Weights {
    T position, hand, pole;
};

// Fractions of the arm's length, except the stretch, which is a factor of 1 or more.
template <class T>
struct ReachGoal {
    T soft_far, soft_near, max_stretch, min_distance;
};

// How far a limb may reach beyond the incoming pose, in fractions of the arm's length. incoming: the distance from
// shoulder to wrist in that pose, a length.
template <class T>
struct Cap {
    T margin, min, zone, incoming;
};

// The hand's axis, whose ray from the effector must go through the target, and half the elbow's flexion.
template <class T>
struct AimGoal {
    Vector<T> axis;  // in the hand's frame, of any length; kernels check it
    T cos_half, sin_half;
};

template <class T>
struct LimbGoal {
    ArmGoal<T> arm;  // without the pole; wrist: the effector's target
    Rotor<T> hand;   // orientation, the identity at rest; with aim the wrist's rotation from the forearm; of any length
    Vector<T> effector;  // in the hand's frame
    IncomingPose<T> incoming;
    Weights<T> weights;
    ReachGoal<T> reach;
    Cap<T> cap;
    AimGoal<T> aim;
    FlexionLimit<T> flexion;
};

template <class T>
SWIVEL_INLINE constexpr Mask<T> is_share(const T& x)
{
    return is_within(x, 0, 1);
}
// Whether a squared length is 1, but for rounding. Rounding components from double changes it by at most 1.2e-7, and
// summing them in floats by 1.8e-7. So 1e-6 refuses no rounded unit vector. The floats nearest to the two bounds are 1
// - 1.01e-6 and 1 + 9.5e-7.
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
SWIVEL_INLINE constexpr Mask<T> is_valid(const FlexionLimit<T>& flexion)
{
    return is_share(flexion.cos_half_min) & is_share(flexion.cos_half_max) &
           (flexion.cos_half_min >= flexion.cos_half_max);
}
template <class T>
SWIVEL_INLINE constexpr Mask<T> is_valid(const Twist<T>& twist)
{
    return is_valid(twist.range) & is_unit2(len2(twist.axis));
}
template <class T>
SWIVEL_INLINE constexpr Mask<T> is_valid(const Range<T> (&box)[3])
{
    return is_valid(box[0]) & is_valid(box[1]) & is_valid(box[2]);
}
template <class T>
SWIVEL_INLINE constexpr Mask<T> is_valid(const ArmGoal<T>& arm)
{
    return (len2(arm.wrist) <= T(kHuge2)) & (len2(arm.pole) <= T(kHuge2)) & is_length(arm.upper) & is_length(arm.fore);
}
// A pair of any length, in the form of angles and stored turns.
template <class T>
SWIVEL_INLINE constexpr Mask<T> is_valid(const Turned<T>& turned)
{
    return is_within(turned.cos * turned.cos + turned.sin * turned.sin, 1e-18, 1e18);
}
template <class T>
SWIVEL_INLINE constexpr Mask<T> is_valid(const Cap<T>& cap)
{
    return is_share(cap.margin) & is_share(cap.min) & is_share(cap.zone);
}
template <class T>
SWIVEL_INLINE constexpr Mask<T> is_valid(const IncomingPose<T>& incoming)
{
    return is_orientation(incoming.shoulder) & is_orientation(incoming.elbow) & is_orientation(incoming.wrist);
}
template <class T>
SWIVEL_INLINE constexpr Mask<T> is_valid(const AimGoal<T>& aim)
{
    return (aim.cos_half >= T(0)) & (aim.sin_half >= T(0)) &
           is_unit2(aim.cos_half * aim.cos_half + aim.sin_half * aim.sin_half);
}
template <class T>
SWIVEL_INLINE constexpr Mask<T> is_valid(const Weights<T>& weights)
{
    return is_share(weights.position) & is_share(weights.hand) & is_share(weights.pole);
}
template <class T>
SWIVEL_INLINE constexpr Mask<T> is_valid(const ReachGoal<T>& reach)
{
    return is_share(reach.soft_far) & is_share(reach.soft_near) & is_share(reach.min_distance) &
           (reach.max_stretch >= T(1)) & (reach.max_stretch <= T(1e3));
}
// A product of two rotors as is_orientation() allows them.
template <class T>
SWIVEL_INLINE constexpr Mask<T> is_product(const Rotor<T>& q)
{
    return is_within(len2(q), 1e-37, 1e37);
}

}  // namespace swivel::inline SWIVEL_ISA
