// SPDX-License-Identifier: MIT
//
// The stages of a body's limb: they bring the posed limb into the arm frame, turn a hand that yields, and take what was
// solved back to the joints.
#pragma once

#include "core/forearm_twist.h"
#include "core/posed_limb.h"
#include "core/wrist_goal.h"
#include "simd/bodies/fit_stages.h"
#include "simd/bodies/hold_stages.h"
#include "simd/bodies/joint_stages.h"
#include "simd/bodies/look_stages.h"
#include "simd/bodies/plant_stages.h"

namespace swivel::inline SWIVEL_ISA {

// From shoulder to wrist as the pose has it, with lengths that are written in place of its own.
template <class S>
SWIVEL_INLINE typename S::T posed_reach(const S& s, const PosedLimb<typename S::T>& posed,
                                        const typename S::T& per_scale)
{
    using T = typename S::T;
    const T reach = per_scale * sqrt(len2(posed.wrist_place - posed.shoulder_place));
    const T given_a = s.io.load(SWIVEL_LENGTHS, 0), given_b = s.io.load(SWIVEL_LENGTHS, 1);
    const Mask<T> is_given = (given_a == given_a) | (given_b == given_b);
    if (!any(is_given)) return reach;
    const Vector<T> upper = posed.elbow_place - posed.shoulder_place, fore = posed.wrist_place - posed.elbow_place;
    const T cosine = scalar_product(upper, fore) / hi(sqrt(len2(upper) * len2(fore)), T(kTiny)),
            a = s.body.get(kLengthsRow), b = s.body.get(kLengthsRow + 1);
    return select(is_given, sqrt(hi(a * a + b * b + (a + a) * b * cosine, T(0))), reach);
}
// The goal, as the parent sees it. Joints' places are from the root's.
template <class S>
SWIVEL_INLINE void see_goal(const S& s, const SeenLimb<typename S::T>& seen, const Vector<typename S::T>& shoulder,
                            const typename S::T& per_scale)
{
    using T = typename S::T;
    const bool is_sent = s.has(kLibraryGoal);
    const std::uint32_t goal = s.strip.run.plan->limb.goal;
    // A planted point stays where it is while the root is shifted. A held thing goes with the shifted body.
    const Vector<T> root = s.has(SWIVEL_WITH_LINK) ? vector(T(0), T(0), T(0))
                                                   : s.body.vector(is_sent ? kShiftedRow : kRootRow),
                    target = is_sent ? s.body.vector(goal + kGoalPlaceRow) : s.io.load_vector(SWIVEL_TARGET);
    s.require(len2(target) <= T(kHuge2));
    // A goal that the library makes does not depend on the root's place, which is bad input even so.
    if (is_sent) s.require(len2(s.body.vector(kRootRow)) <= T(kHuge2));
    s.rows.set(kTargetRow, per_scale * seen.back(target - root - shoulder));
    if (has_pole(s)) {
        const Vector<T> pole = s.io.load_vector(SWIVEL_POLE);
        s.require(len2(pole) <= T(kHuge2));
        s.rows.set(kPoleRow,
                   per_scale * seen.back(pole_is_point(s) ? pole - s.body.vector(kRootRow) - shoulder : pole));
    }
    if (s.has(SWIVEL_WITH_HAND)) {
        const bool aims = s.has(SWIVEL_WITH_AIM);
        const Rotor<T> hand = aims      ? s.io.load_rotor(SWIVEL_HAND)
                              : is_sent ? s.body.rotor(goal + kGoalHandRow)
                                        : wanted_hand(s).rotation;
        s.require(is_orientation(hand));
        s.rows.set(kTargetHandRow, aims ? hand : ~seen.arm * hand);
    }
}

template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::posed>, const S& s)
{
    using T = typename S::T;
    constexpr BendNormal which = S::template is<SWIVEL_POLE_INCOMING>() ? BendNormal::own : BendNormal::chosen;
    const bool weighs = s.has(SWIVEL_WITH_WEIGHTS);
    const BodyLimb& limb = s.strip.run.plan->limb;
    const Rotor<T> wrist = s.body.rotor(limb.wrist + kTurnRow);
    const PosedLimb<T> posed{s.body.rotor(limb.parent + kTurnRow), s.body.rotor(limb.shoulder + kTurnRow),
                             s.body.vector(limb.shoulder + kPlaceRow), s.body.vector(limb.elbow + kPlaceRow),
                             s.body.vector(limb.wrist + kPlaceRow)};
    s.require(is_posed(s));
    s.require(is_share(body_weight(s)));
    if (s.has(SWIVEL_WITH_PELVIS_FIT)) s.require(FitWish<S>(s).is_valid());
    Mask<T> stays = no_lanes<T>();
    if (which == BendNormal::chosen && weighs) stays = s.io.load(SWIVEL_WEIGHTS, 2) == T(0);
    const SeenLimb<T> seen = seen_limb<which>(posed, broadcast<T>(s.strip.bind.parent_from_arm),
                                              vector(T(limb.hinge[0]), T(limb.hinge[1]), T(limb.hinge[2])), stays);
    s.rows.set(kIncomingRow, seen.model.upper);
    if (weighs || s.has(kTwistBones | SWIVEL_WITH_AIM | SWIVEL_WITH_RECORD)) {
        const Rotor<T> hand = ~seen.frames.fore * wrist * ~broadcast<T>(s.strip.bind.hand_from_arm);
        s.rows.set(kIncomingRow + 4, ~seen.model.upper * seen.model.fore);
        s.rows.set(kIncomingRow + 8, hand);
        if (s.has(kTwistBones)) {
            const Turned<T> twist = twist_rotor(hand);
            s.body.set(kTwistInRow, twist.cos);
            s.body.set(kTwistInRow + 1, twist.sin);
        }
    }
    const T per_scale = T(1) / s.body.get(limb.parent + kScaleRow);
    see_goal(s, seen, posed.shoulder_place, per_scale);
    // Lengths that were never written are NaN.
    const auto length = [&](int n, const T& posed_length) SWIVEL_INLINE_LAMBDA {
        const T given = s.io.load(SWIVEL_LENGTHS, n);
        return select(given == given, given, per_scale * posed_length);
    };
    s.body.set(kLengthsRow, length(0, seen.bones.upper_length));
    s.body.set(kLengthsRow + 1, length(1, seen.bones.fore_length));
    if (s.has(SWIVEL_WITH_CAP)) s.body.set(kReachRow, posed_reach(s, posed, per_scale));
    const auto set_from_arm = [&](std::uint32_t row, std::uint32_t joint, const Rotor<T>& frame)
                                  SWIVEL_INLINE_LAMBDA { s.body.set(row, ~s.body.rotor(joint + kTurnRow) * frame); };
    s.body.set(kUpperFromArmRow, ~posed.shoulder * seen.frames.upper);
    set_from_arm(kForeFromArmRow, limb.elbow, seen.frames.fore);
    if (limb.elbow_parent != limb.shoulder) set_from_arm(kElbowParentFromArmRow, limb.elbow_parent, seen.frames.upper);
    if (limb.wrist_parent != limb.elbow) set_from_arm(kWristParentFromArmRow, limb.wrist_parent, seen.frames.fore);
}

// Keeps what the pose gave, with the clavicle as turned. So the limb can be seen again as a free one.
template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::record>, const S& s)
{
    using T = typename S::T;
    const BodyLimb& limb = s.strip.run.plan->limb;
    const ArmFrame<T> arm = arm_frame(s);
    const T scale = s.body.get(limb.parent + kScaleRow);
    Rotor<T> hand = s.rows.rotor(kIncomingRow + 8);
    if (s.has(SWIVEL_WITH_AIM) && s.has(SWIVEL_WITH_HAND))
        hand = ~s.body.rotor(limb.wrist_parent_row()) * s.io.load_rotor(SWIVEL_HAND) *
               ~broadcast<T>(s.strip.bind.hand_from_arm);
    const Rows<T, kRuntimeFeatures> out = s.chosen_rows();
    out.store(SWIVEL_RECORD, kRecordShoulder, with_one_nan(arm.shoulder + s.body.vector(kRootRow)));
    out.store(SWIVEL_RECORD, kRecordArm, with_one_nan(arm.rotation));
    // All else that is bad in the pose shows in the scale.
    out.store(SWIVEL_RECORD, kRecordScale, with_one_nan(select(is_posed(s), scale, T(__builtin_nan("")))));
    out.store(SWIVEL_RECORD, kRecordLengths, with_one_nan(s.body.get(kLengthsRow)));
    out.store(SWIVEL_RECORD, kRecordLengths + 1, with_one_nan(s.body.get(kLengthsRow + 1)));
    out.store(SWIVEL_RECORD, kRecordIncoming, with_one_nan(s.rows.rotor(kIncomingRow)));
    out.store(SWIVEL_RECORD, kRecordIncoming + 4, with_one_nan(s.rows.rotor(kIncomingRow + 4)));
    out.store(SWIVEL_RECORD, kRecordIncoming + 8, with_one_nan(hand));
}

// The foot after the least turn about the ankle that keeps its toe over the ground.
template <class S>
SWIVEL_INLINE Rotor<typename S::T> toe_over_ground(const S& s, const Mask<typename S::T>& misses,
                                                   const Vector<typename S::T>& ankle,
                                                   const Vector<typename S::T>& effector,
                                                   const Rotor<typename S::T>& foot)
{
    using T = typename S::T;
    const GroundPlane<T> ground = ground_of(s, up_of(s));
    const ArmFrame<T> arm = arm_frame(s);
    const T scale = s.body.get(s.strip.run.plan->limb.parent + kScaleRow),
            height = ground.distance(arm.shoulder + scale * sandwich(arm.rotation, ankle)) / scale,
            wanted = T(s.strip.run.plan->limb.ground.given.toe_clearance) - height;
    return lifting_turn(ground.exists & misses, sandwich(~arm.rotation, ground.normal), sandwich(foot, effector),
                        wanted) *
           foot;
}

// The hand turns to where the wrist does not get. A foot that is turned so keeps its toe over the ground.
template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::yield>, const S& s)
{
    using T = typename S::T;
    const T stretch = s.rows.get(kStretchRow), upper = stretch * length(s, 0), fore = stretch * length(s, 1);
    const Vector<T> achieved = bent_reach(upper, fore, s.rows.get(kFlexionRow)) * s.rows.vector(kLineRow),
                    missing = s.rows.vector(kWristRow) - achieved,
                    effector = in_hand(s, s.io.load_vector(SWIVEL_EFFECTOR));
    const Mask<T> misses = misses_its_place(missing, upper + fore);
    Rotor<T> hand = yielding_hand(s.rows.rotor(kHandRow), effector, missing, upper + fore);
    if (s.has(SWIVEL_WITH_GROUND) && any(misses)) hand = toe_over_ground(s, misses, achieved, effector, hand);
    s.rows.set(kHandRow, hand);
}

// A twist bone turns from its incoming rotation, by its share of how far the hand's twist changes.
template <class S>
SWIVEL_INLINE Rotor<typename S::T> turned_twist_bone(const S& s, std::uint32_t n)
{
    using T = typename S::T;
    const BodyLimb& limb = s.strip.run.plan->limb;
    const TwistBone& bone = limb.twist_bones[n];
    const Rotor<T> fore = s.body.rotor(limb.elbow + kTurnRow) * s.body.rotor(kForeFromArmRow);
    const Rotor<T> from_arm = ~s.body.rotor(bone.parent + kTurnRow) * fore;
    const Rotor<T> turn = rotor(T(0), T(0), s.io.load(SWIVEL_TWIST_BONES, static_cast<int>(4 * n + 2)),
                                s.io.load(SWIVEL_TWIST_BONES, static_cast<int>(4 * n + 3)));
    return unit_rotation(from_arm * turn * ~from_arm * s.body.rotor(bone.row + kLocalRow));
}

// The lanes whose joints stay as they come. Those are of bad input, in groups that keep it and in the body's space,
// where no rest pose is known. And they are those where no weight asks for more.
template <class S>
SWIVEL_INLINE Mask<typename S::T> kept_lanes(const S& s, const Mask<typename S::T>& valid)
{
    using T = typename S::T;
    const bool keeps = s.strip.run.keeps_pose || s.strip.run.strip.pose->space == SWIVEL_IN_BODY;
    Mask<T> kept = keeps ? !valid : no_lanes<T>();
    if (s.has(SWIVEL_WITH_WEIGHTS) && !(s.strip.run.features & kBoundingFeatures)) {
        const T none = T(0);
        kept = kept | (valid & (s.io.load(SWIVEL_WEIGHTS, 0) == none) & (s.io.load(SWIVEL_WEIGHTS, 1) == none) &
                       (s.io.load(SWIVEL_WEIGHTS, 2) == none));
    }
    if (s.has(SWIVEL_WITH_LINK) && s.has(SWIVEL_POLE_INCOMING) && !(s.strip.run.features & kMovingFeatures))
        kept = kept | (valid & (s.body.get(s.strip.run.plan->limb.goal + kGoalOwnRow) > T(0.5)));
    return kept;
}

// The rotations of the joints, in place of the incoming ones.
template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::correct>, const S& s)
{
    using T = typename S::T;
    const Binding& bind = s.strip.bind;
    const swivel_binding& b = *s.strip.run.binding;
    const BodyLimb& limb = s.strip.run.plan->limb;
    const T weight = body_weight(s);
    const bool fades = s.strip.run.strip.pose->weight.data != nullptr;
    const Mask<T> valid = lanes_where<T>(s.good()), kept = kept_lanes(s, valid) | (valid & (weight == T(0)));
    s.body.set(kKeptRow, select(kept, T(1), T(0)));
    const auto store = [&](std::uint32_t joint, const Rotor<T>& solved, const float(&rest)[4]) SWIVEL_INLINE_LAMBDA {
        const Rotor<T> faded = fades ? part_of_turn(s.body.rotor(joint + kLocalRow), solved, weight) : solved;
        set_local(s, joint, faded, broadcast<T>(rest), valid, kept);
    };
    const Hinge<T> elbow = hinge(s.io.load(SWIVEL_ELBOW, 0), -s.io.load(SWIVEL_ELBOW, 1));
    const Rotor<T> shoulder = s.io.load_rotor(SWIVEL_SHOULDER);
    store(limb.shoulder, broadcast<T>(bind.parent_from_arm) * shoulder * ~s.body.rotor(kUpperFromArmRow),
          b.shoulder_rest);
    store(limb.elbow, s.body.rotor(limb.elbow_parent_row()) * elbow * ~s.body.rotor(kForeFromArmRow), b.elbow_rest);
    if (s.has(SWIVEL_WITH_HAND))
        store(limb.wrist,
              s.body.rotor(limb.wrist_parent_row()) * s.rows.rotor(kTwistRow) * broadcast<T>(bind.hand_from_arm),
              b.wrist_rest);
    if (s.has(SWIVEL_WITH_CLAVICLE))
        store(limb.parent,
              unit_rotation(s.body.rotor(limb.parent + kLocalRow) * s.io.load_rotor(SWIVEL_CLAVICLE_ROTATION)),
              limb.clavicle_rest);
    for (std::uint32_t n = 0; n < twist_bone_count(s.strip.run.features); ++n)
        store(limb.twist_bones[n].row, turned_twist_bone(s, n), limb.twist_bones[n].rest);
}

}  // namespace swivel::inline SWIVEL_ISA
