// SPDX-License-Identifier: MIT
//
// The wish for the elbow: the normal of the swivel plane that a goal asks for, and how far it may turn in a frame. A
// pole within kPoleOff of the line is undefined. The first of these that is defined replaces it: the previous normal,
// the incoming pose's, the rest hinge e1, or e2.
#pragma once

#include "core/limb_goal.h"

namespace swivel::inline SWIVEL_ISA {

// v without its part along the unit vector u.
template <class T>
SWIVEL_INLINE constexpr Vector<T> across(const Vector<T>& v, const Vector<T>& u)
{
    return v - scalar_product(v, u) * u;
}
// A vector or rotor times a power of two, which makes it somewhat shorter than 1. One that was shorter than kTiny stays
// shorter still.
template <class T, BladeSet S>
SWIVEL_INLINE constexpr Mv<T, S> scaled(const Mv<T, S>& m)
{
    return per_power_of_two(hi(length1(m), T(kTiny))) * m;
}

// The direction back along the forearm if the wrist does not bend, which serves as a pole. Source: our own.
template <class T>
SWIVEL_INLINE constexpr Vector<T> pole_from_hand(const Rotor<T>& hand)
{
    return -sandwich(scaled(hand), unit<T, kE3>());
}
// The sine of 20 degrees. Within this angle of the line a hand's pole is unsure, and the incoming normal counts more.
inline constexpr double kSureHand = 0.342;

// The normal by the hand, filled up with the incoming normal where it is too short. exists: the lanes that have an
// incoming normal.
template <class T>
SWIVEL_INLINE constexpr Vector<T> blend_with_incoming(const Vector<T>& by_hand, const Vector<T>& incoming_normal,
                                                      const Mask<T>& exists, const T& hand_length)
{
    const T lacks = hi(T(kSureHand) * hand_length - sqrt(len2(by_hand)), T(0));
    return by_hand + select(exists, lacks / sqrt(select(exists, len2(incoming_normal), T(1))), T(0)) * incoming_normal;
}

// The normal that needs no pole. It jumps where the line is `behind`, and nowhere else; no normal that the line alone
// decides jumps in less than one direction. Its length is 1 less the cosine of the angle from `behind`. Source: the
// stereographic angle of A. Elias and J. Wen, Redundancy parameterization and inverse kinematics of 7-DOF revolute
// manipulators, arXiv 2307.13122.
template <class T>
struct HalfLineNormal {
    Vector<T> normal;
    Mask<T> is_defined;
};
template <class T>
SWIVEL_INLINE constexpr HalfLineNormal<T> half_line_normal(const Vector<T>& behind, const Vector<T>& normal,
                                                           const Vector<T>& line)
{
    // As a mirror image it is as exact as the direction of `mirror` is. With (line - behind) x V made orthogonal to the
    // line, which it equals for `normal` = V x behind, errors would grow with the square.
    const Vector<T> mirror = line - behind;
    const T length2 = len2(mirror);
    const Vector<T> image = T(0.5) * length2 * normal - scalar_product(mirror, normal) * mirror;
    return {across(image, line), length2 > T(kPoleOff * kPoleOff)};
}

// How an elbow goes on from solve to solve.
template <class T>
struct Continuity {
    Vector<T> previous_normal;  // zero: none
    Turned<T> max;              // swivel in a frame, 0 to pi
};
template <class T>
SWIVEL_INLINE constexpr Mask<T> is_valid(const Continuity<T>& continuity)
{
    const Turned<T>& max = continuity.max;
    return (len2(continuity.previous_normal) <= T(1.01)) & (max.sin >= T(-1e-6)) &
           is_unit2(max.cos * max.cos + max.sin * max.sin);
}

// The parts of a limb's goal that the wish is made of. Parts that the group's features do not use may hold anything.
template <class T>
struct WishGoal {
    Vector<T> pole;            // or the swivel plane's normal
    Vector<T> behind, normal;  // with SWIVEL_POLE_HALF_LINE: see HalfLine
    Rotor<T> hand;             // with SWIVEL_POLE_HAND: as blended
    Turned<T> angle;           // turns the wish about the line from shoulder to wrist; of any length
    Rotor<T> incoming;         // with SWIVEL_WITH_INCOMING: the shoulder's rotation
    T weight;                  // of the pole, 0 to 1
    Continuity<T> continuity;
};

// The normal of the swivel plane that the goal asks for, across the line.
template <class T>
struct WishedNormal {
    Vector<T> normal;  // unit
    Mask<T> undefined;
};
template <class T>
SWIVEL_INLINE constexpr WishedNormal<T> wished_normal(swivel_features features, const WishGoal<T>& goal,
                                                      const Vector<T>& line)
{
    // Whether a pole of this squared length is defined. normal: its part across the line.
    const auto is_off = [](const Vector<T>& normal, const T& of2)
                            SWIVEL_INLINE_LAMBDA { return len2(normal) > T(kPoleOff * kPoleOff) * of2; };
    Vector<T> incoming_normal = vector(T(0), T(0), T(0));
    Mask<T> incoming_is_defined = no_lanes<T>();
    if (features & SWIVEL_WITH_INCOMING) {
        const T length2 = len2(goal.incoming);
        incoming_normal = across(sandwich(goal.incoming, unit<T, kE1>()), line);
        incoming_is_defined = is_off(incoming_normal, length2 * length2);
    }

    Vector<T> normal = incoming_normal;  // of any length until the end
    Mask<T> is_defined = incoming_is_defined, keeps_incoming = incoming_is_defined;
    if (features & SWIVEL_POLE_HALF_LINE) {
        const HalfLineNormal<T> found = half_line_normal(goal.behind, goal.normal, line);
        normal = found.normal;
        is_defined = found.is_defined;
    } else if (!(features & SWIVEL_POLE_INCOMING)) {
        const Vector<T> given = features & SWIVEL_POLE_HAND ? pole_from_hand(goal.hand) : goal.pole,
                        pole = scaled(given);
        normal = across(features & SWIVEL_POLE_NORMAL ? pole : cross(line, pole), line);
        if (features & SWIVEL_POLE_HAND && features & SWIVEL_WITH_INCOMING)
            normal = blend_with_incoming(normal, incoming_normal, incoming_is_defined, sqrt(len2(pole)));
        is_defined = is_off(normal, len2(pole)) & (len2(given) >= T(kTiny2));
    }
    const Mask<T> undefined = !is_defined;
    if (any(undefined)) {  // the substitutes, the best one last
        const Vector<T> hinge = vector(T(1), T(0), T(0)), other = vector(T(0), T(1), T(0));
        Vector<T> instead = select(is_off(across(hinge, line), T(1)), across(hinge, line), across(other, line));
        if (features & SWIVEL_WITH_INCOMING) instead = select(incoming_is_defined, incoming_normal, instead);
        if (features & SWIVEL_WITH_MAX_SWIVEL) {
            const Vector<T> previous = across(goal.continuity.previous_normal, line);
            const Mask<T> off = is_off(previous, T(1));
            keeps_incoming = keeps_incoming | off;
            instead = select(off, previous, instead);
        }
        normal = select(undefined, across(instead, line), normal);
    }
    if (features & SWIVEL_WITH_ANGLE) {  // a kept elbow has the angle in it already
        const Vector<T> turned = scaled(goal.angle.cos * normal + goal.angle.sin * cross(line, normal));
        normal = select(undefined & keeps_incoming, normal, turned);
    }
    if (features & SWIVEL_WITH_WEIGHTS) {
        const Vector<T> from = select(incoming_is_defined, incoming_normal, normal);
        const T from2 = len2(from);
        const Vector<T> wish = sqrt(from2 / len2(normal)) * normal, between = from + goal.weight * (wish - from);
        normal = select(is_off(between, from2), between, from);
    }
    return {normalise(normal), undefined};
}

// A normal within the frame's max swivel of the previous one.
template <class T>
struct SteppedNormal {
    Vector<T> normal;
    Mask<T> limited;
};
// Whether a turn about the line from one unit normal to another is larger than the max, by more than slack.
template <class T>
SWIVEL_INLINE constexpr Mask<T> is_beyond(const Vector<T>& from, const Vector<T>& to, const Vector<T>& line,
                                          const Turned<T>& max, double slack)
{
    // The first term is the sine of the excess over the max. It is small near an excess of half a turn, so the cosines
    // decide there.
    const T cos_turn = scalar_product(from, to), sin_turn = abs(scalar_product(cross(from, to), line));
    return (sin_turn * max.cos - cos_turn * abs(max.sin) > T(slack)) | (cos_turn < max.cos - T(1e-3));
}

// A step for a 60th of a second, scaled to another time. The tangent of half its angle is proportional to the time. So
// small angles are, too, and half a turn, which is no limit, stays half a turn in any time but 0.
template <class T>
SWIVEL_INLINE constexpr Turned<T> timed_step(const Turned<T>& step, const T& seconds)
{
    const T sine = abs(step.sin);
    const Mask<T> is_wide = step.cos < T(0);
    const T half_tangent =
                select(is_wide, T(1) - step.cos, sine) / hi(select(is_wide, sine, T(1) + step.cos), T(1e-12)),
            tangent = lo(T(60) * seconds * half_tangent, T(1e15)), per = T(1) / (T(1) + tangent * tangent);
    return {per * (T(1) - tangent * tangent), per * (tangent + tangent)};
}

// The previous normal, brought across the new line; the other normal if there is none.
template <class T>
struct CarriedNormal {
    Vector<T> normal;  // unit
    Mask<T> exists;
};
template <class T>
SWIVEL_INLINE constexpr CarriedNormal<T> carried_normal(const Continuity<T>& state, const Vector<T>& line,
                                                        const Vector<T>& other)
{
    const Vector<T> carried = across(state.previous_normal, line);
    const Mask<T> exists = len2(carried) > T(kPoleOff * kPoleOff);
    return {normalise(select(exists, carried, other)), exists};
}
template <class T>
SWIVEL_INLINE constexpr SteppedNormal<T> stepped_normal(const Continuity<T>& state, const Vector<T>& wish,
                                                        const Vector<T>& line)
{
    const auto [previous, has_previous] = carried_normal(state, line, wish);
    const Mask<T> limited = has_previous & is_beyond(previous, wish, line, state.max, 1e-7);
    const T side = scalar_product(cross(previous, wish), line);
    const Vector<T> stepped = state.max.cos * previous + copysign(state.max.sin, side) * cross(line, previous);
    return {select(limited, stepped, wish), limited};
}
// Where the step wins over limits: their normal, brought within the frame's max swivel of the previous one.
template <class T>
SWIVEL_INLINE constexpr Vector<T> last_step(const Continuity<T>& state, const Vector<T>& normal, const Vector<T>& line,
                                            Word<T>& flags)
{
    const SteppedNormal<T> step = stepped_normal(state, normal, line);
    flags = flags | word_where(step.limited, SWIVEL_LIMITED_STEP);
    return step.normal;
}
// Whether the limits turn the normal further from the previous one than the frame's max swivel.
template <class T>
SWIVEL_INLINE constexpr Mask<T> jumps(const Continuity<T>& state, const Vector<T>& normal, const Vector<T>& line)
{
    const auto [previous, has_previous] = carried_normal(state, line, normal);
    return has_previous & is_beyond(previous, normal, line, state.max, 1e-6);
}

// The normal that limits start from: the wish, within the frame's max swivel of the previous one. Where the step wins,
// limits come before it, so this is the wish alone.
template <class T>
struct LimbNormal {
    Vector<T> normal;  // unit
    Word<T> flags;
};
template <class T>
SWIVEL_INLINE constexpr LimbNormal<T> limb_normal(swivel_features features, const WishGoal<T>& goal,
                                                  const Vector<T>& line)
{
    const WishedNormal<T> wish = wished_normal(features, goal, line);
    LimbNormal<T> limb{wish.normal, word_where(wish.undefined, SWIVEL_SWIVEL_UNDEFINED)};
    if (features & SWIVEL_WITH_MAX_SWIVEL && !(features & SWIVEL_STEP_WINS)) {
        const SteppedNormal<T> step = stepped_normal(goal.continuity, limb.normal, line);
        limb = {step.normal, limb.flags | word_where(step.limited, SWIVEL_LIMITED_STEP)};
    }
    // Again, because rounding leaves a part along the line in a wish close to it. This shortens the normal by less than
    // rounding.
    limb.normal = across(limb.normal, line);
    return limb;
}
// The normal turned by the chosen swivel.
template <class T>
SWIVEL_INLINE constexpr Vector<T> swivelled(const Vector<T>& normal, const Vector<T>& line, const Turned<T>& swivel)
{
    return swivel.cos * normal + swivel.sin * cross(line, normal);
}

}  // namespace swivel::inline SWIVEL_ISA
