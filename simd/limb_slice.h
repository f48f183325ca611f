// SPDX-License-Identifier: MIT
//
// One slice of the whole limb. It loads the rows that a group has, brings them into the arm frame, solves, and stores
// the results. All limbs of a run have the same rows, so the slice asks for them once, and never for a single limb.
#pragma once

#include "core/clavicle.h"
#include "core/forearm_twist.h"
#include "core/limb.h"
#include "simd/slice.h"

namespace swivel::inline SWIVEL_ISA {

// A set of features that is compiled as a constant: a cone with a twist, which gained 1.4 times the speed with AVX-512.
// A full arm gained 1.25 times, too little for the time that the build takes.
inline constexpr swivel_features kConeAndTwist = SWIVEL_WITH_SHOULDER_CONE | SWIVEL_WITH_HUMERAL_TWIST;

// What a group's features make the formula use.
template <swivel_features Features>
SWIVEL_INLINE LimbUse limb_use(const SolveRun& run)
{
    const auto has = [&](swivel_features feature)
                         SWIVEL_INLINE_LAMBDA { return (features_of<Features>(run) & feature) != 0; };
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

template <class T, swivel_features Features>
SWIVEL_INLINE JointLimits<T> load_limits(const LimitUse& use, const Rows<T, Features>& rows)
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

// The parts of a limb that the formula does not see: how far its clavicle has turned, in the arm frame's axes, and
// whether its other inputs are good.
template <class T>
struct LimbEntry {
    Rotor<T> clavicle;
    Mask<T> valid;
};

// Turns the clavicle by its share, and the goal back into the arm frame, which goes with it.
template <class T, swivel_features Features>
SWIVEL_INLINE void turn_clavicle(const LimbUse& use, const Binding& bind, const Rows<T, Features>& rows,
                                 bool pole_is_point, LimbGoal<T>& goal, LimbEntry<T>& entry)
{
    const Vector<T> bone = sandwich(~broadcast<T>(bind.parent_from_arm), rows.load_vector(SWIVEL_CLAVICLE));
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
template <class T, swivel_features Features>
SWIVEL_INLINE LimbEntry<T> load_limb(const LimbUse& use, const Binding& bind, const Rows<T, Features>& rows,
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
        const ParentFrame<T> parent = rows.load_parent();
        entry.valid =
            entry.valid & is_valid(parent) & (len2(goal.arm.wrist) <= T(kHuge2)) & (len2(goal.arm.pole) <= T(kHuge2));
        // The arm frame goes with the parent.
        const Rotor<T> rotation = joints ? parent.rotation * broadcast<T>(bind.parent_from_arm) : parent.rotation;
        const bool pole_is_point = use.wish == Wish::pole && !rows.has(SWIVEL_POLE_DIRECTION);
        const SeenGoal<T> seen = seen_by(ParentFrame<T>{parent.position, rotation, parent.scale}, goal.arm.wrist,
                                         goal.arm.pole, T(pole_is_point));
        const T shrink = T(1) / seen.size;
        goal.arm.wrist = shrink * seen.wrist;
        goal.arm.pole = shrink * seen.pole;
        if (use.hand && !use.aim) goal.hand = ~rotation * goal.hand;
        if (rows.has(SWIVEL_WITH_CLAVICLE)) turn_clavicle(use, bind, rows, pole_is_point, goal, entry);
    }
    if (use.hand && joints)
        goal.hand = (use.aim ? ~broadcast<T>(bind.wrist_parent_from_arm) * goal.hand : goal.hand) *
                    ~broadcast<T>(bind.hand_from_arm);
    const auto in_hand = [&](const Vector<T>& v) SWIVEL_INLINE_LAMBDA {
        return joints ? sandwich(broadcast<T>(bind.hand_from_arm), v) : v;
    };
    if (use.effector) goal.effector = in_hand(rows.load_vector(SWIVEL_EFFECTOR));
    if (use.aim) {
        // Checked as given: a turn's rounding is no fault of the axis.
        const Vector<T> axis = rows.load_vector(SWIVEL_AIM);
        entry.valid = entry.valid & is_unit2(len2(axis));
        goal.aim = {in_hand(axis), rows.load(SWIVEL_AIM, 3), rows.load(SWIVEL_AIM, 4)};
    }
    if (use.angle) goal.angle = rows.load_turned(SWIVEL_ANGLE);
    if (use.incoming) {
        const auto load = [&](swivel_field field, const Rotor<T>& from, const Rotor<T>& to) SWIVEL_INLINE_LAMBDA {
            const Rotor<T> local = rows.load_rotor(field);
            entry.valid = entry.valid & is_orientation(local);
            return scaled(joints ? ~from * local * to : local);
        };
        goal.incoming = {
            load(SWIVEL_INCOMING_SHOULDER, broadcast<T>(bind.parent_from_arm), broadcast<T>(bind.upper_from_arm)),
            load(SWIVEL_INCOMING_ELBOW, broadcast<T>(bind.elbow_parent_from_arm), broadcast<T>(bind.fore_from_arm)),
            one<T>()};
        if (use.hand)
            goal.incoming.wrist = load(SWIVEL_INCOMING_WRIST, broadcast<T>(bind.wrist_parent_from_arm),
                                       ~broadcast<T>(bind.hand_from_arm));
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

template <class T, swivel_features Features>
SWIVEL_INLINE void store_limb(const LimbUse& use, const Binding& bind, const Rows<T, Features>& rows,
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
    const swivel_binding& b = *rows.run.binding;
    const auto if_joints = [&](const float(&q)[4]) SWIVEL_INLINE_LAMBDA { return joints ? broadcast<T>(q) : one<T>(); };
    const Hinge<T> elbow = hinge(pose.arm.cos_half, -pose.arm.sin_half);
    store(SWIVEL_SHOULDER, SWIVEL_INCOMING_SHOULDER,
          joints ? broadcast<T>(bind.parent_from_arm) * pose.arm.shoulder * ~broadcast<T>(bind.upper_from_arm)
                 : pose.arm.shoulder,
          if_joints(b.shoulder_rest));
    if (joints) {
        store(SWIVEL_ELBOW, SWIVEL_INCOMING_ELBOW,
              broadcast<T>(bind.elbow_parent_from_arm) * elbow * ~broadcast<T>(bind.fore_from_arm),
              broadcast<T>(b.elbow_rest));
    } else {
        rows.store(SWIVEL_ELBOW, 0, pose.arm.cos_half);
        rows.store(SWIVEL_ELBOW, 1, pose.arm.sin_half);
    }
    if (use.hand)
        store(SWIVEL_WRIST, SWIVEL_INCOMING_WRIST,
              joints ? broadcast<T>(bind.wrist_parent_from_arm) * pose.wrist * broadcast<T>(bind.hand_from_arm)
                     : pose.wrist,
              if_joints(b.wrist_rest));
    if (const int bones = static_cast<int>(twist_bone_count(features_of<Features>(rows.run))); bones > 0) {
        const Turned<T> twist = twist_rotor(pose.wrist);
        for (int n = 0; n < bones; ++n) {
            const Turned<T> share = shared_twist(twist, (n + 1.0) / (bones + 1.0));
            const auto turn = share.cos * unit<T, kScalar>() + share.sin * unit<T, kK>();
            const Rotor<T> parent = if_joints(b.twist_parent_from_arm[n]), bone = if_joints(b.twist_from_arm[n]);
            rows.store_rotor(SWIVEL_TWIST_BONES, hemisphere(parent * turn * ~bone), 4 * n);
        }
    }
    if (rows.has(SWIVEL_WITH_CLAVICLE)) {
        const Rotor<T> turn = broadcast<T>(bind.parent_from_arm) * entry.clavicle * ~broadcast<T>(bind.parent_from_arm);
        rows.store_rotor(SWIVEL_CLAVICLE_TURN, hemisphere(select(pose.arm.valid, turn, one<T>())));
    }
    if (use.reach) rows.store(SWIVEL_STRETCH, 0, pose.stretch);
    if (use.continuity) {
        rows.store(SWIVEL_NORMAL, 0, pose.normal.template at<kE1>());
        rows.store(SWIVEL_NORMAL, 1, pose.normal.template at<kE2>());
        rows.store(SWIVEL_NORMAL, 2, pose.normal.template at<kE3>());
    }
}

// The rows of the slice that starts with a limb of a run.
template <class T, swivel_features Features>
SWIVEL_INLINE Rows<T, Features> slice_rows(const SolveRun& run, std::size_t limb, std::uint32_t chosen)
{
    const bool told = Features & kTold;
    const std::uint32_t inputs = told ? run.input_row_count : kPlan<Features>.input_count;
    const std::uint32_t results = told ? run.result_row_count : kPlan<Features>.result_count;
    return {run, run.input + row_offset(limb, inputs, 0), run.results + row_offset(limb, results, 0), chosen};
}

// Lanes of a slice that wait for a search, a bit for each: their results mean nothing yet.
struct Waiting {
    std::uint32_t lanes;
    Search search;
};
// Solves one slice.
template <bool Aims, class Policy, class T, swivel_features Features>
SWIVEL_INLINE Waiting solve_limb_slice(const LimbUse& use, const Binding& bind, const Rows<T, Features>& rows)
{
    LimbGoal<T> goal;
    LimbEntry<T> entry = load_limb(use, bind, rows, goal);
    if (rows.chosen != kEveryLane)
        entry.valid = entry.valid & lanes_where<T>(rows.chosen);  // others search for nothing
    constexpr int boxes = Features & (SWIVEL_WITH_SHOULDER_BOX | SWIVEL_WITH_WRIST_BOX) ? kMostBoxes : 0;
    const SolvedLimb<T> pose = solve_limb<Aims, Policy, boxes>(use, goal, entry.valid);
    rows.store(SWIVEL_FLAGS, 0, pose.arm.flags);
    const std::uint32_t kept = rows.run.keeps ? lane_bits(!pose.arm.valid) : 0;
    store_limb(use, bind, Rows<T, Features>{rows.run, rows.input, rows.results, rows.chosen & ~kept}, entry, pose);
    return {all(pose.settled) ? 0 : lane_bits(!pose.settled) & rows.chosen, pose.next};
}

}  // namespace swivel::inline SWIVEL_ISA
