// SPDX-License-Identifier: MIT
//
// Between the arm frame and everything around it: the parent's frame in the world on the way in, the skeleton's own
// joint frames on the way out, and the hand, which needs both.
//
// Names: parent = frame of the shoulder's parent joint, arm = arm frame (arm.h), hand = the wrist joint's own frame.
#pragma once

#include "core/arm.h"

namespace swivel::inline SWIVEL_ISA {

template <class T>
struct ParentFrame {
    Vector<T> position;  // of the shoulder, in the world
    Rotor<T> rotation;   // of the parent joint, in the world; any length but zero
    T scale;             // uniform, > 0
};

// Unit rotors that place the arm frame in a skeleton, and its joints' rest (batch/swivel.h: swivel_binding).
template <class T>
struct Binding {
    Rotor<T> parent_from_arm, upper_from_arm, fore_from_arm;
    Rotor<T> shoulder_rest, elbow_rest, wrist_rest;
};

template <class T>
SWIVEL_INLINE constexpr Mask<T> is_within(const T& x, double least, double most)
{
    return (x >= T(least)) & (x <= T(most));
}
// A rotor may have any length in 1e-9..1e9: the square of it times a scale stays among the normal floats.
template <class T>
SWIVEL_INLINE constexpr Mask<T> is_valid(const Rotor<T>& q)
{
    return is_within(len2(q), 1e-18, 1e18);
}
template <class T>
SWIVEL_INLINE constexpr Mask<T> is_valid(const ParentFrame<T>& frame)
{
    return is_valid(frame.rotation) & (len2(frame.position) <= T(kHuge2)) & is_within(frame.scale, kTiny, kHuge);
}

// v_w, a vector of the world, in the arm frame: turned back by world_from_arm, a rotor of any length, and divided by
// the scale.
template <class T>
struct IntoArm {
    Rotor<T> arm_from_world;
    T shrink;

    SWIVEL_INLINE constexpr Vector<T> operator()(const Vector<T>& v_w) const
    {
        return shrink * sandwich(arm_from_world, v_w);
    }
};
template <class T>
SWIVEL_INLINE constexpr IntoArm<T> into_arm(const Rotor<T>& world_from_arm, const T& scale)
{
    return {~world_from_arm, T(1) / (len2(world_from_arm) * scale)};
}

// The joints' own local rotations; their rest where the input was bad. A straight arm along the rest bone is q_s = q_e
// = 1.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> shoulder_local(const Binding<T>& bind, const ArmPose<T>& pose)
{
    return select(pose.valid, bind.parent_from_arm * pose.shoulder * ~bind.upper_from_arm, bind.shoulder_rest);
}
template <class T>
SWIVEL_INLINE constexpr Rotor<T> elbow_local(const Binding<T>& bind, const ArmPose<T>& pose)
{
    return select(pose.valid, bind.upper_from_arm * elbow_rotor(pose) * ~bind.fore_from_arm, bind.elbow_rest);
}

// q_w = (q_s q_e)^-1 q_hand, of unit length: the wrist's rotation from the forearm to a wanted hand orientation in the
// arm frame, which may have any length in 1e-18..1e18 where the pose is valid.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> wrist_rotor(const ArmPose<T>& pose, const Rotor<T>& hand_a)
{
    const Rotor<T> one = rotor(T(0), T(0), T(0), T(1));
    return normalise(~(pose.shoulder * elbow_rotor(pose)) * select(pose.valid, hand_a, one));
}
template <class T>
SWIVEL_INLINE constexpr Rotor<T> wrist_local(const Binding<T>& bind, const ArmPose<T>& pose, const Rotor<T>& hand_a)
{
    return select(pose.valid, bind.fore_from_arm * wrist_rotor(pose, hand_a), bind.wrist_rest);
}

}  // namespace swivel::inline SWIVEL_ISA
