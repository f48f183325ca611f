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
    // e1, e2.
    const T share = start * normal.template at<kE3>() / height;  // n.m = start n3, as n is orthogonal to the bone
    const T c3 = share * bone.template at<kE1>() - normal.template at<kE1>();
    const T s3 = share * bone.template at<kE2>() - normal.template at<kE2>();

    // q3 is half the turn from e1 to n': along (1 + c3) + s3 k, or for obtuse turns along |s3| +- (1 - c3) k.
    const T large = T(1) + abs(c3);
    const Mask<T> obtuse = c3 < T(0);
    const auto q3 =
        select(obtuse, abs(s3), large) * unit<T, kScalar>() + select(obtuse, copysign(large, s3), s3) * unit<T, kK>();

    // q_s = q12 q3 of unit length, the two lengths taken off in one.
    const T length2 = len2(middle) * len2(q3);
    const Rotor<T> q = (T(1) / sqrt(length2)) * (central_line(middle) * q3);
    return select(turned, times_blade<kI>(q), q);
}

// good: false where the caller already knows the input to be bad.
template <class T>
SWIVEL_INLINE constexpr ArmPose<T> solve_arm(const ArmGoal<T>& asked, const Mask<T>& good)
{
    const ArmGoal<T> rest = rest_goal<T>();
    const T asked_wrist2 = len2(asked.wrist), asked_pole2 = len2(asked.pole);
    const Mask<T> valid = good & (asked_wrist2 <= T(kHuge2)) & (asked_pole2 <= T(kHuge2)) & is_length(asked.upper) &
                          is_length(asked.fore);  // false for NaN
    const Vector<T> wrist = select(valid, asked.wrist, rest.wrist), pole = select(valid, asked.pole, rest.pole);
    const T wrist2 = select(valid, asked_wrist2, len2(rest.wrist)), pole2 = select(valid, asked_pole2, len2(rest.pole));
    const T upper = select(valid, asked.upper, rest.upper), fore = select(valid, asked.fore, rest.fore);

    // The target's line from the shoulder, and how far along it the wrist can be.
    const Mask<T> on_shoulder = wrist2 < T(kTiny2);
    const T length = sqrt(select(on_shoulder, T(1), wrist2));
    const T wanted = select(on_shoulder, T(0), length);
    const Vector<T> line = (T(1) / length) * select(on_shoulder, vector(T(0), T(0), T(1)), wrist);
    const Reach<T> reach = clamp_reach(wanted, upper, fore);

    // Steps 1 and 2: the swivel plane; in it the elbow's direction and the flexion.
    const SwivelPlane<T> plane = swivel_plane(line, pole, pole2);
    const ArmTriangle<T> triangle = arm_triangle(reach.distance, upper, fore);
    const Vector<T> bone = triangle.cos_lift * line + triangle.sin_lift * cross(plane.normal, line);

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
    const T zero = T(0);
    const T &x = q.template at<kI>(), &y = q.template at<kJ>(), &z = q.template at<kK>(), &w = q.template at<kScalar>();
    const T leading = select(w == zero, select(x == zero, select(y == zero, z, y), x), w);
    return for_each_blade<T, Rotor<T>::set>(
        [&]<Blade B>() SWIVEL_INLINE_LAMBDA { return flip_sign(q.template at<B>(), leading); });
}

}  // namespace swivel::inline SWIVEL_ISA
