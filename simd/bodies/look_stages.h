// SPDX-License-Identifier: MIT
//
// The stage of a look: a chain of a body's joints turns to a target, and what hangs below it turns along.
#pragma once

#include "core/look.h"
#include "simd/bodies/goal_rows.h"
#include "simd/bodies/joint_stages.h"

namespace swivel::inline SWIVEL_ISA {

// The target of a body's look, and its line of sight as it comes.
template <class S>
struct LookGoal {
    using T = typename S::T;
    const LookRules& rules;
    LineOfSight<T> sight;  // as it comes; places are from the root's
    Vector<T> target;
    T weight, body_weight;
    Mask<T> is_given, is_faded;

    SWIVEL_INLINE explicit LookGoal(const S& s) : rules(s.strip.run.plan->look), body_weight(swivel::body_weight(s))
    {
        const GroupJoints& joints = s.strip.run.plan->joints;
        const std::uint32_t last = joints.turned[joints.turned_count - 1].row;
        const Rotor<T> turn = s.body.rotor(last + kTurnRow);
        const T scale = s.body.get(last + kScaleRow), own_weight = s.io.load(SWIVEL_LOOK_WEIGHT, 0);
        const Vector<T> given = s.io.load_vector(SWIVEL_LOOK_TARGET), root_place = s.body.vector(kRootRow);
        const T given2 = len2(given);
        is_given = given2 == given2;
        s.require(is_share(own_weight) & is_share(body_weight) & ((given2 <= T(kHuge2)) | !is_given) &
                  (len2(root_place) <= T(kHuge2)) & is_within(scale, kTiny, kHuge));
        for (std::uint32_t n = 0; n < joints.turned_count; ++n)
            s.require(is_almost_unit(s.body.rotor(joints.turned[n].row + kTurnRow)) &
                      (len2(s.body.vector(joints.turned[n].row + kPlaceRow)) <= T(kHuge2)));
        const auto constant = [](const float(&v)[3]) SWIVEL_INLINE_LAMBDA { return vector(T(v[0]), T(v[1]), T(v[2])); };
        sight = {s.body.vector(last + kPlaceRow) + turned(turn, scale * constant(rules.eye)),
                 turned(turn, constant(rules.axis))};
        s.require(len2(sight.eye) <= T(kHuge2));
        target = select(is_given, given - root_place, sight.eye + sight.axis);
        const T fade = look_weight(sight, target, rules.fade, scale);
        is_faded = is_given & (fade < T(1));
        weight = select(is_given, own_weight * fade, T(0));
    }
};

// A joint of a look as it turns, and the whole chain.
template <class T>
struct LookedJoint {
    Rotor<T> turn;      // its own, in the world, after the joints before it
    Rotor<T> sum;       // by which it has turned, and all that follows it
    Rotor<T> rotation;  // its own, in the world
    Vector<T> place, came;
};
template <class T>
struct LookChain {
    LookedJoint<T> joint[kMaxLookJoints];
    LineOfSight<T> sight;
    Vector<T> carried[kMaxLookJoints];  // with a rate: quarter_tangent() of turns, in the last joint's incoming frame
    Mask<T> held;                       // by a cone
    Mask<T> is_behind;                  // of its goal, by the rate
};

// Turns the joints of the chain, each in the frame that those before it have turned. turn_of gives the turn of the
// n-th, at its place, after a sum of turns.
template <class S, class TurnOf>
SWIVEL_INLINE void turn_chain(const S& s, const LookGoal<S>& goal, LookChain<typename S::T>& chain,
                              const TurnOf& turn_of)
{
    using T = typename S::T;
    const GroupJoints& joints = s.strip.run.plan->joints;
    Rotor<T> sum = one<T>();
    chain.sight = goal.sight;
    chain.held = no_lanes<T>();
    for (std::uint32_t n = 0; n < joints.turned_count; ++n) {
        LookedJoint<T>& joint = chain.joint[n];
        joint.came = joint.place = s.body.vector(joints.turned[n].row + kPlaceRow);
        if (n > 0) joint.place = chain.joint[n - 1].place + turned(sum, joint.came - chain.joint[n - 1].came);
        const LookTurn<T> turn = turn_of(n, joint.place, sum);
        joint.turn = turn.turn;
        chain.sight = {joint.place + turned(turn.turn, chain.sight.eye - joint.place),
                       turned(turn.turn, chain.sight.axis)};
        chain.held = chain.held | turn.held;
        sum = unit_rotation(turn.turn * sum);
        joint.sum = sum;
        joint.rotation = sum * s.body.rotor(joints.turned[n].row + kTurnRow);
    }
}
// A turn in another frame.
template <class T>
SWIVEL_INLINE Rotor<T> turn_seen_by(const Rotor<T>& frame, const Rotor<T>& turn)
{
    return rotor(turned(frame, vector_part(turn)), turn.template at<kScalar>());
}
template <class S>
SWIVEL_INLINE void limit_rate(const S& s, const LookGoal<S>& goal, LookChain<typename S::T>& chain,
                              Rotor<typename S::T> (&goals)[kMaxLookJoints])
{
    using T = typename S::T;
    const std::uint32_t count = s.strip.run.plan->joints.turned_count;
    const T time = s.body.get(kTimeRow), half = T(0.5f * goal.rules.rate) * time;
    s.require(is_within(time, 0, kHuge));
    Vector<T> carried[kMaxLookJoints];
    Mask<T> has_begun = s.io.load(SWIVEL_LOOK_TURNS, 0) > T(0.5);
    for (std::uint32_t n = 0; n < count; ++n) {
        carried[n] = s.io.load_vector(SWIVEL_LOOK_TURNS, 1 + 3 * static_cast<int>(n));
        has_begun = has_begun & (len2(carried[n]) <= T(1.00001));
    }
    LookWay<T> ways[kMaxLookJoints];
    T sum = T(0);
    for (std::uint32_t n = 0; n < count; ++n) {
        ways[n] = look_way(from_quarter_tangent(carried[n]), goals[n]);
        sum = sum + ways[n].tangent;
    }
    const Mask<T> stands = has_begun & (time == T(0));  // nothing that is carried changes
    chain.is_behind = has_begun & (sum > hi(half, T(kStillTurn))) & (half < T(1.5707963267948966));
    const T part = half / select(chain.is_behind, sum, T(1));
    for (std::uint32_t n = 0; n < count; ++n) {
        const Rotor<T> held = on_way(from_quarter_tangent(carried[n]), ways[n], part);
        goals[n] = select(chain.is_behind, held, goals[n]);
        chain.carried[n] = select(stands, carried[n], quarter_tangent(goals[n]));
    }
}
// Holds the turns back where they would change by more than the rate lets them. All go the same part of their ways, so
// what they add up to turns by no more, either. Then the body's weight takes its part of each.
template <class S>
SWIVEL_INLINE void ease_look(const S& s, const LookGoal<S>& goal, LookChain<typename S::T>& chain)
{
    using T = typename S::T;
    const std::uint32_t count = s.strip.run.plan->joints.turned_count;
    chain.is_behind = no_lanes<T>();
    for (std::uint32_t n = 0; n < count; ++n) chain.carried[n] = vector(T(0), T(0), T(0));
    const bool has_rate = goal.rules.rate > 0;
    if (!has_rate && all(goal.body_weight == T(1))) return;
    const Rotor<T> came = s.body.rotor(s.strip.run.plan->joints.turned[count - 1].row + kTurnRow);
    Rotor<T> goals[kMaxLookJoints];
    for (std::uint32_t n = 0; n < count; ++n)
        goals[n] = turn_seen_by(~(n == 0 ? came : chain.joint[n - 1].sum * came), chain.joint[n].turn);
    if (has_rate) limit_rate(s, goal, chain, goals);
    const Mask<T> is_less = chain.is_behind | (goal.body_weight < T(1));
    if (!any(is_less)) return;
    if (any(goal.body_weight < T(1)))
        for (std::uint32_t n = 0; n < count; ++n) goals[n] = part_of_turn(one<T>(), goals[n], goal.body_weight);
    Rotor<T> aimed[kMaxLookJoints];  // not the whole chain, which would take 9 KiB of stack
    for (std::uint32_t n = 0; n < count; ++n) aimed[n] = chain.joint[n].turn;
    const Mask<T> held = chain.held;
    turn_chain(s, goal, chain, [&](std::uint32_t n, const Vector<T>&, const Rotor<T>& before) SWIVEL_INLINE_LAMBDA {
        const Rotor<T> turn = turn_seen_by(before * came, goals[n]);
        return LookTurn<T>{select(is_less, turn, aimed[n]), held};
    });
}
template <class S>
SWIVEL_INLINE void set_locals(const S& s, const Mask<typename S::T>& valid, const Mask<typename S::T>& kept,
                              const LookChain<typename S::T>& chain)
{
    using T = typename S::T;
    const GroupJoints& joints = s.strip.run.plan->joints;
    for (std::uint32_t n = 0; n < joints.turned_count; ++n) {
        const TurnedJoint& joint = joints.turned[n];
        const bool hangs_on_last = n > 0 && joint.parent == joints.turned[n - 1].row;
        const Rotor<T> parent = hangs_on_last ? chain.joint[n - 1].rotation
                                : n > 0       ? chain.joint[n - 1].sum * s.body.rotor(joint.parent + kTurnRow)
                                              : s.body.rotor(joint.parent + kTurnRow);
        const Rotor<T> local = unit_rotation(~parent * chain.joint[n].rotation);
        set_local(s, joint.row, local, local, valid, kept);
    }
}
// How the joints move in the body's space, from the pose as it came: after the looks above.
template <class S>
SWIVEL_INLINE void set_motions(const S& s, const Mask<typename S::T>& kept, const LookChain<typename S::T>& chain)
{
    using T = typename S::T;
    const GroupJoints& joints = s.strip.run.plan->joints;
    const Rotor<T> root = s.body.rotor(kRootJoint + kTurnRow);
    const T shrink = T(1) / s.body.get(kRootJoint + kScaleRow);
    const bool has_above = joints.above != 0;
    const Rotor<T> above = has_above ? s.body.rotor(joints.above + kMotionRow) : one<T>();
    const Vector<T> above_shift = has_above ? s.body.vector(joints.above + kShiftRow) : vector(T(0), T(0), T(0));
    for (std::uint32_t n = 0; n < joints.turned_count; ++n) {
        const LookedJoint<T>& joint = chain.joint[n];
        const Rotor<T> turn = hemisphere(unit_rotation(~root * joint.sum * root));
        const auto in_body = [&](const Vector<T>& place) SWIVEL_INLINE_LAMBDA { return turned(~root, shrink * place); };
        const Vector<T> shift = in_body(joint.place) - turned(turn, in_body(joint.came));
        const std::uint32_t row = joints.turned[n].row;
        s.body.set(row + kMotionRow, select(kept, above, has_above ? turn * above : turn));
        s.body.set(row + kShiftRow, select(kept, above_shift, has_above ? turned(turn, above_shift) + shift : shift));
    }
}
template <class S>
SWIVEL_INLINE void set_joint_frame(const S& s, std::uint32_t row, const Mask<typename S::T>& kept,
                                   const Rotor<typename S::T>& rotation, const Vector<typename S::T>& place)
{
    s.body.set(row + kTurnRow, select(kept, s.body.rotor(row + kTurnRow), rotation));
    s.body.set(row + kPlaceRow, select(kept, s.body.vector(row + kPlaceRow), place));
}
template <class S>
SWIVEL_INLINE void store_look(const S& s, const LookGoal<S>& goal, const LookChain<typename S::T>& chain)
{
    using T = typename S::T;
    const Rows<T, kRuntimeFeatures> out = s.good_rows();
    out.store(SWIVEL_SIGHT, 0, chain.sight.eye + s.body.vector(kRootRow));
    out.store(SWIVEL_SIGHT, 3, chain.sight.axis);
    const std::uint32_t count = s.strip.run.plan->joints.turned_count;
    out.store(SWIVEL_LOOK_TURNS, 0, T(1));
    for (std::uint32_t n = 0; n < count; ++n)
        out.store(SWIVEL_LOOK_TURNS, 1 + 3 * static_cast<int>(n), chain.carried[n]);
    const Mask<T> meets =
        goal.is_given & sees(chain.sight, s.io.load_vector(SWIVEL_LOOK_TARGET) - s.body.vector(kRootRow));
    s.store_flags(word_where(meets, SWIVEL_REACHED) |
                  word_where(chain.held & (goal.weight > T(0)), SWIVEL_LIMITED_LOOK) |
                  word_where(chain.is_behind, SWIVEL_LIMITED_STEP) | word_where(goal.is_faded, SWIVEL_FADED));
}

template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::look>, const S& s)
{
    using T = typename S::T;
    const GroupJoints& joints = s.strip.run.plan->joints;
    const LookGoal<S> goal(s);
    LookChain<T> chain;
    turn_chain(s, goal, chain, [&](std::uint32_t n, const Vector<T>& place, const Rotor<T>&) SWIVEL_INLINE_LAMBDA {
        const LookJoint& joint = goal.rules.joint[n];
        return n + 1 < joints.turned_count ? share_of_look(chain.sight, goal.target, goal.weight, joint)
                                           : rest_of_look(chain.sight, place, goal.target, goal.weight, joint);
    });
    ease_look(s, goal, chain);
    const Mask<T> valid = lanes_where<T>(s.good()), turns = (goal.weight > T(0)) | chain.is_behind,
                  kept = !(turns & valid & (goal.body_weight > T(0)));
    set_locals(s, valid, kept, chain);
    if (s.strip.run.strip.pose->space == SWIVEL_IN_BODY) set_motions(s, kept, chain);
    for (std::uint32_t n = 0; n < joints.following_count; ++n) {
        const FollowingJoint& joint = joints.following[n];
        const LookedJoint<T>& with = chain.joint[joint.number];
        const Rotor<T> rotation = s.body.rotor(joint.row + kTurnRow);
        const Vector<T> came = s.body.vector(joint.row + kPlaceRow);
        set_joint_frame(s, joint.row, kept, with.sum * rotation, with.place + turned(with.sum, came - with.came));
    }
    for (std::uint32_t n = 0; n < joints.turned_count; ++n)
        set_joint_frame(s, joints.turned[n].row, kept, chain.joint[n].rotation, chain.joint[n].place);
    store_look(s, goal, chain);
}

}  // namespace swivel::inline SWIVEL_ISA
