// SPDX-License-Identifier: MIT
//
// The stages that lay the limb along the line to its wrist: how its bones reach, and the swivel plane that is wished
// for.
#pragma once

#include "core/aim.h"
#include "simd/limbs/goal_stages.h"

namespace swivel::inline SWIVEL_ISA {

// A limb laid along the line from shoulder to wrist.
template <class T>
struct Laid {
    Vector<T> line;  // unit
    Word<T> flags;
};
// bones_of(distance): the bones for a wanted distance.
template <class S, class BonesOf>
SWIVEL_INLINE Laid<typename S::T> lay_bones(const S& s, const BonesOf& bones_of)
{
    using T = typename S::T;
    const bool is_in_goal = s.has(SWIVEL_WITH_HAND) || s.has(SWIVEL_WITH_WEIGHTS);
    const Vector<T> wrist = s.goal_vector(s.has(SWIVEL_WORLD) || is_in_goal, kWristRow, SWIVEL_TARGET);
    if (!is_in_goal) s.require(len2(wrist) <= T(kHuge2));  // the stage `goal` has not seen it
    const WristLine<T> to = wrist_line(wrist);
    const auto bones = bones_of(to.wanted);
    if constexpr (std::is_same_v<decltype(bones.lift), Rotor<T>>) {
        s.rows.set(kLiftRow, bones.lift);
    } else {
        s.rows.set(kLiftRow, bones.lift.template at<kScalar>());
        s.rows.set(kLiftRow + 1, bones.lift.template at<kI>());
    }
    s.rows.set(kFlexionRow, bones.cos_half);
    s.rows.set(kFlexionRow + 1, bones.sin_half);
    s.rows.set(kStretchRow, bones.stretch);
    s.rows.set(kLineRow, to.line);
    return {to.line, bones.flags | word_where(to.on_shoulder, SWIVEL_SWIVEL_UNDEFINED)};
}
template <class S>
SWIVEL_INLINE void load_lengths(const S& s, ArmGoal<typename S::T>& arm)
{
    arm.upper = length(s, 0);
    arm.fore = length(s, 1);
    s.require(is_length(arm.upper) & is_length(arm.fore));
}

template <class S>
SWIVEL_INLINE Laid<typename S::T> lay_reaching_bones(const S& s, swivel_features features)
{
    using T = typename S::T;
    LimbGoal<T> goal;
    load_lengths(s, goal.arm);
    if (features & SWIVEL_WITH_REACH) {
        goal.reach = {s.io.load(SWIVEL_REACH, 0), s.io.load(SWIVEL_REACH, 1), s.io.load(SWIVEL_REACH, 2),
                      s.io.load(SWIVEL_REACH, 3)};
        s.require(is_valid(goal.reach));
    }
    if (features & SWIVEL_WITH_CAP) {
        goal.cap = {
            s.io.load(SWIVEL_CAP, 0), s.io.load(SWIVEL_CAP, 1), s.io.load(SWIVEL_CAP, 2),
            s.has(kBody) ? s.body.get(kReachRow) : incoming_reach(normalise(s.rows.rotor(kIncomingRow + 4)), goal.arm)};
        s.require(is_valid(goal.cap));
    }
    if (features & SWIVEL_WITH_FLEXION_LIMIT) {
        goal.flexion = {s.io.load(SWIVEL_FLEXION_LIMIT, 0), s.io.load(SWIVEL_FLEXION_LIMIT, 1)};
        s.require(is_valid(goal.flexion));
    }
    return lay_bones(s, [&](const T& wanted) SWIVEL_INLINE_LAMBDA { return place_bones(features, goal, wanted); });
}
template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::bones>, const S& s)
{
    s.rows.set(kFlagsRow, lay_reaching_bones(s, s.features()).flags);
}

template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::capped>, const S& s)
{
    advance(AtStage<Stage::bones>(), s);
}

template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::aim>, const S& s)
{
    using T = typename S::T;
    LimbGoal<T> goal;
    load_lengths(s, goal.arm);
    // Checked as given: a turn's rounding is no fault of the axis.
    const Vector<T> axis = s.io.load_vector(SWIVEL_AIM);
    goal.aim = {in_hand(s, axis), s.io.load(SWIVEL_AIM, 3), s.io.load(SWIVEL_AIM, 4)};
    s.require(is_unit2(len2(axis)) & is_valid(goal.aim));
    if (s.has(SWIVEL_WITH_EFFECTOR)) {
        goal.effector = in_hand(s, s.io.load_vector(SWIVEL_EFFECTOR));
        s.require(len2(goal.effector) <= T(kHuge2));
    }
    const Rotor<T> hand = s.has(SWIVEL_WITH_HAND) ? s.rows.rotor(kHandRow)
                          : s.has(kBody)          ? s.rows.rotor(kIncomingRow + 8)
                                                  : one<T>();
    const swivel_features features = s.features();
    const Laid<T> laid =
        lay_bones(s, [&](const T& wanted) SWIVEL_INLINE_LAMBDA { return aimed_bones(features, goal, hand, wanted); });
    s.rows.set(kFlagsRow, laid.flags);
}

template <class S>
SWIVEL_INLINE void load_continuity(const S& s, Continuity<typename S::T>& continuity)
{
    using T = typename S::T;
    continuity = {s.io.load_vector(SWIVEL_NORMAL), s.io.load_turned(SWIVEL_MAX_SWIVEL)};
    if (!s.has(kBody) || !s.strip.run.strip.pose->time.data) return;
    const T time = s.body.get(kTimeRow);
    s.require(is_within(time, 0, kHuge) & is_valid(continuity));
    continuity.max = timed_step(continuity.max, time);
}

template <class S>
SWIVEL_INLINE void wish_for_normal(const S& s, swivel_features features, const Laid<typename S::T>& laid)
{
    using T = typename S::T;
    WishGoal<T> goal;
    if (has_pole(s)) {
        goal.pole = s.goal_vector(s.has(SWIVEL_WORLD), kPoleRow, SWIVEL_POLE);
        s.require(len2(goal.pole) <= T(kHuge2));
    }
    if (features & SWIVEL_POLE_HAND) goal.hand = s.rows.rotor(kHandRow);
    if (features & SWIVEL_POLE_HALF_LINE) {
        const auto constant = [](const float(&v)[3]) SWIVEL_INLINE_LAMBDA { return vector(T(v[0]), T(v[1]), T(v[2])); };
        goal.behind = constant(s.strip.run.half_line->behind);
        goal.normal = constant(s.strip.run.half_line->normal);
    }
    if (features & SWIVEL_WITH_ANGLE) {
        goal.angle = s.io.load_turned(SWIVEL_ANGLE);
        s.require(is_valid(goal.angle));
    }
    if (features & SWIVEL_WITH_INCOMING) goal.incoming = s.rows.rotor(kIncomingRow);
    if (features & SWIVEL_WITH_WEIGHTS) goal.weight = s.io.load(SWIVEL_WEIGHTS, 2);
    if (features & SWIVEL_WITH_MAX_SWIVEL) {
        load_continuity(s, goal.continuity);
        s.require(is_valid(goal.continuity));
    }
    const LimbNormal<T> found = limb_normal(features, goal, laid.line);
    s.rows.set(kNormalRow, found.normal);
    s.rows.set(kFlagsRow, laid.flags | found.flags);
}
template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::wish>, const S& s)
{
    wish_for_normal(s, s.features(), Laid<typename S::T>{s.rows.vector(kLineRow), s.rows.word(kFlagsRow)});
}

template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::place>, const S& s)
{
    // The formulas ask for no other feature that such limbs can have. The mask makes all others constants.
    const swivel_features features = s.features() & row_of(Stage::place).knows;
    wish_for_normal(s, features, lay_reaching_bones(s, features));
}

}  // namespace swivel::inline SWIVEL_ISA
