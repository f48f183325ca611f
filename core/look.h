// SPDX-License-Identifier: MIT
//
// Looking: a chain of joints turns so that a line of sight in the last one meets a point. Each joint takes its share of
// the turn that is left, and the last one all of it. Turns are rotors, and a share of one is a blend with no turn, so
// no angle is formed. Source: our own formulas.
#pragma once

#include "core/joint_frame.h"
#include "core/look_rules.h"
#include "core/part_of_turn.h"

namespace swivel::inline SWIVEL_ISA {

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
// How much of a look at a target counts.
template <class T>
SWIVEL_INLINE constexpr T look_weight(const LineOfSight<T>& sight, const Vector<T>& target, const LookFade& fade,
                                      const T& unit)
{
    const Vector<T> to = target - sight.eye;
    const T length = sqrt(len2(to)), cosine = scalar_product(sight.axis, to) / hi(length, T(kTiny));
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
// The shortest turn from one direction to another. Their lengths are any whose product is more than kTiny. Two that are
// opposite turn about any axis across them; to or from nothing there is no turn. From a turn by 160 degrees or more,
// rounding leaves less of the axis. So that goes by way of a direction between, by two turns that are well known.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> shortest_turn(const Vector<T>& from, const Vector<T>& to)
{
    const T length = sqrt(len2(from) * len2(to)), sum = length + scalar_product(from, to);
    const Mask<T> back = !(sum > T(0.0625) * length);
    const Vector<T> axis = cross(from, to);
    const T per = T(1) / sqrt(select(back, T(1), len2(axis) + sum * sum));
    const Rotor<T> turn =
        rotor(per * axis.template at<kE1>(), per * axis.template at<kE2>(), per * axis.template at<kE3>(), per * sum);
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
// Its share that the cone allows. A share of 0 is no turn, to the bit.
template <class T>
SWIVEL_INLINE constexpr LookTurn<T> look_turn(const Vector<T>& from, const Vector<T>& to, const T& share,
                                              const LookJoint& joint)
{
    const Rotor<T> whole = shortest_turn(from, to);
    const T cos_half = whole.template at<kScalar>(), part = bent_share(share, cos_half);
    const Vector<T> sine = part * vector(whole.template at<kI>(), whole.template at<kJ>(), whole.template at<kK>());
    const T cosine = T(1) - part + part * cos_half, sine2 = len2(sine), cosine2 = cosine * cosine;
    // By the tangent: a cosine does not tell small angles apart.
    const T max = T(joint.cos_half_max), max_sine = T(joint.sin_half_max);
    const Mask<T> held = sine2 * (max * max) > cosine2 * (max_sine * max_sine);
    const T scale = select(held, max_sine, T(1)) / sqrt(select(held, sine2, sine2 + cosine2));
    const Vector<T> v = scale * sine;
    return {rotor(v.template at<kE1>(), v.template at<kE2>(), v.template at<kE3>(), select(held, max, scale * cosine)),
            held};
}

// The turn of a joint of the chain before the last: it turns the direction of sight alone. Aimed as one rigid piece,
// its slope would be infinite where the target is as near to the joint as the line of sight is.
template <class T>
SWIVEL_INLINE constexpr LookTurn<T> share_of_look(const LineOfSight<T>& sight, const Vector<T>& target, const T& weight,
                                                  const LookJoint& joint)
{
    return look_turn(sight.axis, target - sight.eye, T(joint.share) * weight, joint);
}
// The turn of the last joint: the point of the line of sight that is as far from the joint as the target is comes to
// the target. A target that is nearer to the joint than all of the line is turned to as near as may be.
template <class T>
SWIVEL_INLINE constexpr LookTurn<T> rest_of_look(const LineOfSight<T>& sight, const Vector<T>& place,
                                                 const Vector<T>& target, const T& weight, const LookJoint& joint)
{
    const Vector<T> eye = sight.eye - place, to = target - place;
    const T along = scalar_product(eye, sight.axis);
    const T ahead = sqrt(hi(along * along + (len2(to) - len2(eye)), T(0)));
    const T scale = per_power_of_two(hi(length1(to), T(kTiny)));  // far targets have products beyond all floats
    return look_turn(scale * (eye + (ahead - along) * sight.axis), scale * to, weight, joint);
}
// Whether the line of sight meets the target, within 1e-4 rad.
template <class T>
SWIVEL_INLINE constexpr Mask<T> sees(const LineOfSight<T>& sight, const Vector<T>& target)
{
    const Vector<T> to = target - sight.eye;
    return (len2(cross(sight.axis, to)) <= T(1e-8) * len2(to)) & (scalar_product(sight.axis, to) > T(0));
}

// How a joint of a look is turned, as it is carried: its axis times the tangent of a quarter of its angle. turn: of
// unit length, by at most half a turn, so its scalar part is none or more.
template <class T>
SWIVEL_INLINE constexpr Vector<T> quarter_tangent(const Rotor<T>& turn)
{
    return (T(1) / (T(1) + turn.template at<kScalar>())) *
           vector(turn.template at<kI>(), turn.template at<kJ>(), turn.template at<kK>());
}
template <class T>
SWIVEL_INLINE constexpr Rotor<T> from_quarter_tangent(const Vector<T>& tangent)
{
    const T length2 = len2(tangent), per = T(1) / (T(1) + length2);
    const Vector<T> sine = (per + per) * tangent;
    return rotor(sine.template at<kE1>(), sine.template at<kE2>(), sine.template at<kE3>(), per * (T(1) - length2));
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
    const Vector<T> axis = (T(1) / hi(way.template at<kScalar>(), T(1e-3))) *
                           vector(way.template at<kI>(), way.template at<kJ>(), way.template at<kK>());
    return {axis, sqrt(len2(axis))};
}
inline constexpr double kStillTurn = 1e-6;  // a sum of such tangents below this is rounding
// A part of it, 0 to 1. As the tangent of an angle is at least the angle, it turns by no more than 2 * part * tangent.
// It lies between both turns, so within a cone that holds both.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> on_way(const Rotor<T>& from, const LookWay<T>& way, const T& part)
{
    const Vector<T> v = part * way.axis;
    return normalise(rotor(v.template at<kE1>(), v.template at<kE2>(), v.template at<kE3>(), T(1)) * from);
}

}  // namespace swivel::inline SWIVEL_ISA
