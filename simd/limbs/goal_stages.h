// SPDX-License-Identifier: MIT
//
// The first stages of the whole limb: they bring the goal and the incoming pose into the arm frame.
#pragma once

#include "core/clavicle.h"
#include "core/wrist_goal.h"
#include "simd/limbs/strip.h"

namespace swivel::inline SWIVEL_ISA {

// Each stage has a function advance(AtStage<stage>(), s), which takes a slice one stage further.
template <Stage stage>
struct AtStage {
};

// Whether the caller gives a pole; and whether it is a point.
template <class S>
SWIVEL_INLINE bool has_pole(const S& s)
{
    return !s.has(SWIVEL_POLE_INCOMING) && !s.has(SWIVEL_POLE_HAND);
}
template <class S>
SWIVEL_INLINE bool pole_is_point(const S& s)
{
    return has_pole(s) && !s.has(SWIVEL_POLE_DIRECTION) && !s.has(SWIVEL_POLE_NORMAL);
}
// Whether its joints have frames of their own.
template <class S>
SWIVEL_INLINE bool is_bound(const S& s)
{
    return s.has(SWIVEL_JOINTS) || s.has(kBody);
}
// The parent's frame of a body's limb.
template <class S>
SWIVEL_INLINE ParentFrame<typename S::T> posed_parent(const S& s)
{
    const BodyLimb& limb = s.strip.run.plan->limb;
    return {s.body.vector(limb.shoulder + kPlaceRow), s.body.rotor(limb.parent + kTurnRow),
            s.body.get(limb.parent + kScaleRow)};
}
// The arm frame of a body's limb, with the clavicle as turned, from the root's place.
template <class T>
struct ArmFrame {
    Rotor<T> rotation;
    Vector<T> shoulder;
};
template <class S>
SWIVEL_INLINE ArmFrame<typename S::T> arm_frame(const S& s)
{
    using T = typename S::T;
    const ParentFrame<T> parent = posed_parent(s);
    const Rotor<T> arm = parent.rotation * broadcast<T>(s.strip.bind.parent_from_arm);
    if (!s.has(SWIVEL_WITH_CLAVICLE)) return {arm, parent.position};
    const Vector<T> clavicle = s.body.vector(s.strip.run.plan->limb.parent + kPlaceRow);
    const Rotor<T> turned_arm = arm * s.rows.rotor(kClavicleRow);
    return {turned_arm, clavicle + sandwich(turned_arm * ~arm, parent.position - clavicle)};
}
// Whether the pose is good in all that a limb takes from it. A bad joint shows in all below it.
template <class S>
SWIVEL_INLINE Mask<typename S::T> is_posed(const S& s)
{
    using T = typename S::T;
    const BodyLimb& limb = s.strip.run.plan->limb;
    const auto is_joint = [&](std::uint32_t joint) SWIVEL_INLINE_LAMBDA {
        return is_almost_unit(s.body.rotor(joint + kTurnRow)) & (len2(s.body.vector(joint + kPlaceRow)) <= T(kHuge2)) &
               is_within(s.body.get(joint + kScaleRow), kTiny, kHuge);
    };
    Mask<T> good = is_joint(limb.wrist);
    for (std::uint32_t n = 0; n < twist_bone_count(s.strip.run.features); ++n)
        good = good & is_joint(limb.twist_bones[n].row);
    return good;
}

// A bone's length.
template <class S>
SWIVEL_INLINE typename S::T length(const S& s, int bone)
{
    return s.has(kBody) ? s.body.get(kLengthsRow + static_cast<std::uint32_t>(bone)) : s.io.load(SWIVEL_LENGTHS, bone);
}
// A vector of the hand joint's own frame.
template <class S>
SWIVEL_INLINE Vector<typename S::T> in_hand(const S& s, const Vector<typename S::T>& v)
{
    return is_bound(s) ? sandwich(broadcast<typename S::T>(s.strip.bind.hand_from_arm), v) : v;
}

template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::goal_to_parent>, const S& s)
{
    using T = typename S::T;
    const Vector<T> target = s.io.load_vector(SWIVEL_TARGET);
    const Vector<T> pole = has_pole(s) ? s.io.load_vector(SWIVEL_POLE) : vector(T(0), T(0), T(0));
    const ParentFrame<T> parent = s.io.load_parent();
    s.require(is_valid(parent) & (len2(target) <= T(kHuge2)) & (len2(pole) <= T(kHuge2)));
    // The arm frame goes with the parent.
    Rotor<T> rotation = parent.rotation;
    if constexpr (S::template is<SWIVEL_JOINTS>()) rotation = rotation * broadcast<T>(s.strip.bind.parent_from_arm);
    const SeenGoal<T> seen =
        seen_by(ParentFrame<T>{parent.position, rotation, parent.scale}, target, pole, T(pole_is_point(s)));
    const T shrink = T(1) / seen.size;
    s.rows.set(kTargetRow, shrink * seen.wrist);
    s.rows.set(kPoleRow, shrink * seen.pole);
    if constexpr (S::template is<SWIVEL_WITH_HAND>()) {
        const Rotor<T> hand = s.io.load_rotor(SWIVEL_HAND);
        s.require(is_orientation(hand));
        s.rows.set(kTargetHandRow, s.has(SWIVEL_WITH_AIM) ? hand : ~rotation * hand);
    }
}

// Places from the clavicle's joint, in the arm frame: the shoulder's, and what the clavicle turns from towards the
// target.
template <class T>
struct ClavicleEnds {
    Vector<T> shoulder, from;
};
// A free limb: the clavicle's own bone.
template <class S>
SWIVEL_INLINE ClavicleEnds<typename S::T> resting_clavicle(const S& s)
{
    using T = typename S::T;
    const Vector<T> bone = sandwich(~broadcast<T>(s.strip.bind.parent_from_arm), s.io.load_vector(SWIVEL_CLAVICLE));
    return {bone, bone};
}
// A body's limb: what goes to the target, as it comes. With an aim that is the ray's point as far as the target is.
template <class S>
SWIVEL_INLINE ClavicleEnds<typename S::T> posed_clavicle(const S& s)
{
    using T = typename S::T;
    const BodyLimb& limb = s.strip.run.plan->limb;
    const ParentFrame<T> parent = posed_parent(s);
    const Turn<T> back = turn_by(~(parent.rotation * broadcast<T>(s.strip.bind.parent_from_arm)));
    const Vector<T> clavicle = s.body.vector(limb.parent + kPlaceRow);
    const auto seen = [&](const Vector<T>& place)
                          SWIVEL_INLINE_LAMBDA { return (T(1) / parent.scale) * back(place - clavicle); };
    const Turn<T> hand = turn_by(s.body.rotor(limb.wrist + kTurnRow));
    const Vector<T> shoulder = seen(parent.position);
    Vector<T> from = seen(s.body.vector(limb.wrist + kPlaceRow));
    if (s.has(SWIVEL_WITH_EFFECTOR)) from = from + back(hand(s.io.load_vector(SWIVEL_EFFECTOR)));
    if (s.has(SWIVEL_WITH_AIM)) {
        const Vector<T> way = s.rows.vector(kTargetRow) + shoulder - from;
        from = from + sqrt(len2(way)) * back(hand(s.io.load_vector(SWIVEL_AIM)));
    }
    return {shoulder, from};
}

// Turns the clavicle by its share, and the goal back into the arm frame, which goes with it.
template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::clavicle>, const S& s)
{
    using T = typename S::T;
    const bool is_posed = s.has(kBody);
    const ClavicleEnds<T> ends = is_posed ? posed_clavicle(s) : resting_clavicle(s);
    const Vector<T>& bone = ends.shoulder;
    const T share = s.io.load(SWIVEL_CLAVICLE, is_posed ? 0 : 3);
    const Vector<T> target = s.rows.vector(kTargetRow) + bone;
    s.require((len2(bone) <= T(kHuge2)) & is_share(share));
    const Rotor<T> turn =
        clavicle_rotation(ends.from, target, s.has(SWIVEL_WITH_WEIGHTS) ? share * s.io.load(SWIVEL_WEIGHTS, 0) : share);
    const Turn<T> back = turn_by(~turn);
    s.rows.set(kTargetRow, back(target) - bone);
    if (has_pole(s)) {
        const Vector<T> pole = s.rows.vector(kPoleRow);
        s.rows.set(kPoleRow, pole_is_point(s) ? back(pole + bone) - bone : back(pole));
    }
    if (s.has(SWIVEL_WITH_HAND) && !s.has(SWIVEL_WITH_AIM))
        s.rows.set(kTargetHandRow, ~turn * s.rows.rotor(kTargetHandRow));
    s.rows.set(kClavicleRow, turn);
}

template <class S>
SWIVEL_INLINE void load_incoming(const S& s, swivel_field field, std::uint32_t row, const Rotor<float>& from,
                                 const Rotor<float>& to)
{
    using T = typename S::T;
    const Rotor<T> local = s.io.load_rotor(field);
    Rotor<T> of_arm = local;
    if constexpr (S::template is<SWIVEL_JOINTS>()) of_arm = ~broadcast<T>(from) * local * broadcast<T>(to);
    of_arm = scaled(of_arm);
    s.require(is_orientation(local) & is_orientation(of_arm));
    s.rows.set(row, of_arm);
}

template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::incoming>, const S& s)
{
    const Binding& bind = s.strip.bind;
    load_incoming(s, SWIVEL_INCOMING_SHOULDER, kIncomingRow, bind.parent_from_arm, bind.upper_from_arm);
    load_incoming(s, SWIVEL_INCOMING_ELBOW, kIncomingRow + 4, bind.elbow_parent_from_arm, bind.fore_from_arm);
    if (s.has(SWIVEL_WITH_HAND))
        load_incoming(s, SWIVEL_INCOMING_WRIST, kIncomingRow + 8, bind.wrist_parent_from_arm, ~bind.hand_from_arm);
}

template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::goal>, const S& s)
{
    using T = typename S::T;
    const Binding& bind = s.strip.bind;
    const bool has_hand = s.has(SWIVEL_WITH_HAND), aims = s.has(SWIVEL_WITH_AIM);
    const bool seen = s.has(SWIVEL_WORLD);
    LimbGoal<T> goal;
    goal.arm.wrist = s.goal_vector(seen, kTargetRow, SWIVEL_TARGET);
    Mask<T> valid = len2(goal.arm.wrist) <= T(kHuge2);
    if (has_hand) {
        goal.hand = seen ? s.rows.rotor(kTargetHandRow) : s.io.load_rotor(SWIVEL_HAND);
        if (!seen) valid = valid & is_orientation(goal.hand);
        if (is_bound(s)) {
            const Rotor<T> wrist_parent = s.has(kBody) ? s.body.rotor(s.strip.run.plan->limb.wrist_parent_row())
                                                       : broadcast<T>(bind.wrist_parent_from_arm);
            goal.hand = (aims ? ~wrist_parent * goal.hand : goal.hand) * ~broadcast<T>(bind.hand_from_arm);
        }
        valid = valid & is_product(goal.hand);
    }
    if (s.has(SWIVEL_WITH_EFFECTOR) && !aims) {
        goal.effector = in_hand(s, s.io.load_vector(SWIVEL_EFFECTOR));
        valid = valid & (len2(goal.effector) <= T(kHuge2));
    }
    if (s.has(SWIVEL_WITH_WEIGHTS)) {
        goal.arm.upper = length(s, 0);
        goal.arm.fore = length(s, 1);
        goal.incoming = {s.rows.rotor(kIncomingRow), s.rows.rotor(kIncomingRow + 4),
                         has_hand ? s.rows.rotor(kIncomingRow + 8) : one<T>()};
        goal.weights = {s.io.load(SWIVEL_WEIGHTS, 0), s.io.load(SWIVEL_WEIGHTS, 1), s.io.load(SWIVEL_WEIGHTS, 2)};
        valid = valid & is_valid(goal.weights);
    }
    const WristGoal<T> wrist = wrist_goal(s.features(), goal);
    s.rows.set(kWristRow, wrist.place);
    if (has_hand) s.rows.set(kHandRow, wrist.hand);
    s.require(valid);
}

}  // namespace swivel::inline SWIVEL_ISA
