// SPDX-License-Identifier: MIT
//
// Looking: a chain of joints turns so that a line of sight in the last one meets a point. Each joint takes its share of
// the turn that is left, and the last one all of it. Turns are rotors, and a share of one is a blend with no turn, so
// no angle is formed. Source: our own formulas.
#pragma once

#include "core/group_rules.h"
#include "core/joint_frame.h"

namespace swivel::inline SWIVEL_ISA {

// The blend weight with which a normalised blend from the identity to a rotation covers a share of its angle. Using
// `share` itself would be up to 8 degrees off. The cubic below is exact at 0, 1/2 and 1, and off by at most 0.06
// degrees. cos_half: of half the angle, >= 0. Its coefficients are our own fit.
template <class T>
SWIVEL_INLINE constexpr T bent_share(const T& share, const T& cos_half)
{
    const T half = share - T(0.5);
    const T bend = (T(0.858644) + cos_half * (T(-1.191827) + cos_half * T(0.394120))) +
                   half * half * (T(0.972072) - cos_half * T(1.485737));
    return share + share * half * (share - T(1)) * bend;
}

// The rotation at a share of 0 to 1 of the short way to another. Both are of unit length. Share 1 gives the other, to
// the bit.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> part_of_turn(const Rotor<T>& from, const Rotor<T>& to, const T& share)
{
    const Rotor<T> turn = hemisphere(to * ~from);
    const T cos_half = lo(turn.template at<kScalar>(), T(1)), part = bent_share(share, cos_half);
    const Rotor<T> between = normalise(rotor(part * vector_part(turn), T(1) - part + part * cos_half)) * from;
    return select(share == T(1), to, between);
}

template <class T>
struct LineOfSight {
    Vector<T> eye, axis;  // axis: of unit length
};

// 0 to 1 as x goes from 0 to 1, without a kink at either end.
template <class T>
SWIVEL_INLINE constexpr T smooth_step(const T& x)
{
    const T s = lo(hi(x, T(0)), T(1));
    return s * s * (T(3) - s - s);
}
// The weight of a look: it fades for targets behind and too near.
template <class T>
SWIVEL_INLINE constexpr T look_weight(const LineOfSight<T>& sight, const Vector<T>& target, const LookFade& fade,
                                      const T& unit)
{
    const Vector<T> way = target - sight.eye;
    const T length = sqrt(len2(way)), cosine = scalar_product(sight.axis, way) / hi(length, T(kTiny));
    return smooth_step((cosine - T(fade.cos_none)) * T(fade.per_cos)) *
           smooth_step(length / hi(T(fade.distance) * unit, T(kTiny)));
}

template <class T>
struct LookTurn {
    Rotor<T> turn;  // of unit length
    Mask<T> held;   // by the cone
};
// The vectors are unit, and not opposite.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> turn_between(const Vector<T>& from, const Vector<T>& to)
{
    return normalise(one<T>() + to * from);
}
// The shortest turn from one direction to another. The product of their lengths must exceed kTiny, else there is no
// turn. Opposite directions turn about any axis across them. Beyond 160 degrees, rounding would spoil the axis, so the
// turn goes by way of a direction between, in two accurate turns.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> shortest_turn(const Vector<T>& from, const Vector<T>& to)
{
    const T length = sqrt(len2(from) * len2(to)), sum = length + scalar_product(from, to);
    const Mask<T> back = !(sum > T(0.0625) * length);
    const Vector<T> axis = cross(from, to);
    const T per = T(1) / sqrt(select(back, T(1), len2(axis) + sum * sum));
    const Rotor<T> turn = rotor(per * axis, per * sum);
    if (!any(back)) return turn;
    const Mask<T> none = !(length > T(kTiny));
    const auto direction = [&](const Vector<T>& v)
                               SWIVEL_INLINE_LAMBDA { return (T(1) / sqrt(select(none, T(1), len2(v)))) * v; };
    const Vector<T> a = direction(from), b = direction(to), across = b - scalar_product(a, b) * a;
    const Mask<T> opposite = (len2(across) < T(1e-12)) & !none;
    const Vector<T> e1 = vector(T(1), T(0), T(0)), e2 = vector(T(0), T(1), T(0)), start = select(none, e1, a),
                    middle = normalise(select(none, e2, select(opposite, any_across(start), across)));
    const Rotor<T> way = turn_between(middle, select(none, e1, b)) * turn_between(start, middle);
    return select(none, one<T>(), select(back, way, turn));
}
// A share of the shortest turn, held within the joint's cone. A share of 0 is the identity, to the bit.
template <class T>
SWIVEL_INLINE constexpr LookTurn<T> look_turn(const Vector<T>& from, const Vector<T>& to, const T& share,
                                              const LookJoint& joint)
{
    const Rotor<T> whole = shortest_turn(from, to);
    const T cos_half = whole.template at<kScalar>(), part = bent_share(share, cos_half);
    const Vector<T> sine = part * vector_part(whole);
    const T cosine = T(1) - part + part * cos_half, sine2 = len2(sine), cosine2 = cosine * cosine;
    // By the tangent: a cosine does not tell small angles apart.
    const T max = T(joint.cos_half_max), max_sine = T(joint.sin_half_max);
    const Mask<T> held = sine2 * (max * max) > cosine2 * (max_sine * max_sine);
    const T scale = select(held, max_sine, T(1)) / sqrt(select(held, sine2, sine2 + cosine2));
    return {rotor(scale * sine, select(held, max, scale * cosine)), held};
}

// The turn of a joint before the last: it turns the direction of sight alone. If the joint aimed the line of sight
// itself, a small move of the target would turn it without bound where the target is as near to the joint as that line
// is.
template <class T>
SWIVEL_INLINE constexpr LookTurn<T> share_of_look(const LineOfSight<T>& sight, const Vector<T>& target, const T& weight,
                                                  const LookJoint& joint)
{
    return look_turn(sight.axis, target - sight.eye, T(joint.share) * weight, joint);
}
// The turn of the last joint: it brings the point of the line of sight that is as far from the joint as the target to
// the target. If the target is nearer than the whole line, the line's nearest point turns towards it.
template <class T>
SWIVEL_INLINE constexpr LookTurn<T> rest_of_look(const LineOfSight<T>& sight, const Vector<T>& place,
                                                 const Vector<T>& target, const T& weight, const LookJoint& joint)
{
    const Vector<T> eye = sight.eye - place, goal = target - place;
    const T along = scalar_product(eye, sight.axis);
    const T ahead = sqrt(hi(along * along + (len2(goal) - len2(eye)), T(0)));
    const T scale = per_power_of_two(hi(length1(goal), T(kTiny)));  // far targets have products beyond all floats
    return look_turn(scale * (eye + (ahead - along) * sight.axis), scale * goal, weight, joint);
}
// Whether the line of sight meets the target, within 1e-4 rad.
template <class T>
SWIVEL_INLINE constexpr Mask<T> sees(const LineOfSight<T>& sight, const Vector<T>& target)
{
    const Vector<T> way = target - sight.eye;
    return (len2(cross(sight.axis, way)) <= T(1e-8) * len2(way)) & (scalar_product(sight.axis, way) > T(0));
}

// A joint's turn in the form that a look carries: its axis times the tangent of a quarter of its angle. turn: of unit
// length, by at most half a turn, so its scalar part is not negative.
template <class T>
SWIVEL_INLINE constexpr Vector<T> quarter_tangent(const Rotor<T>& turn)
{
    return (T(1) / (T(1) + turn.template at<kScalar>())) * vector_part(turn);
}
template <class T>
SWIVEL_INLINE constexpr Rotor<T> from_quarter_tangent(const Vector<T>& tangent)
{
    const T length2 = len2(tangent), per = T(1) / (T(1) + length2);
    return rotor((per + per) * tangent, per * (T(1) - length2));
}
// The turn that takes a joint from its present turn to its goal: an axis times the tangent of half of the angle.
template <class T>
struct LookWay {
    Vector<T> axis;
    T tangent;  // its length
};
template <class T>
SWIVEL_INLINE constexpr LookWay<T> look_way(const Rotor<T>& from, const Rotor<T>& goal)
{
    const Rotor<T> way = goal * ~from;
    const Vector<T> axis = (T(1) / hi(way.template at<kScalar>(), T(1e-3))) * vector_part(way);
    return {axis, sqrt(len2(axis))};
}
inline constexpr double kStillTurn = 1e-6;  // sums of tangents below this are rounding
// The turn after a part of the way, 0 to 1. It differs from the present turn by at most 2 * part * tangent, because an
// angle is at most its tangent. It lies between both turns, so a cone that holds both holds it.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> on_way(const Rotor<T>& from, const LookWay<T>& way, const T& part)
{
    return normalise(rotor(part * way.axis, T(1)) * from);
}

}  // namespace swivel::inline SWIVEL_ISA
