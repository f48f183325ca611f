// SPDX-License-Identifier: MIT
//
// The wrist's place and the hand's orientation that a goal asks for, the line from the shoulder to that place, and a
// hand that yields where the wrist misses it. Everything is in the arm frame.
#pragma once

#include "core/clavicle.h"
#include "core/limb_goal.h"

namespace swivel::inline SWIVEL_ISA {

// Blends from a to b by weight, the short way.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> blended(const Rotor<T>& a, const Rotor<T>& b, const T& weight)
{
    const T side = scalar_product(~a, b);
    const Rotor<T> near = flip_sign(b, side);
    return normalise(a + weight * (near - a));
}

// The hand's orientation and the wrist's place that the goal asks for.
template <class T>
struct WristGoal {
    Rotor<T> hand;
    Vector<T> place;
};
template <class T>
SWIVEL_INLINE constexpr WristGoal<T> wrist_goal(swivel_features features, const LimbGoal<T>& goal)
{
    WristGoal<T> wrist{one<T>(), goal.arm.wrist};
    if (features & SWIVEL_WITH_HAND) wrist.hand = normalise(goal.hand);
    const auto& [shoulder, elbow, hand] = goal.incoming;
    if (features & SWIVEL_WITH_HAND && features & SWIVEL_WITH_WEIGHTS)
        wrist.hand = blended(normalise(shoulder * elbow * hand), wrist.hand, goal.weights.hand);
    if (features & SWIVEL_WITH_EFFECTOR && !(features & SWIVEL_WITH_AIM))
        wrist.place = wrist.place - sandwich(wrist.hand, goal.effector);
    if (features & SWIVEL_WITH_WEIGHTS) {
        // Each rotor also scales a bone by the square of its length.
        const auto e3 = unit<T, kE3>();
        const T shoulder2 = len2(shoulder), elbow2 = len2(elbow);
        const Vector<T> incoming_wrist =
            (T(1) / (shoulder2 * elbow2)) *
            ((goal.arm.upper * elbow2) * sandwich(shoulder, e3) + goal.arm.fore * sandwich(shoulder * elbow, e3));
        const T weight = goal.weights.position;
        wrist.place = (T(1) - weight) * incoming_wrist + weight * wrist.place;  // exactly one of them at 0 and at 1
    }
    return wrist;
}

// The line from the shoulder to the wrist. If the wrist is on the shoulder, it is e3.
template <class T>
struct WristLine {
    Vector<T> line;  // unit
    T wanted;        // the distance
    Mask<T> on_shoulder;
};
template <class T>
SWIVEL_INLINE constexpr WristLine<T> wrist_line(const Vector<T>& wrist)
{
    const T wrist2 = len2(wrist);
    const Mask<T> on_shoulder = wrist2 < T(kTiny2);
    const T distance = sqrt(select(on_shoulder, T(1), wrist2));
    return {select(on_shoulder, vector(T(0), T(0), T(1)), (T(1) / distance) * wrist),
            select(on_shoulder, T(0), distance), on_shoulder};
}

// In limb lengths: a wrist this near to its place is at its place (SWIVEL_REACHED).
inline constexpr double kAtItsPlace = 1e-6;

// Whether the wrist misses its place. missing: from the wrist to its place. length: of the limb.
template <class T>
SWIVEL_INLINE constexpr Mask<T> misses_its_place(const Vector<T>& missing, const T& length)
{
    const T min = T(kAtItsPlace) * length;
    return len2(missing) > min * min;
}
// A hand that yields: where the wrist misses its place, the least turn about the wrist brings the effector nearest to
// its target, onto the line from the wrist. So a heel lifts where the leg is too short for the toe. A target straight
// behind has no shorter way round, and nothing turns. hand: of unit length.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> yielding_hand(const Rotor<T>& hand, const Vector<T>& effector,
                                               const Vector<T>& missing, const T& length)
{
    const Mask<T> misses = misses_its_place(missing, length);
    if (!any(misses)) return hand;
    const Vector<T> from_wrist = sandwich(hand, effector);
    return select(misses, clavicle_rotation(from_wrist, from_wrist + missing, T(1)) * hand, hand);
}

}  // namespace swivel::inline SWIVEL_ISA
