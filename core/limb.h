// SPDX-License-Identifier: MIT
//
// The whole limb: everything that a goal may ask of an arm beyond its wrist, its pole and its bones. Each part is
// computed only if the group uses it. The order is the lecture's, with one step more. From the goal comes a wrist
// target, and then how far it reaches. Next are the swivel plane that is wished for, the frame along the target's line,
// and the triangle that lifts the upper arm out of it. The last step is the swivel that the joint limits allow.
// Everything is in the arm frame.
//
// Degenerate input is replaced here, lane by lane. Bad numbers become the arm at rest. A target on the shoulder becomes
// the direction e3. A wish that does not say where the elbow goes becomes the first normal that does: the previous one,
// the incoming pose's, the rest hinge e1, or e2. Source of the steps: D. Hildenbrand, Inverse Kinematics of a Virtual
// Character (TU Darmstadt, 2019).
//
// Kernels run these parts as stages (simd/stages.h). Here they are one call, for the lecture and for tests, which
// compare the two.
#pragma once

#include "core/aim.h"
#include "core/choose_swivel.h"
#include "core/limb_bones.h"
#include "core/region.h"
#include "core/wish.h"
#include "core/wrist_goal.h"
#include "core/yielding_hand.h"

namespace swivel::inline SWIVEL_ISA {

template <class T>
struct SolvedLimb {
    ArmPose<T> arm;
    Rotor<T> wrist;
    Vector<T> normal;  // of the swivel plane, unit
    T stretch;         // of the bones
};

// Which limits the wish breaks.
template <class T>
SWIVEL_INLINE constexpr Word<T> broken(const SwivelLimits<T>& limits)
{
    const Turned<T> wish{T(1), T(0)};
    Word<T> flags = word<T>(0);
    for (int n = 0; n < limits.limits.line_count; ++n)
        flags = flags | word_where(limits.limits.line[n].at(wish) < T(kNoRoom), limits.line_flag[n]);
    for (int n = 0; n < limits.limits.box_count; ++n)
        flags = flags | word_where(room(limits.limits.box[n], wish) < T(kNoRoom), limits.box_flag[n]);
    return flags;
}

// The swivel that the limits of a group allow; and with a region, those and it. flags: of what the wish breaks.
template <class T, class Lift>
SWIVEL_INLINE constexpr FoundSwivel<T> chosen_swivel(const LimbUse& use, const JointLimits<T>& given,
                                                     const SwivellingArm<T, Lift>& arm, const Mask<T>& valid,
                                                     Word<T>& flags)
{
    const SwivelLimits<T> limits = swivel_limits(use.limits, given, arm);
    flags = flags | broken(limits);
    if (!use.limits.region) return choose_swivel(limits.limits, valid);
    const RegionOnCircle<T> region = region_limit(arm, use.limits.region);
    const Turned<T> wish{T(1), T(0)};
    flags = flags | word_where(room(region, wish) < T(kNoRoom), SWIVEL_LIMITED_REGION);
    return choose_swivel(LimitsInRegion<T, kMostBoxes>{limits.limits, region}, valid);
}

// Aims: what use.aim says, as a constant. wanted: the distance from shoulder to target.
template <bool Aims, class T>
SWIVEL_INLINE constexpr auto bones_for(const LimbUse& use, const LimbGoal<T>& goal, const Rotor<T>& hand,
                                       const T& wanted)
{
    if constexpr (Aims)
        return aimed_bones(use, goal, hand, wanted);
    else
        return place_bones(use, goal, wanted);
}

// good: false where the caller already knows that the input is bad.
template <bool Aims, class T>
SWIVEL_INLINE constexpr SolvedLimb<T> solve_limb(const LimbUse& use, const LimbGoal<T>& goal, const Mask<T>& good)
{
    const Mask<T> valid = good & is_valid(use, goal);
    WristGoal<T> wrist = wrist_goal(use, goal);
    const WristLine<T> to = wrist_line(wrist.place);
    const auto bones = bones_for<Aims>(use, goal, wrist.hand, to.wanted);
    const LimbNormal<T> wish = limb_normal(use, goal, wrist.hand, to.line);
    if (use.yields) {
        const T upper = bones.stretch * goal.arm.upper, fore = bones.stretch * goal.arm.fore;
        const Vector<T> achieved = bent_reach(upper, fore, bones.cos_half) * to.line;
        wrist.hand = yielding_hand(wrist.hand, goal.effector, wrist.place - achieved, upper + fore);
    }
    const Hinge<T> elbow = hinge(bones.cos_half, -bones.sin_half);
    Vector<T> normal = wish.normal;
    Word<T> flags = bones.flags | wish.flags | word_where(to.on_shoulder, SWIVEL_SWIVEL_UNDEFINED);
    if (use.limits.on_swivel()) {
        const SwivellingArm<T, decltype(bones.lift)> arm{to.line, normal, bones.lift, elbow, wrist.hand};
        const FoundSwivel<T> chosen = chosen_swivel(use, goal.limits, arm, valid, flags);
        flags = flags | word_where(!chosen.allowed, SWIVEL_INFEASIBLE);
        normal = swivelled(normal, to.line, chosen.swivel);
        if (use.continuity && !use.step_wins)
            flags = flags | word_where(jumps(goal.continuity, normal, to.line), SWIVEL_JUMPED);
    }
    if (use.step_wins) normal = last_step(goal.continuity, normal, to.line, flags);
    const Rotor<T> shoulder = lifted(to.line, normal, bones.lift);

    SolvedLimb<T> pose;
    pose.arm = {select(valid, shoulder, one<T>()), select(valid, bones.cos_half, T(1)),
                select(valid, bones.sin_half, T(0)), select(valid, flags, word<T>(SWIVEL_BAD_INPUT)), valid};
    pose.stretch = select(valid, bones.stretch, T(1));
    if (use.continuity) pose.normal = select(valid, normalise(normal), vector(T(0), T(0), T(0)));
    if (use.hand) pose.wrist = select(valid, Aims ? wrist.hand : ~(shoulder * elbow) * wrist.hand, one<T>());
    return pose;
}

}  // namespace swivel::inline SWIVEL_ISA
