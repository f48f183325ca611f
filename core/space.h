// SPDX-License-Identifier: MIT
//
// Converts between the arm frame and the spaces around it. Goals come from the world through the parent's frame;
// results go to the skeleton's joint frames; the hand needs both.
//
// Names: parent = frame of the shoulder's parent joint, arm = arm frame (arm.h), hand = the wrist joint's own frame.
// Targets in the world are solved in the parent's frame. The rotor found there carries the arm frame's axes e3 and e1
// to upper arm and hinge, as everywhere. How the arm frame lies in the parent's frame only says where the arm is at
// rest.
#pragma once

#include "core/arm.h"

namespace swivel::inline SWIVEL_ISA {

template <class T>
struct ParentFrame {
    Vector<T> position;  // of the shoulder, in the world
    Rotor<T> rotation;   // of the parent joint, in the world; any length but zero
    T scale;             // uniform, > 0
};

// One of a binding's quaternions.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> broadcast(const float (&q)[4])
{
    return rotor(T(q[0]), T(q[1]), T(q[2]), T(q[3]));
}

template <class T>
SWIVEL_INLINE constexpr Mask<T> is_valid(const ParentFrame<T>& frame)
{
    return is_orientation(frame.rotation) & (len2(frame.position) <= T(kHuge2)) & is_within(frame.scale, kTiny, kHuge);
}

// A goal in the world, brought into the parent's frame. Nothing is divided: wrist and pole come out `size` times as
// long as in the parent's units, and bones made longer by `size` give the same pose.
template <class T>
struct SeenGoal {
    Vector<T> wrist, pole;
    T size, rotation2;  // rotation2: the squared length of the parent's rotation
};
template <class T>
SWIVEL_INLINE constexpr SeenGoal<T> seen_by(const ParentFrame<T>& parent, const Vector<T>& wrist_w,
                                            const Vector<T>& pole_w, const T& pole_is_point)
{
    const Turn<T> turn = turn_by(~parent.rotation);
    return {turn(wrist_w - parent.position), turn(pole_w - pole_is_point * parent.position),
            parent.scale * turn.length2, turn.length2};
}
// Whether a parent's numbers are ordinary: then a goal for which the plain formula holds (solve_arm.h) has no bad
// input.
template <class T>
SWIVEL_INLINE constexpr Mask<T> is_ordinary(const ParentFrame<T>& parent, const SeenGoal<T>& seen)
{
    return is_within(seen.rotation2, 0.5, 2) & (length1(parent.position) <= T(1e13)) &
           is_within(parent.scale, 1e-5, 1e5);
}

// q_w = (q_s q_e)^-1 q_hand, of unit length: the wrist's rotation from the forearm to the wanted orientation of the
// hand. q_hand is in the space of the pose, and may have any length in 1e-18..1e18.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> wrist_rotor(const ArmPose<T>& pose, const Rotor<T>& hand)
{
    return normalise(~(pose.shoulder * elbow_rotor(pose)) * hand);
}

}  // namespace swivel::inline SWIVEL_ISA
