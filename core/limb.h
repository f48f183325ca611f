// SPDX-License-Identifier: MIT
//
// The whole limb: everything that may be asked of an arm beside its wrist, its pole and its bones, each part only where
// the crowd uses it. The order is the lecture's, with one step more: from the goal to a wrist target, how far it
// reaches, the swivel plane that is wished for, the frame along the target's line and the triangle that lifts the upper
// arm out of it, and last the swivel that the joint limits allow. All in the arm frame.
//
// Degenerate input is answered here, lane by lane: bad numbers by the arm at rest, a target on the shoulder by the
// direction e3, a wish that does not say where the elbow goes by the first of the previous normal, the incoming pose's,
// the rest hinge e1 and e2 that does. Source of the steps: D. Hildenbrand, Inverse Kinematics of a Virtual Character
// (TU Darmstadt, 2019).
#pragma once

#include "core/choose_swivel.h"
#include "core/frame_rotor.h"
#include "core/reach.h"
#include "core/soft_reach.h"
#include "core/wish.h"

namespace swivel::inline SWIVEL_ISA {

template <class T>
struct LimbPose {
    ArmPose<T> arm;
    Rotor<T> wrist;
    Vector<T> normal;  // of the swivel plane, unit
    T stretch;         // of the bones
};

template <class T>
SWIVEL_INLINE constexpr Rotor<T> one()
{
    return rotor(T(0), T(0), T(0), T(1));
}
// From a to b by weight, along the shorter way.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> blended(const Rotor<T>& a, const Rotor<T>& b, const T& weight)
{
    const T side = scalar_product(~a, b);
    const Rotor<T> near = for_each_blade<T, Rotor<T>::set>(
        [&]<Blade B>() SWIVEL_INLINE_LAMBDA { return flip_sign(b.template at<B>(), side); });
    return normalise(a + weight * (near - a));
}

// The hand's orientation and the wrist's place that the goal asks for.
template <class T>
struct WristGoal {
    Rotor<T> hand;
    Vector<T> place;
};
template <class T>
SWIVEL_INLINE constexpr WristGoal<T> wrist_goal(const LimbUse& use, const LimbGoal<T>& goal)
{
    WristGoal<T> wrist{one<T>(), goal.arm.wrist};
    if (use.hand) wrist.hand = normalise(goal.hand);
    const Rotor<T> fore = goal.incoming.shoulder * goal.incoming.elbow;  // meaningless without an incoming pose
    if (use.hand && use.weights) wrist.hand = blended(fore * goal.incoming.wrist, wrist.hand, goal.weights.hand);
    if (use.effector) wrist.place = wrist.place - sandwich(wrist.hand, goal.effector);
    if (use.weights) {
        const Vector<T> was = sandwich(goal.incoming.shoulder, vector(T(0), T(0), goal.arm.upper)) +
                              sandwich(fore, vector(T(0), T(0), goal.arm.fore));
        wrist.place = was + goal.weights.position * (wrist.place - was);
    }
    return wrist;
}

// Which limits the wish breaks.
template <class T>
SWIVEL_INLINE constexpr Bits<T> broken(const SwivelLimits<T>& limits)
{
    const Turned<T> wish{T(1), T(0)};
    Bits<T> flags = bits<T>(0);
    for (int n = 0; n < limits.limits.line_count; ++n)
        flags = flags | bits_where(limits.limits.line[n].at(wish) < T(kNoRoom), limits.line_flag[n]);
    for (int n = 0; n < limits.limits.box_count; ++n)
        flags = flags | bits_where(room(limits.limits.box[n], wish) < T(kNoRoom), limits.box_flag[n]);
    return flags;
}

template <class T>
SWIVEL_INLINE constexpr LimbPose<T> solve_limb(const LimbUse& use, const LimbGoal<T>& goal)
{
    const Mask<T> valid = is_valid(use, goal);
    const WristGoal<T> wrist = wrist_goal(use, goal);

    // The target's line, and sizes of about 1.
    const T wrist2 = len2(wrist.place);
    const Mask<T> on_shoulder = wrist2 < T(kTiny2);
    const Vector<T> line = unit_or(wrist.place, vector(T(0), T(0), T(1)));
    const T upper = goal.arm.upper, fore = goal.arm.fore, sum = upper + fore;
    const T shrink = per_power_of_two(select(sum > T(0), sum, T(1)));
    const Mask<T> one_bone = !(lo(upper, fore) > T(kSwallowed) * sum);
    const T long_upper = upper * shrink, long_fore = fore * shrink, far = long_upper + long_fore,
            near = abs(long_upper - long_fore);
    const T wanted = select(on_shoulder, T(0), sqrt(select(on_shoulder, T(1), wrist2))) * shrink;

    // How far it reaches.
    ReachRange<T> range{near, far, T(0), T(0), T(1)};
    Bits<T> flags = bits<T>(0);
    if (use.limits.flexion) {
        const T product4 = T(4) * (long_upper * long_fore), near2 = near * near;
        const auto at_flexion = [&](const T& cos_half) SWIVEL_INLINE_LAMBDA {
            return lo(hi(sqrt(near2 + product4 * (cos_half * cos_half)), near), far);
        };
        const T& least = goal.limits.flexion.cos;
        const T& most = goal.limits.flexion.sin;
        range.far = select(least < T(1), at_flexion(least), far);
        range.near = select(most > T(0), at_flexion(most), near);
        flags = flags |
                bits_where(((wanted > range.far) & (range.far < far)) | ((wanted < range.near) & (range.near > near)),
                           flag::limited_flexion);
    }
    if (use.reach) {
        range.near = lo(hi(goal.reach.least_distance * far, range.near), range.far);
        range.soft_far = goal.reach.soft_far * far;
        range.soft_near = goal.reach.soft_near * far;
        range.most_stretch = goal.reach.most_stretch;
    }
    const SoftReach<T> reach = soft_reach(wanted, range);
    flags = flags | bits_where(reach.too_far, flag::clamped_far) | bits_where(reach.too_near, flag::clamped_near) |
            bits_where(reach.softened, flag::softened) | bits_where(reach.stretch > T(1), flag::stretched) |
            bits_where(!(reach.too_far | reach.too_near | reach.softened), flag::reached);

    // Steps 1 and 2: the triangle of the bones, as a turn about e1 that lifts the upper arm off the line. A bone that
    // the other swallows is straight with it.
    const T half_upper = select(one_bone, T(0.5), long_upper), half_fore = select(one_bone, T(0.5), long_fore);
    const T both = half_upper + half_fore, difference = half_upper - half_fore;
    const T distance = select(one_bone, both, lo(hi(hi(reach.distance, T(kNearest)), abs(difference)), both));
    const ArmTriangle<T> triangle = arm_triangle(distance, both, difference);
    const T per_lift = T(1) / sqrt(triangle.lift2);
    const Mask<T> larger_first = triangle.cos_lift >= T(0);
    const Rotor<T> lift = rotor(per_lift * select(larger_first, triangle.smaller, triangle.larger), T(0), T(0),
                                per_lift * select(larger_first, triangle.larger, triangle.smaller));
    const Rotor<T> elbow = rotor(-triangle.sin_half, T(0), T(0), triangle.cos_half);

    // Steps 3 to 5: the frame along the line, its e1 the swivel plane's normal.
    const WishedNormal<T> wish = wished_normal(use, goal, line);
    Vector<T> normal = wish.normal;
    SteppedNormal<T> step{};
    if (use.continuity) {
        step = stepped_normal(goal.continuity, normal, line);
        normal = step.normal;
        flags = flags | bits_where(step.limited, flag::limited_step);
    }
    const Rotor<T> frame = frame_rotor(line, normal);
    flags = flags | bits_where(wish.undefined | on_shoulder, flag::swivel_undefined);

    // The swivel that the joint limits allow.
    Rotor<T> shoulder = frame * lift;
    if (use.limits.on_swivel()) {
        const SwivelLimits<T> limits =
            swivel_limits(use.limits, goal.limits, SwivellingArm<T>{frame, lift, elbow, wrist.hand});
        const ChosenSwivel<T> chosen = choose_swivel(limits.limits);
        flags = flags | broken(limits) | bits_where(!chosen.allowed, flag::infeasible);
        shoulder = frame * half_turn(chosen.swivel) * lift;
        normal = chosen.swivel.cos * normal + chosen.swivel.sin * cross(line, normal);
        if (use.continuity)
            flags = flags | bits_where(step.has_previous &
                                           (scalar_product(step.previous, normal) < goal.continuity.most.cos - T(1e-6)),
                                       flag::jumped);
    }
    shoulder = normalise(shoulder);

    LimbPose<T> pose;
    pose.arm.shoulder = select(valid, shoulder, one<T>());
    pose.arm.cos_half = select(valid, triangle.cos_half, T(1));
    pose.arm.sin_half = select(valid, triangle.sin_half, T(0));
    pose.arm.flags = select(valid, flags, bits<T>(flag::bad_input));
    pose.arm.valid = valid;
    pose.stretch = select(valid, reach.stretch, T(1));
    pose.normal = select(valid, normalise(normal), vector(T(0), T(0), T(0)));
    if (use.hand) pose.wrist = select(valid, normalise(~(shoulder * elbow) * wrist.hand), one<T>());
    return pose;
}

}  // namespace swivel::inline SWIVEL_ISA
