// SPDX-License-Identifier: MIT
//
// The production formula: an arm's rotors from its wrist target, pole and lengths. It is exact to single precision, for
// every reach and for every ratio of bones that the digits can tell. It takes the lecture's five steps (pipeline.h) in
// three stages:
// 1. swivel_plane: how far the target is, and the plane through shoulder, target and pole.
// 2. bend_elbow: the lecture's steps 1 and 2. The triangle of the bones says how far the elbow bends, and how far the
//    upper arm is lifted off the target's line.
// 3. turn_shoulder: steps 3 to 5. The middle line and the twist lay a frame along the target's line (frame_rotor.h),
//    from which the arm is lifted.
// Source: D. Hildenbrand, Inverse Kinematics of a Virtual Character (TU Darmstadt, 2019); conventions in conformal.h.
//
// The formula has no guards; it says for which arms it holds. The others, which are rare, are solved as whole limbs
// (any_arm.h).
#pragma once

#include "core/arm.h"
#include "core/frame_rotor.h"

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

    // The formula holds where squares and products stay normal floats, and the pole is off the line.
    const T pole1 = length1(goal.pole);
    const Mask<T> holds = (lo(wrist2, pole1) >= T(kPlainMin)) &
                          ((wrist2 + pole1) + (goal.upper + goal.fore) <= T(kPlainMax)) &
                          (normal_length > T(kPoleOff) * (length * pole1));
    return {start, per_power_of_two(wrist2), normal, normal_length, holds};
}

// Stage 2: the elbow bends, and the upper arm is lifted off the target's line.
//
// The two bones and the distance from shoulder to wrist form a triangle. Its angles come as cosines and sines of their
// halves, built from products that cannot cancel. If one bone is too short for the digits of the other, there is no
// triangle (limb_bones.h).
template <class T>
struct ArmTriangle {
    T cos_half, sin_half;  // of the flexion
    // The lift is the angle between the target's line and the upper arm. These are the larger and the smaller of the
    // cosine and sine of its half, both times the same number, and the sum of their squares.
    T larger, smaller, lift2;
    T cos_sign;  // has the sign of the lift's cosine: not negative where the larger one is the cosine of the half
};
// distance: within |L1-L2| ... L1+L2 and not 0; far = L1+L2, diff = L1-L2. These products of sums and differences are
// >= 0: a = (d-(L1-L2)) (d+(L1-L2)), b = (L1+L2-d) (L1+L2+d), p = (d+(L1-L2)) (L1+L2+d), m = (d-(L1-L2)) (L1+L2-d).
// With a + b = 4 L1 L2,
//   cos^2(flexion/2) = a / (a+b),   sin^2(flexion/2) = b / (a+b),
//   cos^2(lift/2)    = p / (p+m),   sin^2(lift/2)    = m / (p+m),   so they are as p to sqrt(pm) = sqrt(ab) to m.
template <class T>
SWIVEL_INLINE constexpr ArmTriangle<T> arm_triangle(const T& distance, const T& far, const T& diff)
{
    const T longer = far + distance, shorter = far - distance, ahead = distance + diff, behind = distance - diff;
    const T a = behind * ahead, b = shorter * longer, p = ahead * longer, m = behind * shorter;
    const T per_sum = T(1) / (a + b);
    const T cos_half = sqrt(a * per_sum), sin_half = sqrt(b * per_sum);
    const T larger = hi(p, m) * per_sum;
    return {cos_half, sin_half, larger, cos_half * sin_half, larger * ((p + m) * per_sum), p - m};
}

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
    const T distance = lo(hi(start.length, near), far);
    const Mask<T> too_far = start.length > far, too_near = start.length < near;
    const ArmTriangle<T> triangle = arm_triangle(distance, far, diff);

    // The lift is cos + sin i. A frame that starts from -e3 is turned by pi first: i (cos + sin i) = -sin + cos i.
    const Mask<T> larger_first = flip_sign(triangle.cos_sign, start.side) >= T(0);
    const T first = select(larger_first, triangle.larger, triangle.smaller),
            second = select(larger_first, triangle.smaller, triangle.larger);

    // Neither bone may be lost in the other's digits: twice the shorter bone is at least kPlainMin, and the lift times
    // the line's middle is at least kMinLift. The factor scales the second bound to the first one, so that one
    // comparison tests both.
    const T twice_shorter = far - near;
    const Mask<T> holds =
        lo(twice_shorter, T(kPlainMin / kMinLift) * (start.middle_half2() * triangle.lift2)) >= T(kPlainMin);
    return {triangle.cos_half,
            triangle.sin_half,
            hinge(flip_sign(first, start.side), second),
            triangle.lift2,
            select(too_far, word<T>(SWIVEL_CLAMPED_FAR),
                   select(too_near, word<T>(SWIVEL_CLAMPED_NEAR), word<T>(SWIVEL_REACHED))),
            holds};
}

// Stage 3: the shoulder's rotor. One root divides all lengths out.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> turn_shoulder(const Vector<T>& wrist, const SwivelPlane<T>& plane,
                                               const BentElbow<T>& elbow)
{
    const FrameRotor<T> frame =
        frame_from_start(wrist, plane.start, plane.per_length2, plane.normal, plane.normal_length);
    // Half the squared length of the rotor before it is scaled; the lift comes last.
    const T half2 = (plane.start.middle_half2() * frame.twist_len2) * elbow.lift2;
    constexpr double kRootOfHalf = 0.707106781186547524;
    return (T(kRootOfHalf) / sqrt(half2)) * (frame.from_start * elbow.lift);
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
