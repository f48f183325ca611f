// SPDX-License-Identifier: MIT
//
// Places the bones of a whole limb for a wanted distance from shoulder to wrist: how far they reach, the elbow's
// flexion, and the upper arm's lift off the line to the wrist.
#pragma once

#include "core/limb_goal.h"
#include "core/soft_reach.h"
#include "core/solve_arm.h"

namespace swivel::inline SWIVEL_ISA {

template <class T, class Lift>
struct PlacedBones {
    Lift lift;             // from the arm's own frame to the line's, of any length
    T cos_half, sin_half;  // of the flexion
    T stretch;
    Word<T> flags;
};

// The distance from shoulder to wrist with flexion theta: d^2 = (L1-L2)^2 + 4 L1 L2 cos^2(theta/2).
template <class T>
SWIVEL_INLINE constexpr T bent_reach(const T& upper, const T& fore, const T& cos_half)
{
    const T difference = upper - fore;
    return sqrt(difference * difference + T(4) * (upper * fore) * (cos_half * cos_half));
}
// The distances that the elbow's flexion allows.
template <class T>
SWIVEL_INLINE constexpr ReachRange<T> flexion_range(const FlexionLimit<T>& limit, const T& upper, const T& fore,
                                                    const T& near, const T& far)
{
    const auto distance = [&](const T& cos_half)
                              SWIVEL_INLINE_LAMBDA { return lo(hi(bent_reach(upper, fore, cos_half), near), far); };
    return {select(limit.cos_half_max > T(0), distance(limit.cos_half_max), near),
            select(limit.cos_half_min < T(1), distance(limit.cos_half_min), far), T(0), T(0), T(1)};
}

// The distance from shoulder to wrist in an incoming pose. elbow: of unit length.
template <class T>
SWIVEL_INLINE constexpr T incoming_reach(const Rotor<T>& elbow, const ArmGoal<T>& arm)
{
    const auto e3 = unit<T, kE3>();
    return sqrt(len2(Vector<T>(arm.upper * e3 + arm.fore * sandwich(elbow, e3))));
}

// The max reach that a cap allows, and the width of the eased zone before it. If the zone is no wider than the margin,
// it begins at the incoming reach, so a target within that is met. max: the bones' reach. length: of both bones.
template <class T>
struct CappedReach {
    T far, zone;
};
template <class T>
SWIVEL_INLINE constexpr CappedReach<T> capped_reach(const Cap<T>& cap, const T& max, const T& length)
{
    const T from = lo(hi(cap.incoming, cap.min * length), max), far = lo(from + cap.margin * length, max);
    return {far, hi(far - from, cap.zone * length)};
}

// wanted: the distance from shoulder to wrist, 0 or more.
template <class T>
SWIVEL_INLINE constexpr PlacedBones<T, Hinge<T>> place_bones(swivel_features features, const LimbGoal<T>& goal,
                                                             const T& wanted)
{
    // Scaled to about 1; the ratios stay the same to the last bit.
    const T sum = goal.arm.upper + goal.arm.fore, shrink = per_power_of_two(select(sum > T(0), sum, T(1)));
    const T upper = goal.arm.upper * shrink, fore = goal.arm.fore * shrink, far = upper + fore,
            near = abs(upper - fore), distance = wanted * shrink;

    ReachRange<T> range{near, far, T(0), T(0), T(1)};
    if (features & SWIVEL_WITH_FLEXION_LIMIT) range = flexion_range(goal.flexion, upper, fore, near, far);
    if (features & SWIVEL_WITH_REACH) {
        range.near = lo(hi(goal.reach.min_distance * far, range.near), range.far);
        range.soft_far = goal.reach.soft_far * far;
        range.soft_near = goal.reach.soft_near * far;
        range.max_stretch = goal.reach.max_stretch;
    }
    const T uncapped = range.far;
    if (features & SWIVEL_WITH_CAP) {
        Cap<T> cap = goal.cap;
        cap.incoming = cap.incoming * shrink;
        const CappedReach<T> capped = capped_reach(cap, range.far, far);
        range.far = hi(capped.far, range.near);
        range.soft_far = capped.zone;
    }
    const SoftReach<T> reach = features & (SWIVEL_WITH_REACH | SWIVEL_WITH_CAP)
                                   ? soft_reach(distance, range)
                                   : hard_reach(distance, range.near, range.far);
    const Mask<T> missed = reach.too_far | reach.too_near | reach.softened;
    // At most one of the three holds. clang 19 did not finish AVX-512's stage of bones where their words were joined.
    Word<T> flags = select(reach.too_far, word<T>(SWIVEL_CLAMPED_FAR),
                           select(reach.too_near, word<T>(SWIVEL_CLAMPED_NEAR),
                                  select(reach.softened, word<T>(SWIVEL_SOFTENED), word<T>(SWIVEL_REACHED)))) |
                    word_where(reach.stretch > T(1), SWIVEL_STRETCHED);
    if (features & SWIVEL_WITH_FLEXION_LIMIT) {
        const Mask<T> too_straight = (distance > range.far) & (range.far < far) & (range.far >= uncapped),
                      too_bent = (distance < range.near) & (range.near > near);
        flags = flags | word_where(missed & (too_straight | too_bent), SWIVEL_LIMITED_FLEXION);
    }

    // Steps 1 and 2 of the lecture: the triangle of the bones. A bone that is lost in the other's digits lies along it.
    const Mask<T> one_bone = !(lo(upper, fore) > T(kSwallowed) * far);
    const T first = select(one_bone, T(0.5), upper), second = select(one_bone, T(0.5), fore);
    const T both = first + second, difference = first - second;
    const T side = select(one_bone, both, lo(hi(hi(reach.distance, T(kNearest)), abs(difference)), both));
    const ArmTriangle<T> triangle = arm_triangle(side, both, difference);
    const Mask<T> larger_first = triangle.cos_sign >= T(0);
    const Hinge<T> lift = hinge(select(larger_first, triangle.larger, triangle.smaller),
                                select(larger_first, triangle.smaller, triangle.larger));
    return {lift, triangle.cos_half, triangle.sin_half, reach.stretch, flags};
}

}  // namespace swivel::inline SWIVEL_ISA
