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

// Which limits a group has, and the axes' orders in its boxes.
struct LimitUse {
    bool flexion = false, shoulder_cone = false, hand_cone = false, humeral_twist = false, forearm_twist = false,
         hand_twist = false, shoulder_box = false, wrist_box = false;
    EulerOrder shoulder_order = kEulerOrders[0], wrist_order = kEulerOrders[0];

    constexpr bool on_swivel() const
    {
        return shoulder_cone || hand_cone || humeral_twist || forearm_twist || hand_twist || shoulder_box || wrist_box;
    }
};

template <class T>
struct FlexionLimit {
    T cos_half_least, cos_half_most;
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

// The limits, and the flag of each in the order of Limits: lines, then boxes.
template <class T, int Boxes>
struct SwivelLimits {
    Limits<T, Boxes> limits;
    std::uint32_t line_flag[kMostLines] = {}, box_flag[kMostBoxes] = {};
};

// The component of a rotor that turns about the axis: the dot product of the axis and the rotor's vector part.
template <class T>
SWIVEL_INLINE constexpr T about(const Vector<T>& axis, const Rotor<T>& q)
{
    return axis.template at<kE1>() * q.template at<kI>() + axis.template at<kE2>() * q.template at<kJ>() +
           axis.template at<kE3>() * q.template at<kK>();
}

// Boxes: how many there may be, 0 or kMostBoxes.
template <int Boxes = kMostBoxes, class T, class Lift>
SWIVEL_INLINE constexpr SwivelLimits<T, Boxes> swivel_limits(const LimitUse& use, const JointLimits<T>& limits,
                                                             const SwivellingArm<T, Lift>& arm)
{
    const auto e3 = unit<T, kE3>();
    const auto k = unit<T, kK>();
    const Lift& to_arm = arm.to_arm;
    const Vector<T> side = cross(arm.line, arm.normal);
    const auto in_line = [&](const auto& v) SWIVEL_INLINE_LAMBDA {
        return vector(scalar_product(arm.normal, v), scalar_product(side, v), scalar_product(arm.line, v));
    };
    // What moves with the arm is as much longer as to_arm's square.
    const T per_size = T(1) / len2(to_arm);
    const auto cosine = [&](const Vector<T>& fixed, const auto& moving)
                            SWIVEL_INLINE_LAMBDA { return per_size * inner(fixed, moving); };
    SwivelLimits<T, Boxes> out;
    const auto add = [&](const OnCircle<T>& line, std::uint32_t flag) SWIVEL_INLINE_LAMBDA {
        out.line_flag[out.limits.line_count] = flag;
        out.limits.line[out.limits.line_count++] = line;
    };
    const auto add_box = [&]([[maybe_unused]] const EulerBox<T>& box, [[maybe_unused]] std::uint32_t flag)
                             SWIVEL_INLINE_LAMBDA {
                                 if constexpr (Boxes > 0) {
                                     out.box_flag[out.limits.box_count] = flag;
                                     out.limits.box[out.limits.box_count++] = box;
                                 }
                             };

    // The entries of the matrix whose rows are fixed axes, and whose columns turn with the arm.
    const auto matrix = [&](const Vector<T>& row1, const Vector<T>& row2, const Vector<T>& row3, const auto& turning)
                            SWIVEL_INLINE_LAMBDA {
                                const auto column1 = sandwich(turning, unit<T, kE1>());
                                const auto column2 = sandwich(turning, unit<T, kE2>());
                                const auto column3 = sandwich(turning, unit<T, kE3>());
                                return [=](int row, int column) SWIVEL_INLINE_LAMBDA {
                                    const Vector<T>& fixed = row == 0 ? row1 : row == 1 ? row2 : row3;
                                    if (column == 0) return cosine(fixed, column1);
                                    return column == 1 ? cosine(fixed, column2) : cosine(fixed, column3);
                                };
                            };

    if (use.shoulder_cone)
        add(cone_limit(cosine(in_line(limits.shoulder_cone.axis), sandwich(to_arm, e3)),
                       limits.shoulder_cone.cos_opening),
            SWIVEL_LIMITED_SHOULDER_CONE);
    // Twists come from products of a rotor's components. Near a swing of half a turn all of them are small, and sums of
    // a matrix's entries would leave their rounding errors.
    const Rotor<T> from_line =
        use.humeral_twist || use.forearm_twist || use.hand_twist ? frame_along(arm.line, arm.normal) : Rotor<T>{};
    // s: the rotor's part along the twist's axis, as twist_limit() takes it.
    const auto twist = [&](const Range<T>& range, const Rotor<T>& at_0, const Rotor<T>& at_pi, const OnHalfCircle<T>& s)
                           SWIVEL_INLINE_LAMBDA {
                               const OnHalfCircle<T> w{at_0.template at<kScalar>(), at_pi.template at<kScalar>()};
                               return (per_size / len2(from_line)) * twist_limit(w, s, range);
                           };
    const auto along_e3 = [](const Rotor<T>& at_0, const Rotor<T>& at_pi) SWIVEL_INLINE_LAMBDA {
        return OnHalfCircle<T>{at_0.template at<kK>(), at_pi.template at<kK>()};
    };
    if (use.humeral_twist) {
        const Rotor<T> at_0 = from_line * to_arm, at_pi = from_line * k * to_arm;
        add(twist(limits.humeral_twist, at_0, at_pi, along_e3(at_0, at_pi)), SWIVEL_LIMITED_HUMERAL_TWIST);
    }
    if (use.shoulder_box)
        add_box(euler_box<T>(use.shoulder_order,
                             matrix(in_line(unit<T, kE1>()), in_line(unit<T, kE2>()), in_line(unit<T, kE3>()), to_arm),
                             limits.shoulder_box[0], limits.shoulder_box[1], limits.shoulder_box[2]),
                SWIVEL_LIMITED_SHOULDER_BOX);
    if (!(use.hand_cone || use.forearm_twist || use.hand_twist || use.wrist_box)) return out;

    // The forearm turns with the arm, the hand stays. The wrist's rotor is (arm elbow)^-1 hand.
    const auto forearm = to_arm * arm.elbow;
    if (use.hand_cone)
        add(cone_limit(cosine(in_line(sandwich(arm.hand, limits.hand_cone.axis)), sandwich(forearm, e3)),
                       limits.hand_cone.cos_opening),
            SWIVEL_LIMITED_HAND_CONE);
    if (use.forearm_twist || use.hand_twist) {
        const Rotor<T> hand = ~from_line * arm.hand;
        const Rotor<T> at_0 = ~forearm * hand, at_pi = ~forearm * ~k * hand;
        if (use.forearm_twist)
            add(twist(limits.forearm_twist, at_0, at_pi, along_e3(at_0, at_pi)), SWIVEL_LIMITED_FOREARM_TWIST);
        if (use.hand_twist) {
            const Vector<T>& axis = limits.hand_twist.axis;
            add(twist(limits.hand_twist.range, at_0, at_pi, {about(axis, at_0), about(axis, at_pi)}),
                SWIVEL_LIMITED_HAND_TWIST);
        }
    }
    if (use.wrist_box) {  // its matrix has the forearm's axes in its rows, so what moves belongs to the row
        const Turn<T> hand = turn_by(arm.hand);
        const auto transposed = matrix(in_line(hand.e1), in_line(hand.e2), in_line(hand.e3), forearm);
        add_box(euler_box<T>(
                    use.wrist_order, [&](int row, int column) SWIVEL_INLINE_LAMBDA { return transposed(column, row); },
                    limits.wrist_box[0], limits.wrist_box[1], limits.wrist_box[2]),
                SWIVEL_LIMITED_WRIST_BOX);
    }
    return out;
}

}  // namespace swivel::inline SWIVEL_ISA
