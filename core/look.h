// SPDX-License-Identifier: MIT
//
// Looking: a chain of joints turns so that a line of sight in the last one meets a point. Each joint takes its share of
// the turn that is left, and the last one all of it. Turns are rotors, and a share of one is a blend with no turn, so
// no angle is formed. Source: our own formulas.
#pragma once

#include "core/joint_frame.h"
#include "core/look_rules.h"

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

// A share of the angle of a rotation with the cosine of half its angle, cos_half >= 0. It goes from none to the
// rotation by a normalised blend. A blend of `share` is up to 8 degrees off. So the share is bent by a cubic, which is
// exact at 0, 1/2 and 1, and off by at most 0.06 degrees. Its coefficients are our own fit.
template <class T>
SWIVEL_INLINE constexpr T bent_share(const T& share, const T& cos_half)
{
    const T half = share - T(0.5);
    const T bend = (T(0.858644) + cos_half * (T(-1.191827) + cos_half * T(0.394120))) +
                   half * half * (T(0.972072) - cos_half * T(1.485737));
    return share + share * half * (share - T(1)) * bend;
}

template <class T>
struct LookTurn {
    Rotor<T> turn;  // of unit length
    Mask<T> held;   // by the cone
};
// Of unit vectors that are not opposite.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> turn_between(const Vector<T>& from, const Vector<T>& to)
{
    return normalise(one<T>() + to * from);
}
// The shortest turn from one direction to another. Their lengths are any whose product is more than kTiny. Two that are
// opposite turn about any axis across them; to or from nothing there is no turn. Of a turn by 160 degrees or more,
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
    const auto direction = [&](const Vector<T>& of)
                               SWIVEL_INLINE_LAMBDA { return (T(1) / sqrt(select(none, T(1), len2(of)))) * of; };
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
    const T most = T(joint.cos_half_most), most_sine = T(joint.sin_half_most);
    const Mask<T> held = sine2 * (most * most) > cosine2 * (most_sine * most_sine);
    const T scale = select(held, most_sine, T(1)) / sqrt(select(held, sine2, sine2 + cosine2));
    const Vector<T> v = scale * sine;
    return {rotor(v.template at<kE1>(), v.template at<kE2>(), v.template at<kE3>(), select(held, most, scale * cosine)),
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

// The line that a look follows: from the eye as it comes, towards the target. Its direction turns by at most `rate`. So
// does what a change of the distance turns it by, for an eye that the joints carry by `lever`.
template <class T>
struct FollowedLine {
    Vector<T> direction;  // of unit length
    T nearness;           // 1 / distance
};
template <class T>
struct FollowedStep {
    FollowedLine<T> line;
    Mask<T> behind;  // it has not come to its goal
};
inline constexpr double kStill = 1e-6;  // an angle below this is rounding
// half: half of the most turn of this step, in radians. The turn's half-tangent is half + half^3 / 3, less than
// tan(half). So it never turns further; at 0.5 radians it turns 3e-4 less. From pi on it turns all the way.
template <class T>
SWIVEL_INLINE constexpr FollowedStep<T> followed(const FollowedLine<T>& was, const FollowedLine<T>& goal,
                                                 const T& lever, const T& half)
{
    const T tangent = half + half * half * half * T(1.0 / 3), per = T(1) / (T(1) + tangent * tangent);
    const T cosine = (T(1) - tangent * tangent) * per, sine = (tangent + tangent) * per;
    const T between = scalar_product(was.direction, goal.direction);
    // Twice: of directions that are nearly opposite, rounding leaves some of the first in the rest.
    const Vector<T> rest = goal.direction - between * was.direction,
                    across = rest - scalar_product(rest, was.direction) * was.direction;
    const T across2 = len2(across), sine_between = sqrt(across2);
    const Mask<T> goes = half >= T(1.5707963267948966), known = sine_between > T(kStill);
    // By the sine of what would be left of the way, which is none for opposite directions.
    const Mask<T> left = (sine_between * cosine - between * sine > T(kStill)) | ((!known) & (between < T(0)));
    const Mask<T> turns = (!goes) & left;
    const Vector<T> side =
        select(known, (T(1) / select(known, sine_between, T(1))) * across, any_across(was.direction));
    const T most = (half + half) / hi(lever, T(kTiny)), change = goal.nearness - was.nearness;
    const Mask<T> comes = (!goes) & (abs(change) > most);
    return {{select(turns, normalise(cosine * was.direction + sine * side), goal.direction),
             select(comes, was.nearness + copysign(most, change), goal.nearness)},
            Mask<T>(turns | comes)};
}

}  // namespace swivel::inline SWIVEL_ISA
