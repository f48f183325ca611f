// SPDX-License-Identifier: MIT
//
// An arm's joint limits, written as limits of its swivel (angle_limits.h). All of them are measured from the rest pose.
// Axes are those of the arm frame at rest. Twists and Euler angles are those of the rotation that the joint adds to
// rest. The elbow's flexion does not depend on the swivel: its limit is a range of reach (limb_bones.h).
#pragma once

#include "core/angle_limits.h"
#include "core/arm.h"
#include "core/frame_rotor.h"

namespace swivel::inline SWIVEL_ISA {

template <class T>
struct FlexionLimit {
    T cos_half_min, cos_half_max;
};
template <class T>
struct Cone {
    Vector<T> axis;  // unit
    T cos_opening;   // of half the cone's angle
};
template <class T>
struct Twist {
    Vector<T> axis;  // unit
    Range<T> range;
};

// The arm that swivels about a line. The line's frame has e3 along it, and e1 along the swivel plane's normal at phi =
// 0.
template <class T, class Lift>
struct SwivellingArm {
    Vector<T> line, normal;  // unit and orthogonal
    Lift to_arm;             // the arm's pose in the line's frame at phi = 0, of any length
    Hinge<T> elbow;
    Rotor<T> hand;  // orientation, in the arm frame
};

// A fixed vector, in the line's frame.
template <class T, class Lift, class V>
SWIVEL_INLINE constexpr Vector<T> in_line(const SwivellingArm<T, Lift>& arm, const V& v)
{
    return vector(scalar_product(arm.normal, v), scalar_product(cross(arm.line, arm.normal), v),
                  scalar_product(arm.line, v));
}
// Vectors turned by to_arm come out longer by its squared length; this undoes it.
template <class T, class Lift>
SWIVEL_INLINE constexpr T per_size(const SwivellingArm<T, Lift>& arm)
{
    return T(1) / len2(arm.to_arm);
}
// The forearm's rotor, which turns with the arm while the hand stays: the wrist's rotor is (arm elbow)^-1 hand.
template <class T, class Lift>
SWIVEL_INLINE constexpr auto forearm_of(const SwivellingArm<T, Lift>& arm)
{
    return arm.to_arm * arm.elbow;
}

// Twists come from products of a rotor's components. Near a swing of half a turn all of them are small, and sums of a
// matrix's entries would leave their rounding errors.
template <class T>
struct Twisting {
    Rotor<T> at_0, at_pi;  // the rotor that twists, at phi = 0 and at pi
    T per_size;

    template <class Axis>
    SWIVEL_INLINE constexpr OnCircle<T> limit(const Axis& axis, const Range<T>& range) const
    {
        const OnHalfCircle<T> w{at_0.template at<kScalar>(), at_pi.template at<kScalar>()},
            s{scalar_product(axis, vector_part(at_0)), scalar_product(axis, vector_part(at_pi))};
        return per_size * twist_limit(w, s, range);
    }
};
template <class T, class Lift>
SWIVEL_INLINE constexpr Twisting<T> upper_arm_twisting(const SwivellingArm<T, Lift>& arm)
{
    const Rotor<T> from_line = frame_along(arm.line, arm.normal);
    return {from_line * arm.to_arm, from_line * unit<T, kK>() * arm.to_arm, per_size(arm) / len2(from_line)};
}
template <class T, class Lift>
SWIVEL_INLINE constexpr Twisting<T> wrist_twisting(const SwivellingArm<T, Lift>& arm)
{
    const Rotor<T> from_line = frame_along(arm.line, arm.normal);
    const auto forearm = forearm_of(arm);
    const Rotor<T> hand = ~from_line * arm.hand;
    return {~forearm * hand, ~forearm * ~unit<T, kK>() * hand, per_size(arm) / len2(from_line)};
}

// The limits that are one line each, by field. An arm has one box for each joint.
//
// The upper arm stays within a cone about a fixed axis, the forearm within one that goes with the hand: the cosine of
// the angle to the axis must be at least the opening's.
inline constexpr int kMaxLines = 5, kMaxBoxes = 2;
template <swivel_field limit, class T, class Lift, class Value>
SWIVEL_INLINE constexpr OnCircle<T> limit_line(const SwivellingArm<T, Lift>& arm, const Value& value)
{
    if constexpr (limit == SWIVEL_SHOULDER_CONE) {
        const auto upper_arm = sandwich(arm.to_arm, unit<T, kE3>());
        return per_size(arm) * inner(in_line(arm, value.axis), upper_arm) - constant(value.cos_opening);
    } else if constexpr (limit == SWIVEL_HAND_CONE) {
        const auto forearm = sandwich(forearm_of(arm), unit<T, kE3>());
        const Vector<T> axis = in_line(arm, sandwich(arm.hand, value.axis));
        return per_size(arm) * inner(axis, forearm) - constant(value.cos_opening);
    } else if constexpr (limit == SWIVEL_HUMERAL_TWIST) {
        return upper_arm_twisting(arm).limit(unit<T, kE3>(), value);
    } else if constexpr (limit == SWIVEL_FOREARM_TWIST) {
        return wrist_twisting(arm).limit(unit<T, kE3>(), value);
    } else {
        static_assert(limit == SWIVEL_HAND_TWIST);
        return wrist_twisting(arm).limit(value.axis, value.range);
    }
}

// The entries of the matrix whose rows are fixed axes, and whose columns turn with the arm.
template <class T, class Lift, class Turning>
SWIVEL_INLINE constexpr auto turning_matrix(const SwivellingArm<T, Lift>& arm, const auto& e1, const auto& e2,
                                            const auto& e3, const Turning& turning)
{
    const Vector<T> rows[3] = {in_line(arm, e1), in_line(arm, e2), in_line(arm, e3)};  // in the line's frame
    const T size = per_size(arm);
    const auto column1 = sandwich(turning, unit<T, kE1>());
    const auto column2 = sandwich(turning, unit<T, kE2>());
    const auto column3 = sandwich(turning, unit<T, kE3>());
    return [=](int row, int column) SWIVEL_INLINE_LAMBDA {
        if (column == 0) return size * inner(rows[row], column1);
        return column == 1 ? size * inner(rows[row], column2) : size * inner(rows[row], column3);
    };
}
template <class T, class Lift>
SWIVEL_INLINE constexpr EulerCurves<T> shoulder_box_curves(const SwivellingArm<T, Lift>& arm, const EulerOrder& order)
{
    return euler_curves<T>(order, turning_matrix(arm, unit<T, kE1>(), unit<T, kE2>(), unit<T, kE3>(), arm.to_arm));
}
// The wrist's matrix has the forearm's axes, which move, in its rows.
template <class T, class Lift>
SWIVEL_INLINE constexpr EulerCurves<T> wrist_box_curves(const SwivellingArm<T, Lift>& arm, const EulerOrder& order)
{
    const Turn<T> hand = turn_by(arm.hand);
    const auto transposed = turning_matrix(arm, hand.e1, hand.e2, hand.e3, forearm_of(arm));
    return euler_curves<T>(order, [&](int row, int column) SWIVEL_INLINE_LAMBDA { return transposed(column, row); });
}

}  // namespace swivel::inline SWIVEL_ISA
