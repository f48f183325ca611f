// SPDX-License-Identifier: MIT
//
// The production formula: an arm's rotors from its wrist target, pole and lengths. It is exact to single precision, for
// every reach and for every ratio of bones that the digits can tell. It takes the lecture's five steps (pipeline.h) in
// an order that shortens them. The middle line and the twist lay a frame along the target's line (frame_rotor.h). The
// elbow's triangle (reach.h) then lifts the upper arm off this line. One root at the end divides all lengths out.
// Source: D. Hildenbrand, Inverse Kinematics of a Virtual Character (TU Darmstadt, 2019); conventions in conformal.h.
//
// The formula has no guards; it says for which arms it holds. The other arms are rare. They first get a tame goal that
// has the same pose:
// - Bad numbers are replaced by the arm at rest, so no NaN is left.
// - A target on the shoulder is replaced by the direction e3.
// - A pole may not say where the elbow goes: it has no length, or is along the target's line within sin 1e-3. Then the
//   rest hinge e1 is the normal of the swivel plane, or e2 if e1 lies along the line.
#pragma once

#include "core/frame_rotor.h"
#include "core/reach.h"

namespace swivel::inline SWIVEL_ISA {

template <class T>
struct PlainArm {
    ArmPose<T> pose;
    Mask<T> holds;  // where false, the pose may be anything, NaN too
};

template <class T>
SWIVEL_INLINE constexpr PlainArm<T> solve_plain(const ArmGoal<T>& goal)
{
    const T wrist2 = len2(goal.wrist), length = sqrt(wrist2);

    // Steps 1 and 2: how far the wrist is, and the triangle of the bones.
    const T far = goal.upper + goal.fore, diff = goal.upper - goal.fore, near = abs(diff);
    const Reach<T> reach = clamp_reach(length, near, far);
    const ArmTriangle<T> triangle = arm_triangle(reach.distance, far, diff);

    // Steps 3 to 5, for the target's line in the swivel plane through the pole.
    const Vector<T> normal = cross(goal.wrist, goal.pole);
    const T normal_length = sqrt(len2(normal));
    const FrameRotor<T> frame = frame_from_start(goal.wrist, length, per_power_of_two(wrist2), normal, normal_length);

    // A turn about the normal, at rest e1, lifts the upper arm off the line: cos + sin i. If the frame starts from -e3,
    // it is turned by pi first: i (cos + sin i) = -sin + cos i.
    const Mask<T> larger_first = flip_sign(triangle.cos_lift, frame.start) >= T(0);
    const T first = select(larger_first, triangle.larger, triangle.smaller),
            second = select(larger_first, triangle.smaller, triangle.larger);
    const auto lift = flip_sign(first, frame.start) * unit<T, kScalar>() + second * unit<T, kI>();

    const T half2 = (frame.middle_half2 * frame.twist_len2) * triangle.lift2;  // the lift comes last
    const Rotor<T> shoulder = (T(0.707106781186547524) / sqrt(half2)) * (frame.from_start * lift);

    // It holds for numbers whose squares and products stay normal floats, for poles off the line, and for bones that
    // are not lost in each other's digits.
    const T pole1 = length1(goal.pole), shortest2 = far - near;
    const Mask<T> holds =
        (lo(lo(wrist2, pole1), lo(shortest2, T(kPlainLeast / kLeastLift) * (frame.middle_half2 * triangle.lift2))) >=
         T(kPlainLeast)) &
        ((wrist2 + pole1) + far <= T(kPlainMost)) & (normal_length > T(kPoleOff) * (length * pole1));
    return {{shoulder, triangle.cos_half, triangle.sin_half,
             select(reach.too_far, bits<T>(flag::clamped_far),
                    select(reach.too_near, bits<T>(flag::clamped_near), bits<T>(flag::reached))),
             T(0) == T(0)},
            holds};
}

// A goal for which the formula holds, and what only the original goal tells.
template <class T>
struct TameArm {
    ArmGoal<T> goal;
    Bits<T> flags;
    Mask<T> valid;
};

// axes: the arm frame, in the space of the goal. good: false where the caller already knows that the input is bad.
template <class T>
SWIVEL_INLINE constexpr TameArm<T> tamed(const ArmGoal<T>& asked, const Mask<T>& good, const ArmAxes<T>& axes)
{
    const Mask<T> valid = good & (len2(asked.wrist) <= T(kHuge2)) & (len2(asked.pole) <= T(kHuge2)) &
                          is_length(asked.upper) & is_length(asked.fore);
    const ArmGoal<T> rest = rest_goal<T>();
    const T upper = select(valid, asked.upper, rest.upper), fore = select(valid, asked.fore, rest.fore);
    const Vector<T> wrist = select(valid, asked.wrist, rest.wrist), pole = select(valid, asked.pole, rest.pole);

    // The target's line from the shoulder.
    const T wrist2 = len2(wrist);
    const Mask<T> on_shoulder = wrist2 < T(kTiny2);
    const T length = sqrt(select(on_shoulder, T(1), wrist2));
    const Vector<T> line = select(on_shoulder, axes.bone, (T(1) / length) * wrist);

    // Bones of about length 1, in the same ratio to the last bit. A bone that is lost in the other's digits is straight
    // with it, along the line.
    const T wanted = select(on_shoulder, T(0), length), far = upper + fore;
    const Reach<T> reach = clamp_reach(wanted, abs(upper - fore), far);
    const T shrink = per_power_of_two(select(far > T(0), far, T(1)));
    const Mask<T> one_bone = !(lo(upper, fore) > T(kSwallowed) * far);
    const T distance = select(one_bone, T(kOutOfReach), lo(hi(wanted * shrink, T(kNearest)), T(kOutOfReach)));

    // The stand-in for a pole. It is orthogonal to the line and to the wanted normal, so that line x pole = normal.
    const T pole2 = len2(pole);
    const Mask<T> no_pole = pole2 < T(kTiny2);
    const Vector<T> towards = (T(1) / sqrt(select(no_pole, T(1), pole2))) * pole;
    const Mask<T> undefined = no_pole | !(len2(cross(line, towards)) > T(kPoleOff * kPoleOff));
    const Vector<T> by_hinge = cross(axes.hinge, line), by_other = cross(axes.other, line);
    const Vector<T> instead = select(len2(by_hinge) > T(kPoleOff * kPoleOff), by_hinge, by_other);

    const Bits<T> flags =
        bits_where(valid & !(reach.too_far | reach.too_near), flag::reached) |
        bits_where(reach.too_far, flag::clamped_far) | bits_where(reach.too_near, flag::clamped_near) |
        bits_where(undefined | on_shoulder, flag::swivel_undefined) | bits_where(!valid, flag::bad_input);
    return {{distance * line, T(kPoleAway) * select(undefined, instead, towards),
             select(one_bone, T(0.5), upper * shrink), select(one_bone, T(0.5), fore * shrink)},
            flags,
            valid};
}

// Any arm. plain: the same goal, in the form on which the formula was already tried. Where it holds, its bits are kept.
template <class T>
SWIVEL_INLINE constexpr ArmPose<T> solve_any(const ArmGoal<T>& plain, const Mask<T>& holds, const ArmGoal<T>& asked,
                                             const Mask<T>& good, const ArmAxes<T>& axes)
{
    const TameArm<T> tame = tamed(asked, good, axes);
    ArmPose<T> pose = solve_plain(select(holds, plain, tame.goal)).pose;
    pose.flags = select(holds, pose.flags, tame.flags);
    pose.valid = holds | tame.valid;
    return pose;
}

// An arm in the arm frame. good: false where the caller already knows that the input is bad.
template <class T>
SWIVEL_INLINE constexpr ArmPose<T> solve_arm(const ArmGoal<T>& goal, const Mask<T>& good)
{
    const PlainArm<T> plain = solve_plain(goal);
    const Mask<T> holds = plain.holds & good;
    return all(holds) ? plain.pose : solve_any(goal, holds, goal, good, arm_axes<T>());
}

}  // namespace swivel::inline SWIVEL_ISA
