// SPDX-License-Identifier: MIT
//
// The production formula: an arm's rotors from its wrist target, pole and lengths. It is exact to single precision, for
// every reach and for every ratio of bones that the digits can tell. It takes the lecture's five steps (pipeline.h) in
// three stages:
// 1. swivel_plane: how far the target is, and the plane through shoulder, target and pole.
// 2. bend_elbow: the lecture's steps 1 and 2. The triangle of the bones (reach.h) says how far the elbow bends, and how
//    far the upper arm is lifted off the target's line.
// 3. turn_shoulder: steps 3 to 5. The middle line and the twist lay a frame along the target's line (frame_rotor.h),
//    from which the arm is lifted.
// Source: D. Hildenbrand, Inverse Kinematics of a Virtual Character (TU Darmstadt, 2019); conventions in conformal.h.
//
// The formula has no guards; it says for which arms it holds. The others, which are rare, are solved as whole limbs
// (any_arm.h).
#pragma once

#include "core/frame_rotor.h"
#include "core/reach.h"

namespace swivel::inline SWIVEL_ISA {

// Stage 1: the plane that the arm lies in.
template <class T>
struct SwivelPlane {
    FrameStart<T> start;  // of the frame along the target's line
    T per_length2;        // about 1 / length^2 of that line
    Vector<T> normal;     // of length normal_length
    T normal_length;
    Mask<T> holds;
};
template <class T>
SWIVEL_INLINE constexpr SwivelPlane<T> swivel_plane(const ArmGoal<T>& goal)
{
    const T wrist2 = len2(goal.wrist), length = sqrt(wrist2);
    const FrameStart<T> start = frame_start(goal.wrist, length);
    const Vector<T> normal = cross(goal.wrist, goal.pole);
    const T normal_length = sqrt(len2(normal));

    // The numbers must be such that their squares and products stay normal floats, and the pole off the line.
    const T pole1 = length1(goal.pole);
    const Mask<T> holds = (lo(wrist2, pole1) >= T(kPlainMin)) &
                          ((wrist2 + pole1) + (goal.upper + goal.fore) <= T(kPlainMax)) &
                          (normal_length > T(kPoleOff) * (length * pole1));
    return {start, per_power_of_two(wrist2), normal, normal_length, holds};
}

// Stage 2: the elbow bends, and the upper arm is lifted off the target's line.
template <class T>
struct BentElbow {
    T cos_half, sin_half;  // of the flexion
    Hinge<T> lift;         // about the plane's normal, from the frame's start; of any length
    T lift2;               // its squared length
    Word<T> flags;
    Mask<T> holds;
};
template <class T>
SWIVEL_INLINE constexpr BentElbow<T> bend_elbow(const FrameStart<T>& start, const T& upper, const T& fore)
{
    const T far = upper + fore, diff = upper - fore, near = abs(diff);
    const Reach<T> reach = clamp_reach(start.length, near, far);
    const ArmTriangle<T> triangle = arm_triangle(reach.distance, far, diff);

    // The lift is cos + sin i. A frame that starts from -e3 is turned by pi first: i (cos + sin i) = -sin + cos i.
    const Mask<T> larger_first = flip_sign(triangle.cos_lift, start.side) >= T(0);
    const T first = select(larger_first, triangle.larger, triangle.smaller),
            second = select(larger_first, triangle.smaller, triangle.larger);

    // Neither bone may be lost in the other's digits.
    const T shortest2 = far - near;
    const Mask<T> holds =
        lo(shortest2, T(kPlainMin / kMinLift) * (start.middle_half2() * triangle.lift2)) >= T(kPlainMin);
    return {triangle.cos_half,
            triangle.sin_half,
            hinge(flip_sign(first, start.side), second),
            triangle.lift2,
            select(reach.too_far, word<T>(SWIVEL_CLAMPED_FAR),
                   select(reach.too_near, word<T>(SWIVEL_CLAMPED_NEAR), word<T>(SWIVEL_REACHED))),
            holds};
}

// Stage 3: the shoulder's rotor. One root divides all lengths out.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> turn_shoulder(const Vector<T>& wrist, const SwivelPlane<T>& plane,
                                               const BentElbow<T>& elbow)
{
    const FrameRotor<T> frame =
        frame_from_start(wrist, plane.start, plane.per_length2, plane.normal, plane.normal_length);
    const T half2 = (plane.start.middle_half2() * frame.twist_len2) * elbow.lift2;  // the lift comes last
    return (T(0.707106781186547524) / sqrt(half2)) * (frame.from_start * elbow.lift);
}

// The three stages, one after the other.
template <class T>
struct PlainArm {
    ArmPose<T> pose;
    Mask<T> holds;  // where false, the pose may be anything, NaN too
};
template <class T>
SWIVEL_INLINE constexpr PlainArm<T> solve_plain(const ArmGoal<T>& goal)
{
    const SwivelPlane<T> plane = swivel_plane(goal);
    const BentElbow<T> elbow = bend_elbow(plane.start, goal.upper, goal.fore);
    const Rotor<T> shoulder = turn_shoulder(goal.wrist, plane, elbow);
    const Mask<T> holds = plane.holds & elbow.holds;
    return {{shoulder, elbow.cos_half, elbow.sin_half, elbow.flags, all_lanes<T>()}, holds};
}

}  // namespace swivel::inline SWIVEL_ISA
