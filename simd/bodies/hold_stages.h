// SPDX-License-Identifier: MIT
//
// The stages of limbs that hold something: where each hand has a prop, where the prop goes, the goal of a hand on it or
// on another limb's hand, and where a hand is once its limb is solved.
#pragma once

#include "core/plant.h"
#include "core/prop.h"
#include "simd/bodies/goal_rows.h"

namespace swivel::inline SWIVEL_ISA {

// A limb's grip, with a rotation of unit length.
template <class S>
SWIVEL_INLINE HeldFrame<typename S::T> grip_of(const S& s)
{
    using T = typename S::T;
    const Vector<T> place = s.io.load_vector(SWIVEL_GRIP);
    const Rotor<T> rotation = s.io.load_rotor(SWIVEL_GRIP, 3);
    s.require((len2(place) <= T(kHuge2)) & is_orientation(rotation));
    return {normalise(rotation), place};
}

// Frames in the rows of a body.
template <class S>
SWIVEL_INLINE HeldFrame<typename S::T> get_held(const S& s, std::uint32_t row)
{
    return {s.body.rotor(row + kHeldTurnRow), s.body.vector(row + kHeldPlaceRow)};
}
template <class S>
SWIVEL_INLINE void set_held(const S& s, std::uint32_t row, const HeldFrame<typename S::T>& frame)
{
    s.body.set(row + kHeldTurnRow, frame.rotation);
    s.body.set(row + kHeldPlaceRow, frame.place);
}
static_assert(std::uint32_t{kHolderTurnRow} == kHeldTurnRow && std::uint32_t{kHolderPlaceRow} == kHeldPlaceRow);

template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::grasp>, const S& s)
{
    using T = typename S::T;
    const BodyLimb& limb = s.strip.run.plan->limb;
    if (!limb.link.is_prop) return;
    const AnimatedHand<T> animated = animated_hand(s);
    const HeldFrame<T> grip = grip_of(s);
    const LimbReach<T> reach = limb_reach(s);
    Vector<T> wrist = grip.place;
    if (s.has(SWIVEL_WITH_EFFECTOR))
        wrist = wrist - s.body.get(limb.parent + kScaleRow) * turned(grip.rotation, s.io.load_vector(SWIVEL_EFFECTOR));
    const HeldFrame<T> prop = held_by({animated.rotation, animated.point}, grip);
    s.require(is_posed(s) & (len2(prop.place) <= T(kHuge2)) & (len2(wrist) <= T(kHuge2)));
    set_held(s, limb.link.holder, {prop.rotation, or_nan(lanes_where<T>(s.good()), prop.place)});
    s.body.set(limb.link.holder + kHolderWristRow, wrist);
    s.body.set(limb.link.holder + kHolderShoulderRow, s.body.vector(limb.shoulder + kPlaceRow));
    // A hand that does not hold, by its weight, asks for nothing.
    T far = reach.exact, near = reach.near;
    if (s.has(SWIVEL_WITH_WEIGHTS)) {
        const Mask<T> asks_nothing = s.io.load(SWIVEL_WEIGHTS, 0) == T(0);
        far = select(asks_nothing, T(kHuge), far);
        near = select(asks_nothing, T(0), near);
    }
    s.body.set(limb.link.holder + kHolderReachRow, far);
    s.body.set(limb.link.holder + kHolderNearRow, near);
    // A hand that is written goes on as it is, of any length, as it would if the limb held nothing.
    set_goal(s, animated.point, wanted_hand(s).rotation);
    const T lengths = s.io.load(SWIVEL_LENGTHS, 0) + s.io.load(SWIVEL_LENGTHS, 1);  // NaN: the pose's
    s.body.set(limb.goal + kGoalOwnRow, select(animated.is_posed & !(lengths == lengths), T(1), T(0)));
}

// A prop, as its holders and the caller have it.
template <class S>
struct PropAtHand {
    using T = typename S::T;
    const S& s;
    const PropPlan& prop = s.strip.run.plan->prop;
    HeldFrame<T> frame;
    Mask<T> is_of_hands;  // the caller says nothing of it
    T share;

    // told: where the caller or the joint has it, which counts by the prop's weight.
    SWIVEL_INLINE void weigh(const HeldFrame<T>& hands, const HeldFrame<T>& told)
    {
        const T weight = s.io.load(SWIVEL_PROP_WEIGHT, 0);
        s.require(is_share(weight));
        is_of_hands = is_of_hands | (weight == T(0));
        frame = between(hands, told, select(is_of_hands, T(0), weight));
    }
    SWIVEL_INLINE explicit PropAtHand(const S& slice)
        : s(slice), is_of_hands(T(prop.joint) == T(0)), share(s.io.load(SWIVEL_HAND_BLEND, 0))
    {
        s.require(is_share(share));
        if (prop.holder_count == 1) share = T(0);
        const HeldFrame<T> hands = between(get_held(s, holder(0)), get_held(s, holder(prop.holder_count - 1)), share);
        const Rotor<T> turn = s.io.load_rotor(SWIVEL_PROP_ROTATION);
        const Vector<T> at = s.io.load_vector(SWIVEL_PROP_POSITION);
        const T turn2 = len2(turn), at2 = len2(at);
        const Mask<T> has_turn = turn2 == turn2, has_place = at2 == at2;
        s.require((is_orientation(turn) | !has_turn) & ((at2 <= T(kHuge2)) | !has_place));
        const Rotor<T> unit = normalise(select(has_turn, turn, one<T>()));
        if (prop.joint != 0) {
            const Rotor<T> rotation = s.body.rotor(prop.joint + kTurnRow);
            const Vector<T> given = select(has_place, at, vector(T(0), T(0), T(0)));
            weigh(hands,
                  {unit_rotation(rotation * unit), s.body.vector(prop.joint + kPlaceRow) + turned(rotation, given)});
            return;
        }
        is_of_hands = !(has_turn | has_place);
        weigh(hands,
              {select(has_turn, unit, hands.rotation), select(has_place, at - s.body.vector(kRootRow), hands.place)});
    }
    SWIVEL_INLINE std::uint32_t holder(std::uint32_t n) const { return prop.frame + kHoldersRow + n * kHolderRows; }
    // The moves by which a holder's arm reaches; all of them where that is bad input.
    SWIVEL_INLINE ReachingMoves<T> reaching(std::uint32_t n) const
    {
        const std::uint32_t at = holder(n);
        const Vector<T> wrist = frame.place + turned(frame.rotation, s.body.vector(at + kHolderWristRow)),
                        middle = s.body.vector(at + kHolderShoulderRow) - wrist,
                        place = s.body.vector(at + kHolderPlaceRow);
        const Mask<T> is_good = len2(place) <= T(kHuge2);
        return {select(is_good, middle, vector(T(0), T(0), T(0))),
                select(is_good, s.body.get(at + kHolderReachRow), T(kHuge))};
    }
    // Whether a holder's grip is nearer to its shoulder than its arm gets.
    SWIVEL_INLINE Mask<T> is_too_near(std::uint32_t n) const
    {
        const std::uint32_t at = holder(n);
        const T length2 = len2(reaching(n).middle),
                near = s.body.get(at + kHolderNearRow) - T(kReachSlack) * sqrt(length2);
        return (len2(s.body.vector(at + kHolderPlaceRow)) <= T(kHuge2)) & (near > T(0)) & (length2 < near * near);
    }
};

template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::prop>, const S& s)
{
    using T = typename S::T;
    const PropPlan& prop = s.strip.run.plan->prop;
    PropAtHand<S> held(s);
    const ReachingMoves<T> a = held.reaching(0), b = held.reaching(prop.holder_count - 1);
    // So much less that what rounds still reaches, of a far move and of the shorter arm, too.
    const T size = lo(a.reach, b.reach) + sqrt(len2(a.middle)) + sqrt(len2(b.middle));
    const auto within = [&](const ReachingMoves<T>& moves) SWIVEL_INLINE_LAMBDA {
        return ReachingMoves<T>{moves.middle, hi(moves.reach - T(2 * kReachSlack) * size, T(0))};
    };
    const T max = T(prop.max_move) * T(s.strip.run.plan->rest_length) * s.body.get(kRootJoint + kScaleRow);
    Mask<T> is_longer = no_lanes<T>();
    const Vector<T> none = vector(T(0), T(0), T(0));
    const Mask<T> rests = a.has(none) & b.has(none);
    const Vector<T> move =
        all(rests) ? none : select(rests, none, at_most(min_move(within(a), within(b)), max, !rests, is_longer));
    held.frame.place = held.frame.place + move;
    const Mask<T> is_far = !(rests | (a.has(move) & b.has(move))),
                  is_near = (!is_far) & (held.is_too_near(0) | held.is_too_near(prop.holder_count - 1)),
                  stays = !(len2(move) > T(0));
    s.require((len2(held.frame.place) <= T(kHuge2)) & is_almost_unit(held.frame.rotation) &
              (len2(s.body.vector(kRootRow)) <= T(kHuge2)));
    set_held(s, prop.frame, {held.frame.rotation, or_nan(lanes_where<T>(s.good()), held.frame.place)});
    s.body.set(prop.frame + kHeldScaleRow, T(1));
    const Mask<T> says = held.is_of_hands & stays;
    s.body.set(prop.frame + kLeadHandRow,
               select(says & (held.share == T(0)), T(0), select(says & (held.share == T(1)), T(1), T(-1))));

    const Rows<T, kRuntimeFeatures> out = s.good_rows();
    out.store(SWIVEL_PROP_TRANSFORM, 0, held.frame.place + s.body.vector(kRootRow));
    out.store(SWIVEL_PROP_TRANSFORM, 3, hemisphere(held.frame.rotation));
    s.store_flags(word_where(!(is_far | is_near), SWIVEL_REACHED) | word_where(is_far, SWIVEL_CLAMPED_FAR) |
                  word_where(is_near, SWIVEL_CLAMPED_NEAR));
}

template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::link>, const S& s)
{
    using T = typename S::T;
    const BodyLimb& limb = s.strip.run.plan->limb;
    HeldFrame<T> goal = gripped(get_held(s, limb.link.row), grip_of(s), s.body.get(limb.link.row + kHeldScaleRow));
    T own = T(0);
    if (limb.link.is_prop) {
        const Mask<T> says = s.body.get(limb.link.row + kLeadHandRow) == T(limb.link.number);
        goal = {select(says, s.body.rotor(limb.goal + kGoalHandRow), goal.rotation),
                select(says, s.body.vector(limb.goal + kGoalPlaceRow), goal.place)};
        own = select(says, s.body.get(limb.goal + kGoalOwnRow), T(0));
    }
    s.body.set(limb.goal + kGoalOwnRow, own);
    s.body.set(limb.goal + kGoalFlagsRow, word<T>(0));
    set_goal(s, goal.place, goal.rotation);
}

// By the arm's own forward kinematics. A limb that keeps its pose has its hand where it came.
template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::hand_transform>, const S& s)
{
    using T = typename S::T;
    const BodyLimb& limb = s.strip.run.plan->limb;
    const ArmFrame<T> arm = arm_frame(s);
    const T scale = s.body.get(limb.parent + kScaleRow),
            stretch = s.has(SWIVEL_WITH_REACH) ? s.io.load(SWIVEL_STRETCH, 0) : T(1);
    const Rotor<T> upper = unit_rotation(arm.rotation * s.io.load_rotor(SWIVEL_SHOULDER)),
                   fore = unit_rotation(upper * hinge(s.io.load(SWIVEL_ELBOW, 0), -s.io.load(SWIVEL_ELBOW, 1)));
    const auto bone = [&](const Rotor<T>& frame, std::uint32_t n) SWIVEL_INLINE_LAMBDA {
        return turned(frame, vector(T(0), T(0), s.body.get(kLengthsRow + n)));
    };
    const HeldFrame<T> solved{unit_rotation(fore * s.rows.rotor(kTwistRow) * broadcast<T>(s.strip.bind.hand_from_arm)),
                              arm.shoulder + (scale * stretch) * (bone(upper, 0) + bone(fore, 1))};
    const Mask<T> kept = s.body.get(kKeptRow) > T(0.5), valid = lanes_where<T>(s.good()) | kept;
    const T nan = T(__builtin_nan(""));
    const Vector<T> place = select(kept, s.body.vector(limb.wrist + kPlaceRow), solved.place);
    const Rotor<T> turn = select(kept, s.body.rotor(limb.wrist + kTurnRow), solved.rotation);
    const Mask<T> is_known =
        valid & (len2(place) <= T(kHuge2)) & is_almost_unit(turn) & (len2(s.body.vector(kRootRow)) <= T(kHuge2));
    const HeldFrame<T> hand{select(is_known, turn, rotor(nan, nan, nan, nan)), or_nan(is_known, place)};
    set_held(s, limb.hand_frame, hand);
    s.body.set(limb.hand_frame + kHeldScaleRow, scale);
    const Rows<T, kRuntimeFeatures> out = s.chosen_rows();
    out.store(SWIVEL_HAND_TRANSFORM, 0, with_one_nan(hand.place + s.body.vector(kRootRow)));
    out.store(SWIVEL_HAND_TRANSFORM, 3, with_one_nan(hemisphere(hand.rotation)));
}

}  // namespace swivel::inline SWIVEL_ISA
