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
#pragma once

#include "core/aim.h"
#include "core/choose_swivel.h"
#include "core/frame_rotor.h"
#include "core/limb_bones.h"
#include "core/wish.h"

namespace swivel::inline SWIVEL_ISA {

template <class T>
struct SolvedLimb {
    ArmPose<T> arm;
    Rotor<T> wrist;
    Vector<T> normal;  // of the swivel plane, unit
    T stretch;         // of the bones
    Mask<T> settled;   // false where a search is put off: then the rest means nothing
    Search next;       // that search
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
    const auto& [shoulder, elbow, hand] = goal.incoming;
    if (use.hand && use.weights)
        wrist.hand = blended(normalise(shoulder * elbow * hand), wrist.hand, goal.weights.hand);
    if (use.effector && !use.aim) wrist.place = wrist.place - sandwich(wrist.hand, goal.effector);
    if (use.weights) {
        // Each rotor also scales a bone by the square of its length.
        const auto e3 = unit<T, kE3>();
        const T shoulder2 = len2(shoulder), elbow2 = len2(elbow);
        const Vector<T> was = (T(1) / (shoulder2 * elbow2)) * ((goal.arm.upper * elbow2) * sandwich(shoulder, e3) +
                                                               goal.arm.fore * sandwich(shoulder * elbow, e3));
        const T weight = goal.weights.position;
        wrist.place = (T(1) - weight) * was + weight * wrist.place;  // exactly one of them at 0 and at 1
    }
    return wrist;
}

// Which limits the wish breaks.
template <class T, int Boxes>
SWIVEL_INLINE constexpr Bits<T> broken(const SwivelLimits<T, Boxes>& limits)
{
    const Turned<T> wish{T(1), T(0)};
    Bits<T> flags = bits<T>(0);
    for (int n = 0; n < limits.limits.line_count; ++n)
        flags = flags | bits_where(limits.limits.line[n].at(wish) < T(kNoRoom), limits.line_flag[n]);
    for (int n = 0; n < limits.limits.box_count; ++n)
        flags = flags | bits_where(room(limits.limits.box[n], wish) < T(kNoRoom), limits.box_flag[n]);
    return flags;
}

// A limb whose goal is known and whose swivel is still free. phi = 0 is the wish, limited by the most that the swivel
// may turn in a frame.
template <class T, class Lift>
struct PlacedLimb {
    SwivellingArm<T, Lift> arm;
    Vector<T> line, normal;  // unit: to the wrist, and of the swivel plane at phi = 0
    SteppedNormal<T> step;   // only with continuity
    PlacedBones<T, Lift> bones;
    Bits<T> flags;
};

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
template <bool Aims, class T>
SWIVEL_INLINE constexpr auto place_limb(const LimbUse& use, const LimbGoal<T>& goal)
{
    const WristGoal<T> wrist = wrist_goal(use, goal);
    const T wrist2 = len2(wrist.place);
    const Mask<T> on_shoulder = wrist2 < T(kTiny2);
    const T distance = sqrt(select(on_shoulder, T(1), wrist2));

    const auto bones = bones_for<Aims>(use, goal, wrist.hand, select(on_shoulder, T(0), distance));
    PlacedLimb<T, decltype(bones.lift)> limb;
    limb.bones = bones;
    limb.line = select(on_shoulder, vector(T(0), T(0), T(1)), (T(1) / distance) * wrist.place);

    const WishedNormal<T> wish = wished_normal(use, goal, limb.line);
    limb.normal = wish.normal;
    limb.flags = limb.bones.flags | bits_where(wish.undefined | on_shoulder, SWIVEL_SWIVEL_UNDEFINED);
    if (use.continuity) {
        limb.step = stepped_normal(goal.continuity, limb.normal, limb.line);
        limb.normal = limb.step.normal;
        limb.flags = limb.flags | bits_where(limb.step.limited, SWIVEL_LIMITED_STEP);
    }
    // Once more: of a wish close to the line, rounding has left some of the line. What this shortens is less than
    // rounding.
    limb.normal = across(limb.normal, limb.line);

    const Hinge<T> elbow = hinge(limb.bones.cos_half, -limb.bones.sin_half);
    limb.arm = {limb.line, limb.normal, limb.bones.lift, elbow, wrist.hand};
    return limb;
}

// good: false where the caller already knows that the input is bad. Policy: see choose_swivel.h. A limb that is not
// settled gives back the previous normal.
template <bool Aims, class Policy = SearchNow, int Boxes = kMostBoxes, class T>
SWIVEL_INLINE constexpr SolvedLimb<T> solve_limb(const LimbUse& use, const LimbGoal<T>& goal, const Mask<T>& good)
{
    const Mask<T> valid = good & is_valid(use, goal);
    const auto limb = place_limb<Aims>(use, goal);
    Vector<T> normal = limb.normal;
    Bits<T> flags = limb.flags;
    SolvedLimb<T> pose;
    pose.settled = T(0) == T(0);
    pose.next = Search::nearest_end;
    if (use.limits.on_swivel()) {
        const SwivelLimits<T, Boxes> limits = swivel_limits<Boxes>(use.limits, goal.limits, limb.arm);
        const ChosenSwivel<T> chosen = choose_swivel<Policy>(limits.limits, valid);
        pose.settled = chosen.settled;
        pose.next = chosen.next;
        flags = flags | broken(limits) | bits_where(!chosen.allowed, SWIVEL_INFEASIBLE);
        normal = chosen.swivel.cos * normal + chosen.swivel.sin * cross(limb.line, normal);
        if (use.continuity) {
            const Mask<T> beyond = is_beyond(limb.step.previous, normal, limb.line, goal.continuity.most, 1e-6);
            flags = flags | bits_where(limb.step.has_previous & beyond, SWIVEL_JUMPED);
        }
    }
    // Steps 3 to 5: the frame along the line, its e1 the swivel plane's normal.
    const Rotor<T> shoulder = normalise(frame_along(limb.line, normal) * limb.arm.to_arm);

    pose.arm = {select(valid, shoulder, one<T>()), select(valid, limb.bones.cos_half, T(1)),
                select(valid, limb.bones.sin_half, T(0)), select(valid, flags, bits<T>(SWIVEL_BAD_INPUT)), valid};
    pose.stretch = select(valid, limb.bones.stretch, T(1));
    if (use.continuity) {
        pose.normal = select(valid, normalise(normal), vector(T(0), T(0), T(0)));
        pose.normal = select(pose.settled, pose.normal, goal.continuity.previous_normal);
    }
    if (use.hand) {
        const Rotor<T> wrist = Aims ? limb.arm.hand : ~(shoulder * limb.arm.elbow) * limb.arm.hand;
        pose.wrist = select(valid, wrist, one<T>());
    }
    return pose;
}

}  // namespace swivel::inline SWIVEL_ISA
