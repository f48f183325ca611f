// SPDX-License-Identifier: MIT
//
// One step of the whole limb: loads the rows that a crowd has, brings them into the arm frame, solves, and stores what
// the crowd gives out. Which rows those are is the same for all of a run's limbs: it asks once a step,
// never for a limb.
#pragma once

#include "core/clavicle.h"
#include "core/forearm_twist.h"
#include "core/limb.h"
#include "core/space.h"
#include "simd/kernels.h"
#include "simd/lanes.h"
#include "simd/rows.h"

namespace swivel::inline SWIVEL_ISA {

// The rows of one step of T's lanes, which lie in one block.
template <class T>
struct LimbRows {
    const LimbRun& run;
    const float* input;
    float* results;

    SWIVEL_INLINE bool has(std::uint32_t features) const { return (run.features & features) != 0; }
    SWIVEL_INLINE std::uint32_t row(swivel_field field, int component) const
    {
        return run.first_row[field] + static_cast<std::uint32_t>(component);
    }
    SWIVEL_INLINE T load(swivel_field field, int component) const { return lanes(input, row(field, component)); }
    SWIVEL_INLINE T load_result(swivel_field field, int component) const
    {
        return lanes(results, row(field, component));
    }
    SWIVEL_INLINE T lanes(const float* rows, std::uint32_t row) const
    {
        return load_lanes<T>([&](std::size_t lane) SWIVEL_INLINE_LAMBDA { return rows + row * SWIVEL_LANES + lane; });
    }
    SWIVEL_INLINE Vector<T> load_vector(swivel_field field) const
    {
        return vector(load(field, 0), load(field, 1), load(field, 2));
    }
    SWIVEL_INLINE Rotor<T> load_rotor(swivel_field field) const
    {
        return rotor(load(field, 0), load(field, 1), load(field, 2), load(field, 3));
    }
    SWIVEL_INLINE Turned<T> load_turned(swivel_field field, int first = 0) const
    {
        return {load(field, first), load(field, first + 1)};
    }
    SWIVEL_INLINE Range<T> load_range(swivel_field field, int first = 0) const
    {
        return {load_turned(field, first), load_turned(field, first + 2)};
    }
    SWIVEL_INLINE Cone<T> load_cone(swivel_field field) const { return {load_vector(field), load(field, 3)}; }

    template <class Value>
    SWIVEL_INLINE void store(swivel_field field, int component, const Value& value) const
    {
        float* const to = results + row(field, component) * SWIVEL_LANES;
        store_lanes([&](std::size_t lane) SWIVEL_INLINE_LAMBDA { return to + lane; }, value);
    }
    SWIVEL_INLINE void store_rotor(swivel_field field, const Rotor<T>& q, int first = 0) const
    {
        store(field, first, q.template at<kI>());
        store(field, first + 1, q.template at<kJ>());
        store(field, first + 2, q.template at<kK>());
        store(field, first + 3, q.template at<kScalar>());
    }
};

// What a crowd's features make the formula use.
inline LimbUse limb_use(const LimbRun& run)
{
    const auto has = [&](std::uint32_t feature) { return (run.features & feature) != 0; };
    LimbUse use;
    use.hand = has(SWIVEL_WITH_HAND);
    use.effector = has(SWIVEL_WITH_EFFECTOR);
    use.angle = has(SWIVEL_WITH_ANGLE);
    use.incoming = has(SWIVEL_WITH_INCOMING);
    use.weights = has(SWIVEL_WITH_WEIGHTS);
    use.reach = has(SWIVEL_WITH_REACH);
    use.continuity = has(SWIVEL_WITH_MOST_SWIVEL);
    use.aim = has(SWIVEL_WITH_AIM);
    use.wish = has(SWIVEL_POLE_INCOMING) ? Wish::incoming : has(SWIVEL_POLE_NORMAL) ? Wish::normal : Wish::pole;
    use.limits.flexion = has(SWIVEL_WITH_FLEXION_LIMIT);
    use.limits.shoulder_cone = has(SWIVEL_WITH_SHOULDER_CONE);
    use.limits.humeral_twist = has(SWIVEL_WITH_HUMERAL_TWIST);
    use.limits.shoulder_box = has(SWIVEL_WITH_SHOULDER_BOX);
    use.limits.hand_cone = has(SWIVEL_WITH_HAND_CONE);
    use.limits.forearm_twist = has(SWIVEL_WITH_FOREARM_TWIST);
    use.limits.hand_twist = has(SWIVEL_WITH_HAND_TWIST);
    use.limits.wrist_box = has(SWIVEL_WITH_WRIST_BOX);
    use.limits.shoulder_order = kEulerOrders[run.shoulder_order];
    use.limits.wrist_order = kEulerOrders[run.wrist_order];
    return use;
}

// How the skeleton's joints lie to the arm frame; all identities in crowds without joints.
template <class T>
struct LimbBinding {
    Rotor<T> parent_from_arm, upper_from_arm, fore_from_arm;
    Rotor<T> hand_from_arm;  // the hand joint's own frame when the arm lies in the arm frame at rest
    Rotor<T> shoulder_rest, elbow_rest, wrist_rest;
};
template <class T>
SWIVEL_INLINE LimbBinding<T> limb_binding(const LimbRun& run)
{
    const auto broadcast = [](const float(&q)[4])
                               SWIVEL_INLINE_LAMBDA { return rotor(T(q[0]), T(q[1]), T(q[2]), T(q[3])); };
    if (!(run.features & SWIVEL_JOINTS)) return {one<T>(), one<T>(), one<T>(), one<T>(), one<T>(), one<T>(), one<T>()};
    const swivel_binding& b = *run.binding;
    const Rotor<T> fore = broadcast(b.fore_from_arm), wrist_rest = broadcast(b.wrist_rest);
    return {broadcast(b.parent_from_arm), broadcast(b.upper_from_arm), fore,      normalise(~fore * wrist_rest),
            broadcast(b.shoulder_rest),   broadcast(b.elbow_rest),     wrist_rest};
}

template <class T>
SWIVEL_INLINE JointLimits<T> load_limits(const LimitUse& use, const LimbRows<T>& rows)
{
    JointLimits<T> limits;
    if (use.flexion) limits.flexion = {rows.load(SWIVEL_FLEXION_LIMIT, 0), rows.load(SWIVEL_FLEXION_LIMIT, 1)};
    if (use.shoulder_cone) limits.shoulder_cone = rows.load_cone(SWIVEL_SHOULDER_CONE);
    if (use.humeral_twist) limits.humeral_twist = rows.load_range(SWIVEL_HUMERAL_TWIST);
    if (use.hand_cone) limits.hand_cone = rows.load_cone(SWIVEL_HAND_CONE);
    if (use.forearm_twist) limits.forearm_twist = rows.load_range(SWIVEL_FOREARM_TWIST);
    if (use.hand_twist)
        limits.hand_twist = {rows.load_vector(SWIVEL_HAND_TWIST), rows.load_range(SWIVEL_HAND_TWIST, 3)};
    for (int n = 0; n < 3; ++n) {
        if (use.shoulder_box) limits.shoulder_box[n] = rows.load_range(SWIVEL_SHOULDER_BOX, 4 * n);
        if (use.wrist_box) limits.wrist_box[n] = rows.load_range(SWIVEL_WRIST_BOX, 4 * n);
    }
    return limits;
}

// What the formula does not see of a limb: how far its clavicle has been turned, in the arm frame's axes, and whether
// its other inputs are good.
template <class T>
struct LimbEntry {
    Rotor<T> clavicle;
    Mask<T> valid;
};

// Turns the clavicle by its share, and the goal back into the arm frame, which goes with it.
template <class T>
SWIVEL_INLINE void turn_clavicle(const LimbUse& use, const LimbBinding<T>& bind, const LimbRows<T>& rows,
                                 bool pole_is_point, LimbGoal<T>& goal, LimbEntry<T>& entry)
{
    const Vector<T> bone = sandwich(~bind.parent_from_arm, rows.load_vector(SWIVEL_CLAVICLE));
    const T share = rows.load(SWIVEL_CLAVICLE, 3);
    entry.valid = entry.valid & (len2(bone) <= T(kHuge2)) & is_share(share);
    entry.clavicle =
        clavicle_turn(bone, goal.arm.wrist + bone, use.weights ? share * rows.load(SWIVEL_WEIGHTS, 0) : share);
    const Turn<T> back = turn_by(~entry.clavicle);
    goal.arm.wrist = back(goal.arm.wrist + bone) - bone;
    goal.arm.pole = pole_is_point ? back(goal.arm.pole + bone) - bone : back(goal.arm.pole);
    if (use.hand && !use.aim) goal.hand = ~entry.clavicle * goal.hand;
}

// Loads a goal as the formula takes it; what is not used stays as it is.
template <class T>
SWIVEL_INLINE LimbEntry<T> load_limb(const LimbUse& use, const LimbBinding<T>& bind, const LimbRows<T>& rows,
                                     LimbGoal<T>& goal)
{
    LimbEntry<T> entry;
    entry.valid = T(0) == T(0);
    const Vector<T> zero = vector(T(0), T(0), T(0));
    const bool joints = rows.has(SWIVEL_JOINTS);
    goal.arm = {rows.load_vector(SWIVEL_TARGET), use.wish == Wish::incoming ? zero : rows.load_vector(SWIVEL_POLE),
                rows.load(SWIVEL_LENGTHS, 0), rows.load(SWIVEL_LENGTHS, 1)};
    if (use.hand) {
        goal.hand = rows.load_rotor(SWIVEL_HAND);
        entry.valid = entry.valid & is_orientation(goal.hand);
    }
    if (rows.has(SWIVEL_WORLD)) {
        const ParentFrame<T> parent{rows.load_vector(SWIVEL_SHOULDER_POSITION), rows.load_rotor(SWIVEL_PARENT_ROTATION),
                                    rows.load(SWIVEL_PARENT_SCALE, 0)};
        entry.valid =
            entry.valid & is_valid(parent) & (len2(goal.arm.wrist) <= T(kHuge2)) & (len2(goal.arm.pole) <= T(kHuge2));
        const Rotor<T> arm_from_world = ~(joints ? parent.rotation * bind.parent_from_arm : parent.rotation);
        const Turn<T> turn = turn_by(arm_from_world);
        const T shrink = T(1) / (parent.scale * turn.length2);
        const bool pole_is_point = use.wish == Wish::pole && !rows.has(SWIVEL_POLE_DIRECTION);
        goal.arm.wrist = shrink * turn(goal.arm.wrist - parent.position);
        goal.arm.pole = shrink * turn(pole_is_point ? goal.arm.pole - parent.position : goal.arm.pole);
        if (use.hand && !use.aim) goal.hand = arm_from_world * goal.hand;
        if (rows.has(SWIVEL_WITH_CLAVICLE)) turn_clavicle(use, bind, rows, pole_is_point, goal, entry);
    }
    if (use.hand && joints) goal.hand = (use.aim ? ~bind.fore_from_arm * goal.hand : goal.hand) * ~bind.hand_from_arm;
    const auto load_in_hand = [&](swivel_field field) SWIVEL_INLINE_LAMBDA {
        const Vector<T> v = rows.load_vector(field);
        return joints ? sandwich(bind.hand_from_arm, v) : v;
    };
    if (use.effector) goal.effector = load_in_hand(SWIVEL_EFFECTOR);
    if (use.aim) goal.aim = {load_in_hand(SWIVEL_AIM), rows.load(SWIVEL_AIM, 3), rows.load(SWIVEL_AIM, 4)};
    if (use.angle) goal.angle = rows.load_turned(SWIVEL_ANGLE);
    if (use.incoming) {
        const auto load = [&](swivel_field field, const Rotor<T>& from, const Rotor<T>& to) SWIVEL_INLINE_LAMBDA {
            const Rotor<T> local = rows.load_rotor(field);
            entry.valid = entry.valid & is_orientation(local);
            return scaled(joints ? ~from * local * to : local);
        };
        goal.incoming = {load(SWIVEL_INCOMING_SHOULDER, bind.parent_from_arm, bind.upper_from_arm),
                         load(SWIVEL_INCOMING_ELBOW, bind.upper_from_arm, bind.fore_from_arm), one<T>()};
        if (use.hand) goal.incoming.wrist = load(SWIVEL_INCOMING_WRIST, bind.fore_from_arm, ~bind.hand_from_arm);
    }
    if (use.weights)
        goal.weights = {rows.load(SWIVEL_WEIGHTS, 0), rows.load(SWIVEL_WEIGHTS, 1), rows.load(SWIVEL_WEIGHTS, 2)};
    if (use.reach)
        goal.reach = {rows.load(SWIVEL_REACH, 0), rows.load(SWIVEL_REACH, 1), rows.load(SWIVEL_REACH, 2),
                      rows.load(SWIVEL_REACH, 3)};
    if (use.continuity)
        goal.continuity = {vector(rows.load_result(SWIVEL_NORMAL, 0), rows.load_result(SWIVEL_NORMAL, 1),
                                  rows.load_result(SWIVEL_NORMAL, 2)),
                           rows.load_turned(SWIVEL_MOST_SWIVEL)};
    goal.limits = load_limits(use.limits, rows);
    return entry;
}

template <class T>
SWIVEL_INLINE void store_limb(const LimbUse& use, const LimbBinding<T>& bind, const LimbRows<T>& rows,
                              const LimbEntry<T>& entry, const SolvedLimb<T>& pose)
{
    const auto store = [&](swivel_field field, swivel_field incoming, const Rotor<T>& q, const Rotor<T>& rest)
                           SWIVEL_INLINE_LAMBDA {
                               const Rotor<T> safe = select(pose.arm.valid, q, hemisphere(rest));
                               if (!use.incoming) return rows.store_rotor(field, hemisphere(safe));
                               const T side = scalar_product(~rows.load_rotor(incoming), safe);
                               rows.store_rotor(field, with_sign_of(select(pose.arm.valid, side, T(1)), safe));
                           };
    const bool joints = rows.has(SWIVEL_JOINTS);
    const Hinge<T> elbow = hinge(pose.arm.cos_half, -pose.arm.sin_half);
    store(SWIVEL_SHOULDER, SWIVEL_INCOMING_SHOULDER,
          joints ? bind.parent_from_arm * pose.arm.shoulder * ~bind.upper_from_arm : pose.arm.shoulder,
          bind.shoulder_rest);
    if (joints) {
        store(SWIVEL_ELBOW, SWIVEL_INCOMING_ELBOW, bind.upper_from_arm * elbow * ~bind.fore_from_arm, bind.elbow_rest);
    } else {
        rows.store(SWIVEL_ELBOW, 0, pose.arm.cos_half);
        rows.store(SWIVEL_ELBOW, 1, pose.arm.sin_half);
    }
    if (use.hand)
        store(SWIVEL_WRIST, SWIVEL_INCOMING_WRIST,
              joints ? bind.fore_from_arm * pose.wrist * bind.hand_from_arm : pose.wrist, bind.wrist_rest);
    if (const int bones = static_cast<int>(twist_bone_count(rows.run.features)); bones > 0) {
        const Turned<T> twist = twist_rotor(pose.wrist);
        for (int n = 0; n < bones; ++n) {
            const Turned<T> share = shared_twist(twist, (n + 1.0) / (bones + 1.0));
            const Rotor<T> q =
                bind.fore_from_arm * (share.cos * unit<T, kScalar>() + share.sin * unit<T, kK>()) * ~bind.fore_from_arm;
            rows.store_rotor(SWIVEL_TWIST_BONES, hemisphere(q), 4 * n);
        }
    }
    if (rows.has(SWIVEL_WITH_CLAVICLE)) {
        const Rotor<T> turn = bind.parent_from_arm * entry.clavicle * ~bind.parent_from_arm;
        rows.store_rotor(SWIVEL_CLAVICLE_TURN, hemisphere(select(pose.arm.valid, turn, one<T>())));
    }
    rows.store(SWIVEL_FLAGS, 0, pose.arm.flags);
    if (use.reach) rows.store(SWIVEL_STRETCH, 0, pose.stretch);
    if (use.continuity) {
        rows.store(SWIVEL_NORMAL, 0, pose.normal.template at<kE1>());
        rows.store(SWIVEL_NORMAL, 1, pose.normal.template at<kE2>());
        rows.store(SWIVEL_NORMAL, 2, pose.normal.template at<kE3>());
    }
}

// The rows of the step that starts with a limb of a run.
template <class T>
SWIVEL_INLINE LimbRows<T> rows_of(const LimbRun& run, std::size_t limb)
{
    return {run, run.input + row_offset(limb, run.input_row_count, 0),
            run.results ? run.results + row_offset(limb, run.result_row_count, 0) : nullptr};
}

// Solves one step. Where it says false the limits allow no swivel, and a search for the least violation was not wanted:
// there the results mean nothing.
template <bool Aims, bool Searches, class T>
SWIVEL_INLINE Mask<T> solve_limb_step(const LimbUse& use, const LimbBinding<T>& bind, const LimbRows<T>& rows)
{
    LimbGoal<T> goal;
    const LimbEntry<T> entry = load_limb(use, bind, rows, goal);
    const SolvedLimb<T> pose = solve_limb<Aims, Searches>(use, goal, entry.valid);
    store_limb(use, bind, rows, entry, pose);
    return pose.settled;
}

}  // namespace swivel::inline SWIVEL_ISA
