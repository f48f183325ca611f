// SPDX-License-Identifier: MIT
//
// The production formula: an arm's rotors from its wrist target, pole and lengths, exact to single precision for every
// reach and every ratio of bones. It takes the lecture's five steps (pipeline.h) in forms that cannot cancel:
// the elbow's triangle by products (reach.h), the middle line to the nearer of e3 and -e3, the twist by whichever half
// is large. Source: D. Hildenbrand, Inverse Kinematics of a Virtual Character (TU Darmstadt, 2019); conventions in
// conformal.h.
//
// Degenerate input: bad numbers are replaced by the arm at rest on entry, so no NaN goes past the first select; a
// target on the shoulder is taken in direction e3; reach.h and swivel_plane.h say what they do with the rest.
#pragma once

#include "core/reach.h"
#include "core/swivel_plane.h"

namespace swivel::inline SWIVEL_ISA {

// The rotor that carries e3 to the unit vector bone and e1 to normal, a unit vector orthogonal to it.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> frame_rotor(const Vector<T>& bone, const Vector<T>& normal)
{
    // The upper arm near -e3 has no middle line to e3: turn by pi about e1 first and start from -e3 instead.
    const Mask<T> turned = bone.template at<kE3>() < T(0);
    const T start = select(turned, T(-1), T(1));

    // Steps 3 and 4: the middle line between the start and the bone, not yet of unit length; |middle|^2 = 2 height.
    const Vector<T> middle = bone + start * unit<T, kE3>();
    const T height = abs(middle.template at<kE3>());

    // Step 5: the normal before the turn by pi about the middle line, n' = 2 (n.m) m / |m|^2 - n, lies in the plane of
    // e1, e2. All of it times height, which spares a division: n' = c3 e1 + s3 e2 with c3^2 + s3^2 = height^2.
    const T along = flip_sign(normal.template at<kE3>(), start);  // n.m, as n is orthogonal to the bone
    const T c3 = along * bone.template at<kE1>() - height * normal.template at<kE1>();
    const T s3 = along * bone.template at<kE2>() - height * normal.template at<kE2>();

    // q3 is half the turn from e1 to n': along (1 + c3) + s3 k, or for obtuse turns along |s3| +- (1 - c3) k. |q3|^2 =
    // 2 height large.
    const T large = height + abs(c3);
    const Mask<T> obtuse = c3 < T(0);
    const auto q3 =
        select(obtuse, abs(s3), large) * unit<T, kScalar>() + select(obtuse, copysign(large, s3), s3) * unit<T, kK>();

    // q_s = q12 q3 of unit length, the two lengths taken off in one.
    const Rotor<T> q = (T(0.5) / (height * sqrt(large))) * (central_line(middle) * q3);
    return select(turned, times_blade<kI>(q), q);
}

// good: false where the caller already knows the input to be bad.
template <class T>
SWIVEL_INLINE constexpr ArmPose<T> solve_arm(const ArmGoal<T>& asked, const Mask<T>& good)
{
    Vector<T> wrist = asked.wrist, pole = asked.pole, aim = wrist;
    T upper = asked.upper, fore = asked.fore, wrist2 = len2(wrist), pole2 = len2(pole), aim2 = wrist2;

    // Most arms are ordinary: nothing bad, nothing of no length, nothing huge. A step with another arm in it looks
    // closer; this changes no bit of the ordinary ones beside it.
    const T least = lo(lo(wrist2, pole2), lo(upper, fore)), sum = (wrist2 + pole2) + (upper + fore);
    const Mask<T> ordinary = good & (least >= T(kPlainLeast)) & (sum <= T(kPlainMost));  // false for NaN
    Mask<T> valid = ordinary, on_shoulder = wrist2 < T(kTiny2);
    if (!all(ordinary)) {
        const ArmGoal<T> rest = rest_goal<T>();
        valid = good & (wrist2 <= T(kHuge2)) & (pole2 <= T(kHuge2)) & is_length(upper) & is_length(fore);
        wrist = select(valid, wrist, rest.wrist), pole = select(valid, pole, rest.pole);
        wrist2 = select(valid, wrist2, len2(rest.wrist)), pole2 = select(valid, pole2, len2(rest.pole));
        upper = select(valid, upper, rest.upper), fore = select(valid, fore, rest.fore);

        on_shoulder = wrist2 < T(kTiny2);
        wrist = select(on_shoulder, vector(T(0), T(0), T(1)), wrist), wrist2 = select(on_shoulder, T(1), wrist2);

        // Poles and aims of unit length where the square of their product would not fit a float.
        const Mask<T> plain =
            (wrist2 >= T(kPlainLeast)) & (pole2 >= T(kPlainLeast)) & (wrist2 + pole2 <= T(kPlainMost));
        aim = select(plain, wrist, (T(1) / sqrt(wrist2)) * wrist), aim2 = select(plain, wrist2, T(1));
        const Mask<T> no_pole = pole2 < T(kTiny2);
        const T per_pole = T(1) / sqrt(select(no_pole, T(1), pole2));
        pole = select(plain, pole, select(no_pole, T(0), per_pole) * pole), pole2 = select(plain, pole2, T(1));
    }

    // The target's line from the shoulder, and how far along it the wrist can be.
    const T length = sqrt(wrist2), wanted = select(on_shoulder, T(0), length);
    const Vector<T> line = (T(1) / length) * wrist;
    const Reach<T> reach = clamp_reach(wanted, upper, fore);

    // Steps 1 and 2: the swivel plane; in it the elbow's direction and the flexion.
    const SwivelPlane<T> plane = swivel_plane(line, aim, aim2, pole, pole2);
    const ArmTriangle<T> triangle = arm_triangle(reach.distance, upper, fore);
    const Vector<T> bone = triangle.cos_lift * line + triangle.sin_lift * plane.side;

    // Steps 3 to 5.
    const Rotor<T> shoulder = frame_rotor(bone, plane.normal);

    const Bits<T> flags =
        bits_where(valid & !(reach.too_far | reach.too_near), flag::reached) |
        bits_where(reach.too_far, flag::clamped_far) | bits_where(reach.too_near, flag::clamped_near) |
        bits_where(plane.undefined | on_shoulder, flag::swivel_undefined) | bits_where(!valid, flag::bad_input);
    return {shoulder, triangle.cos_half, triangle.sin_half, flags, valid};
}

// One of the two quaternions of a rotation: w >= 0, and at w = 0 the first of x, y, z that is not zero is positive.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> hemisphere(const Rotor<T>& q)
{
    const T zero = T(0), w = q.template at<kScalar>();
    T leading = w;
    if (const Mask<T> half_turn = w == zero; any(half_turn)) {
        const T x = q.template at<kI>(), y = q.template at<kJ>(), z = q.template at<kK>();
        leading = select(half_turn, select(x == zero, select(y == zero, z, y), x), w);
    }
    return for_each_blade<T, Rotor<T>::set>(
        [&]<Blade B>() SWIVEL_INLINE_LAMBDA { return flip_sign(q.template at<B>(), leading); });
}

}  // namespace swivel::inline SWIVEL_ISA
