// SPDX-License-Identifier: MIT
//
// Aiming: the elbow's flexion and the wrist are given, so the arm is rigid. The shoulder turns it so that a ray from
// the effector, fixed in the hand, goes through the target. The point of the ray that is as far from the shoulder as
// the target must come to the target. From there this is a limb like any other, whose swivel is free about the line
// from shoulder to target. The goal itself is Tolani, Goswami and Badler's (2000).
#pragma once

#include "core/frame_rotor.h"
#include "core/limb_bones.h"
#include "core/wish.h"

namespace swivel::inline SWIVEL_ISA {

// In arm sizes. Beyond this distance, floats tell a target's direction only.
inline constexpr double kAimFar = 1e7;

// The rotor from the arm frame to a frame that has e3 along the line to the aimed point, and the elbow on the pole's
// side of e2. point: of any length but zero.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> line_from_arm(const Vector<T>& point)
{
    const Vector<T> line = normalise(point), hinge = vector(T(1), T(0), T(0));
    // The elbow lies along e3. If the line lies along e3, too, the elbow has no side, and its hinge decides. Past e3
    // the arm rolls over.
    const Vector<T> normal = cross(line, vector(T(0), T(0), T(1)));
    const Mask<T> off = len2(normal) > T(kPoleOff * kPoleOff);
    return ~frame_along(line, normalise(select(off, normal, across(hinge, line))));
}

// wanted: the distance from the shoulder to the target. hand: the wrist's rotation from the forearm, unit.
template <class T>
SWIVEL_INLINE constexpr PlacedBones<T, Rotor<T>> aimed_bones(swivel_features features, const LimbGoal<T>& goal,
                                                             const Rotor<T>& hand, const T& wanted)
{
    // Scaled to about 1 and less; the ratios stay the same to the last bit.
    T size = goal.arm.upper + goal.arm.fore;
    if (features & SWIVEL_WITH_EFFECTOR) size = size + length1(goal.effector);
    const T shrink = per_power_of_two(hi(size, T(kTiny)));
    const T distance = lo(wanted * shrink, T(kAimFar));

    const Hinge<T> elbow = normalise(hinge(goal.aim.cos_half, -goal.aim.sin_half));
    Vector<T> tip = vector(T(0), T(0), goal.arm.fore * shrink);
    if (features & SWIVEL_WITH_EFFECTOR) tip = tip + sandwich(hand, shrink * goal.effector);
    tip = sandwich(elbow, tip) + vector(T(0), T(0), goal.arm.upper * shrink);
    const Vector<T> axis = normalise(sandwich(elbow, sandwich(hand, goal.aim.axis)));

    // The points of the line are off + s axis; those ahead of the tip have s >= along.
    const T along = scalar_product(tip, axis);
    const Vector<T> off = tip - along * axis;
    const T ahead2 = distance * distance - len2(off), ahead = sqrt(hi(ahead2, T(0)));
    const Mask<T> too_near = (ahead2 < T(0)) | (ahead < along);
    const Vector<T> point = off + hi(ahead, along) * axis;
    const Rotor<T> lift = line_from_arm(select(len2(point) > T(kTiny2), point, axis));
    return {lift, elbow.template at<kScalar>(), -elbow.template at<kI>(), T(1),
            word_where(too_near, SWIVEL_CLAMPED_NEAR) | word_where(!too_near, SWIVEL_REACHED)};
}

}  // namespace swivel::inline SWIVEL_ISA
