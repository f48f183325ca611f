// SPDX-License-Identifier: MIT
//
// An arm's joint limits, written as limits of its swivel (limits.h). All of them are measured from the rest pose. Axes
// are those of the arm frame at rest. Twists and Euler angles are those of what the joint adds to rest. The elbow's
// flexion does not depend on the swivel: its limit is a range of reach (limb_bones.h).
#pragma once

#include "core/arm.h"
#include "core/frame_rotor.h"
#include "core/limits.h"

namespace swivel::inline SWIVEL_ISA {

// Which limits a group has, the axes' orders in its boxes, and the region of its upper arms.
struct LimitUse {
    bool flexion = false, shoulder_cone = false, hand_cone = false, humeral_twist = false, forearm_twist = false,
         hand_twist = false, shoulder_box = false, wrist_box = false;
    EulerOrder shoulder_order = kEulerOrders[0], wrist_order = kEulerOrders[0];
    const swivel_region* region = nullptr;  // null: none

    constexpr bool on_swivel() const
    {
        return shoulder_cone || hand_cone || humeral_twist || forearm_twist || hand_twist || shoulder_box ||
               wrist_box || region;
    }
};

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

template <class T>
struct JointLimits {
    FlexionLimit<T> flexion;
    Cone<T> shoulder_cone;                   // of the upper arm
    Cone<T> hand_cone;                       // of the forearm about the hand's axis
    Range<T> humeral_twist;                  // of the upper arm about itself
    Range<T> forearm_twist;                  // of the hand about the forearm
    Twist<T> hand_twist;                     // of the hand about its own axis
    Range<T> shoulder_box[3], wrist_box[3];  // first, middle, last
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

// The component of a rotor that turns about the axis: the dot product of the axis and the rotor's vector part.
template <class T>
SWIVEL_INLINE constexpr T about(const Vector<T>& axis, const Rotor<T>& q)
{
    return axis.template at<kE1>() * q.template at<kI>() + axis.template at<kE2>() * q.template at<kJ>() +
           axis.template at<kE3>() * q.template at<kK>();
}

// A fixed vector, in the line's frame.
template <class T, class Lift, class V>
SWIVEL_INLINE constexpr Vector<T> in_line(const SwivellingArm<T, Lift>& arm, const V& v)
{
    return vector(scalar_product(arm.normal, v), scalar_product(cross(arm.line, arm.normal), v),
                  scalar_product(arm.line, v));
}
// A vector that moves with the arm is as much longer as to_arm's square.
template <class T, class Lift>
SWIVEL_INLINE constexpr T per_size(const SwivellingArm<T, Lift>& arm)
{
    return T(1) / len2(arm.to_arm);
}
// The forearm turns with the arm, the hand stays. The wrist's rotor is (arm elbow)^-1 hand.
template <class T, class Lift>
SWIVEL_INLINE constexpr auto forearm_of(const SwivellingArm<T, Lift>& arm)
{
    return arm.to_arm * arm.elbow;
}

template <class T, class Lift>
SWIVEL_INLINE constexpr OnCircle<T> shoulder_cone_limit(const SwivellingArm<T, Lift>& arm, const Cone<T>& cone)
{
    return cone_limit(per_size(arm) * inner(in_line(arm, cone.axis), sandwich(arm.to_arm, unit<T, kE3>())),
                      cone.cos_opening);
}
template <class T, class Lift>
SWIVEL_INLINE constexpr OnCircle<T> hand_cone_limit(const SwivellingArm<T, Lift>& arm, const Cone<T>& cone)
{
    return cone_limit(
        per_size(arm) * inner(in_line(arm, sandwich(arm.hand, cone.axis)), sandwich(forearm_of(arm), unit<T, kE3>())),
        cone.cos_opening);
}

// Twists come from products of a rotor's components. Near a swing of half a turn all of them are small, and sums of a
// matrix's entries would leave their rounding errors.
template <class T>
struct Twisting {
    Rotor<T> at_0, at_pi;  // the rotor that twists, at phi = 0 and at pi
    T per_size;

    // s: the rotor's part along the twist's axis.
    SWIVEL_INLINE constexpr OnCircle<T> limit(const OnHalfCircle<T>& s, const Range<T>& range) const
    {
        const OnHalfCircle<T> w{at_0.template at<kScalar>(), at_pi.template at<kScalar>()};
        return per_size * twist_limit(w, s, range);
    }
    SWIVEL_INLINE constexpr OnHalfCircle<T> along_e3() const
    {
        return {at_0.template at<kK>(), at_pi.template at<kK>()};
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
template <class T, class Lift>
SWIVEL_INLINE constexpr OnCircle<T> humeral_twist_limit(const SwivellingArm<T, Lift>& arm, const Range<T>& range)
{
    const Twisting<T> twisting = upper_arm_twisting(arm);
    return twisting.limit(twisting.along_e3(), range);
}
template <class T, class Lift>
SWIVEL_INLINE constexpr OnCircle<T> forearm_twist_limit(const SwivellingArm<T, Lift>& arm, const Range<T>& range)
{
    const Twisting<T> twisting = wrist_twisting(arm);
    return twisting.limit(twisting.along_e3(), range);
}
template <class T, class Lift>
SWIVEL_INLINE constexpr OnCircle<T> hand_twist_limit(const SwivellingArm<T, Lift>& arm, const Twist<T>& twist)
{
    const Twisting<T> twisting = wrist_twisting(arm);
    return twisting.limit({about(twist.axis, twisting.at_0), about(twist.axis, twisting.at_pi)}, twist.range);
}

// The entries of the matrix whose rows are fixed axes, and whose columns turn with the arm.
template <class T>
struct TurningMatrix {
    Vector<T> row[3];  // in the line's frame
    T per_size;
    template <class Turning>
    SWIVEL_INLINE constexpr OnCircle<T> entry(int at, const Turning& column) const
    {
        return per_size * inner(row[at], column);
    }
};
template <class T, class Lift, class Turning>
SWIVEL_INLINE constexpr auto turning_matrix(const SwivellingArm<T, Lift>& arm, const auto& e1, const auto& e2,
                                            const auto& e3, const Turning& turning)
{
    const TurningMatrix<T> matrix{{in_line(arm, e1), in_line(arm, e2), in_line(arm, e3)}, per_size(arm)};
    const auto column1 = sandwich(turning, unit<T, kE1>());
    const auto column2 = sandwich(turning, unit<T, kE2>());
    const auto column3 = sandwich(turning, unit<T, kE3>());
    return [=](int row, int column) SWIVEL_INLINE_LAMBDA {
        if (column == 0) return matrix.entry(row, column1);
        return column == 1 ? matrix.entry(row, column2) : matrix.entry(row, column3);
    };
}
template <class T, class Lift>
SWIVEL_INLINE constexpr EulerCurves<T> shoulder_box_curves(const SwivellingArm<T, Lift>& arm, const EulerOrder& order)
{
    return euler_curves<T>(order, turning_matrix(arm, unit<T, kE1>(), unit<T, kE2>(), unit<T, kE3>(), arm.to_arm));
}
// Its matrix has the forearm's axes in its rows, so what moves belongs to the row.
template <class T, class Lift>
SWIVEL_INLINE constexpr EulerCurves<T> wrist_box_curves(const SwivellingArm<T, Lift>& arm, const EulerOrder& order)
{
    const Turn<T> hand = turn_by(arm.hand);
    const auto transposed = turning_matrix(arm, hand.e1, hand.e2, hand.e3, forearm_of(arm));
    return euler_curves<T>(order, [&](int row, int column) SWIVEL_INLINE_LAMBDA { return transposed(column, row); });
}

// The limits, and the flag of each in the order of Limits: lines, then boxes.
template <class T>
struct SwivelLimits {
    Limits<T> limits;
    std::uint32_t line_flag[kMaxLines] = {}, box_flag[kMaxBoxes] = {};
};

template <class T, class Lift>
SWIVEL_INLINE constexpr SwivelLimits<T> swivel_limits(const LimitUse& use, const JointLimits<T>& limits,
                                                      const SwivellingArm<T, Lift>& arm)
{
    SwivelLimits<T> out;
    const auto add = [&](const OnCircle<T>& line, std::uint32_t flag) SWIVEL_INLINE_LAMBDA {
        out.line_flag[out.limits.line_count] = flag;
        out.limits.line[out.limits.line_count++] = line;
    };
    const auto add_box = [&](const EulerCurves<T>& curves, const Range<T>(&box)[3],
                             std::uint32_t flag) SWIVEL_INLINE_LAMBDA {
        out.box_flag[out.limits.box_count] = flag;
        out.limits.box[out.limits.box_count++] = {curves, euler_ranges(box[0], box[1], box[2])};
    };
    if (use.shoulder_cone) add(shoulder_cone_limit(arm, limits.shoulder_cone), SWIVEL_LIMITED_SHOULDER_CONE);
    if (use.humeral_twist) add(humeral_twist_limit(arm, limits.humeral_twist), SWIVEL_LIMITED_HUMERAL_TWIST);
    if (use.hand_cone) add(hand_cone_limit(arm, limits.hand_cone), SWIVEL_LIMITED_HAND_CONE);
    if (use.forearm_twist) add(forearm_twist_limit(arm, limits.forearm_twist), SWIVEL_LIMITED_FOREARM_TWIST);
    if (use.hand_twist) add(hand_twist_limit(arm, limits.hand_twist), SWIVEL_LIMITED_HAND_TWIST);
    if (use.shoulder_box)
        add_box(shoulder_box_curves(arm, use.shoulder_order), limits.shoulder_box, SWIVEL_LIMITED_SHOULDER_BOX);
    if (use.wrist_box) add_box(wrist_box_curves(arm, use.wrist_order), limits.wrist_box, SWIVEL_LIMITED_WRIST_BOX);
    return out;
}

}  // namespace swivel::inline SWIVEL_ISA
