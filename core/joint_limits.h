// SPDX-License-Identifier: MIT
//
// An arm's joint limits, written as limits of its swivel (limits.h). All of them are measured from the rest pose. Axes
// are those of the arm frame at rest. Twists and Euler angles are those of what the joint adds to rest. The elbow's
// flexion does not depend on the swivel: its limit is a range of reach (limb_bones.h).
#pragma once

#include "core/arm.h"
#include "core/limits.h"

namespace swivel::inline SWIVEL_ISA {

// Which limits a crowd has, and the axes' orders in its boxes; the same for all arms of a group.
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

// The arm that swivels: shoulder rotor = from_line * (cos(phi/2) + sin(phi/2) k) * to_arm, the two of any length.
template <class T, class Lift>
struct SwivellingArm {
    Rotor<T> from_line;  // carries the line's frame to the arm frame
    Lift to_arm;         // the arm's pose in the line's frame at phi = 0
    Hinge<T> elbow;
    Rotor<T> hand;  // orientation, in the arm frame
};

// The limits, and the flag of each in the order of Limits: lines, then boxes.
template <class T>
struct SwivelLimits {
    Limits<T> limits;
    std::uint32_t line_flag[kMostLines] = {}, box_flag[kMostBoxes] = {};
};

// The component of a rotor that turns about the axis: the dot product of the axis and the rotor's vector part.
template <class T>
SWIVEL_INLINE constexpr T about(const Vector<T>& axis, const Rotor<T>& q)
{
    return axis.template at<kE1>() * q.template at<kI>() + axis.template at<kE2>() * q.template at<kJ>() +
           axis.template at<kE3>() * q.template at<kK>();
}

template <class T, class Lift>
SWIVEL_INLINE constexpr SwivelLimits<T> swivel_limits(const LimitUse& use, const JointLimits<T>& limits,
                                                      const SwivellingArm<T, Lift>& arm)
{
    constexpr BladeSet rotors = Rotor<T>::set;
    const auto e3 = unit<T, kE3>();
    const auto k = unit<T, kK>();
    const Rotor<T>& from_line = arm.from_line;
    const Lift& to_arm = arm.to_arm;
    // Each of the rotors also scales a vector by the square of its length, and appears twice in a twist's products.
    const T per_size = T(1) / (len2(from_line) * len2(to_arm));
    const auto cosine = [&](const Vector<T>& fixed, const auto& moving)
                            SWIVEL_INLINE_LAMBDA { return per_size * inner(fixed, widen<Vector<T>::set>(moving)); };
    SwivelLimits<T> out;
    const auto add = [&](const OnCircle<T>& line, std::uint32_t flag) SWIVEL_INLINE_LAMBDA {
        out.line_flag[out.limits.line_count] = flag;
        out.limits.line[out.limits.line_count++] = line;
    };
    const auto add_box = [&](const EulerBox<T>& box, std::uint32_t flag) SWIVEL_INLINE_LAMBDA {
        out.box_flag[out.limits.box_count] = flag;
        out.limits.box[out.limits.box_count++] = box;
    };

    if (use.shoulder_cone)
        add(cone_limit(cosine(sandwich(~from_line, limits.shoulder_cone.axis), sandwich(to_arm, e3)),
                       limits.shoulder_cone.cos_opening),
            flag::limited_shoulder_cone);
    if (use.humeral_twist) {
        const Rotor<T> at_0 = from_line * to_arm, at_pi = from_line * k * to_arm;
        add(per_size * twist_limit(OnHalfCircle<T>{at_0.template at<kScalar>(), at_pi.template at<kScalar>()},
                                   OnHalfCircle<T>{at_0.template at<kK>(), at_pi.template at<kK>()},
                                   limits.humeral_twist),
            flag::limited_humeral_twist);
    }
    const auto matrix_entry = [&](const Turn<T>& fixed, const Turn<T>& moving) SWIVEL_INLINE_LAMBDA {
        return [=, &cosine](int row, int column) SWIVEL_INLINE_LAMBDA {
            const auto axis = [](const Turn<T>& turn, int n) SWIVEL_INLINE_LAMBDA {
                return n == 0 ? turn.e1 : n == 1 ? turn.e2 : turn.e3;
            };
            return cosine(axis(fixed, row), axis(moving, column));
        };
    };
    if (use.shoulder_box)
        add_box(euler_box<T>(use.shoulder_order, matrix_entry(turn_by(~from_line), turn_by(widen<rotors>(to_arm))),
                             limits.shoulder_box[0], limits.shoulder_box[1], limits.shoulder_box[2]),
                flag::limited_shoulder_box);
    if (!(use.hand_cone || use.forearm_twist || use.hand_twist || use.wrist_box)) return out;

    // The forearm turns with the arm, the hand stays. The wrist's rotor is (arm elbow)^-1 hand.
    const auto forearm = to_arm * arm.elbow;
    const Rotor<T> hand = ~from_line * arm.hand;
    if (use.hand_cone)
        add(cone_limit(cosine(sandwich(hand, limits.hand_cone.axis), sandwich(forearm, e3)),
                       limits.hand_cone.cos_opening),
            flag::limited_hand_cone);
    if (use.forearm_twist || use.hand_twist) {
        const Rotor<T> at_0 = ~forearm * hand, at_pi = ~forearm * ~k * hand;
        const OnHalfCircle<T> w{at_0.template at<kScalar>(), at_pi.template at<kScalar>()};
        if (use.forearm_twist)
            add(per_size * twist_limit(w, OnHalfCircle<T>{at_0.template at<kK>(), at_pi.template at<kK>()},
                                       limits.forearm_twist),
                flag::limited_forearm_twist);
        if (use.hand_twist)
            add(per_size *
                    twist_limit(
                        w, OnHalfCircle<T>{about(limits.hand_twist.axis, at_0), about(limits.hand_twist.axis, at_pi)},
                        limits.hand_twist.range),
                flag::limited_hand_twist);
    }
    // Its matrix has the forearm's axes in its rows, so the moving vector belongs to the row.
    if (use.wrist_box) {
        const auto transposed = matrix_entry(turn_by(hand), turn_by(widen<rotors>(forearm)));
        add_box(euler_box<T>(
                    use.wrist_order, [&](int row, int column) SWIVEL_INLINE_LAMBDA { return transposed(column, row); },
                    limits.wrist_box[0], limits.wrist_box[1], limits.wrist_box[2]),
                flag::limited_wrist_box);
    }
    return out;
}

}  // namespace swivel::inline SWIVEL_ISA
