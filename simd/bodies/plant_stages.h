// SPDX-License-Identifier: MIT
//
// The stages of limbs that are planted: where their points go, on flat ground and on other, and how they stand then.
#pragma once

#include "core/plant_rotation.h"
#include "simd/bodies/goal_rows.h"

namespace swivel::inline SWIVEL_ISA {

// A planted state in its row, besides its vectors: kBegun plus a bit each.
constexpr float kBegun = 8, kIsWaiting = 4, kIsArmed = 2, kIsLocked = 1;

template <class S>
SWIVEL_INLINE PlantState<typename S::T> load_plant(const S& s)
{
    using T = typename S::T;
    T rest = s.io.load(SWIVEL_PLANT, kPlantState);
    const auto next = [&](float bit) SWIVEL_INLINE_LAMBDA {
        const Mask<T> is_set = rest >= T(bit);
        rest = select(is_set, rest - T(bit), rest);
        return is_set;
    };
    PlantState<T> state;
    state.fresh = !next(kBegun);
    state.waiting = next(kIsWaiting);
    state.armed = next(kIsArmed);
    state.locked = next(kIsLocked);
    state.mark = s.io.load_vector(SWIVEL_PLANT, kPlantMark);
    state.offset = s.io.load_vector(SWIVEL_PLANT, kPlantOffset);
    state.velocity = s.io.load_vector(SWIVEL_PLANT, kPlantVelocity);
    state.left = s.io.load(SWIVEL_PLANT, kPlantLeft);
    return state;
}
template <class S>
SWIVEL_INLINE void hold_back_plant(const S& s, const PlantState<typename S::T>& state)
{
    using T = typename S::T;
    const auto bit = [](const Mask<T>& is_set, float value)
                         SWIVEL_INLINE_LAMBDA { return select(is_set, T(value), T(0)); };
    hold_back(s, SWIVEL_PLANT, kPlantMark, state.mark);
    hold_back(s, SWIVEL_PLANT, kPlantOffset, state.offset);
    hold_back(s, SWIVEL_PLANT, kPlantVelocity, state.velocity);
    hold_back(s, SWIVEL_PLANT, kPlantLeft, state.left);
    hold_back(s, SWIVEL_PLANT, kPlantState,
              T(kBegun) + bit(state.waiting, kIsWaiting) + bit(state.armed, kIsArmed) + bit(state.locked, kIsLocked));
}

// Whether a limb's point is in contact: as it is labelled, or as its motion shows.
template <class S>
SWIVEL_INLINE Mask<typename S::T> in_contact(const S& s, const Mask<typename S::T>& fresh,
                                             const PlantInput<typename S::T>& in, const Vector<typename S::T>& point)
{
    using T = typename S::T;
    if (!s.has(SWIVEL_PLANT_BY_MOTION)) {
        const T contact = s.io.load(SWIVEL_CONTACT, 0);
        s.require(is_share(contact));
        return contact > T(0.5);
    }
    const BodyLimb& limb = s.strip.run.plan->limb;
    MotionState<T> motion{s.io.load_vector(SWIVEL_CONTACT_STATE), s.io.load(SWIVEL_CONTACT_STATE, 3) > T(0.5)};
    const Mask<T> is_in_contact = contact_by_motion(motion, fresh, in, scalar_product(up_of(s), point), limb.plant);
    hold_back(s, SWIVEL_CONTACT_STATE, 0, motion.place);
    hold_back(s, SWIVEL_CONTACT_STATE, 3, select(motion.contact, T(1), T(0)));
    return is_in_contact;
}

// The planted rotation of the hand.
template <class S>
SWIVEL_INLINE Rotor<typename S::T> planted_turn(const S& s, const PlantStep<typename S::T>& step,
                                                const Mask<typename S::T>& locked, const Rotor<typename S::T>& support,
                                                const Rotor<typename S::T>& hand)
{
    using T = typename S::T;
    TurnState<T> turn{s.io.load_rotor(SWIVEL_PLANT_ROTATION, kTurnMark),
                      s.io.load_vector(SWIVEL_PLANT_ROTATION, kTurnOffset),
                      s.io.load_vector(SWIVEL_PLANT_ROTATION, kTurnVelocity)};
    const Rotor<T> planted =
        plant_rotation(turn, step, locked, unit_rotation(~support * hand), s.strip.run.plan->limb.plant);
    hold_back(s, SWIVEL_PLANT_ROTATION, kTurnMark, turn.mark);
    hold_back(s, SWIVEL_PLANT_ROTATION, kTurnOffset, turn.offset);
    hold_back(s, SWIVEL_PLANT_ROTATION, kTurnVelocity, turn.velocity);
    return support * planted;
}

// A limb's point in a step of its plant.
template <class S>
struct PlantedPoint {
    using T = typename S::T;
    const S& s;
    const BodyLimb& limb = s.strip.run.plan->limb;
    SupportFrame<T> support = SupportFrame<T>::of(s);
    AnimatedHand<T> animated = animated_hand(s);
    PlantState<T> state = load_plant(s);
    Planted<T> planted;
    EasedHeight<T> lift;  // on ground that is not flat

    // sees_ground: else it is lifted as in the last step.
    SWIVEL_INLINE PlantedPoint(const S& slice, bool sees_ground) : s(slice)
    {
        s.require(is_posed(s) & is_almost_unit(support.rotation));
        PlantInput<T> in;
        in.time = s.body.get(kTimeRow);
        in.length = T(s.strip.run.plan->rest_length) * s.body.get(kRootJoint + kScaleRow);
        forget_old(state, in.time, limb.plant);
        Vector<T> point = animated.point;
        if (s.has(SWIVEL_WITH_GROUND)) point = point + (sees_ground ? lifted_by_ground() : lifted_so_far());
        in.point = support.from_root(point);
        s.require((len2(in.point) <= T(kHuge2)) & is_within(in.time, 0, kHuge));
        in.label = in_contact(s, state.fresh, in, animated.point);
        planted = plant(state, in, limb.plant);
    }
    SWIVEL_INLINE Vector<T> place() const { return support.to_root(planted.target); }
    SWIVEL_INLINE void lock_to_ground()
    {
        if (!any(planted.step.locks)) return;
        const Vector<T> up = up_of(s);
        const T clearance = T(limb.ground.given.toe_clearance) * s.body.get(limb.parent + kScaleRow);
        lock_on_ground(state, planted.step.locks, support.turned_back(up),
                       ground_of(s, up).way_up(support.to_root(state.mark), clearance));
    }

    SWIVEL_INLINE Spring<Vector<T>> normal() const
    {
        const Vector<T> up = up_of(s);
        return eased_normal(s, ground_of(s, up).slope(up), up, planted.step.fresh, state.locked, limb.ground.lift);
    }

private:
    SWIVEL_INLINE Vector<T> lifted_so_far() const
    {
        const T last_lift = s.io.load(SWIVEL_LIFT, 0);
        const Mask<T> has_begun = (s.io.load(SWIVEL_LIFT, 2) > T(0.5)) & (last_lift == last_lift) & !state.fresh;
        return select(has_begun, last_lift, T(0)) * up_of(s);
    }
    // From the root's level to the ground below the animated point.
    SWIVEL_INLINE Vector<T> lifted_by_ground()
    {
        const Vector<T> up = up_of(s), level = animated.point - scalar_product(up, animated.point) * up;
        lift = eased(s, SWIVEL_LIFT, ground_of(s, up).way_up(level, T(0)), state.fresh, limb.ground.lift);
        return lift.at * up;
    }
};

// Where to sample the ground, whatever was given of it so far. The height does not matter.
template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::probe>, const S& s)
{
    using T = typename S::T;
    const PlantedPoint<S> point(s, false);
    const Vector<T> place = point.place() + s.body.vector(kRootRow);
    s.require(len2(place) <= T(kHuge2));
    s.good_rows().store(SWIVEL_PROBE, 0, place);
}

template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::plant>, const S& s)
{
    using T = typename S::T;
    PlantedPoint<S> point(s, true);
    const Planted<T>& planted = point.planted;
    const Vector<T> place = point.place();
    s.require(len2(place) <= T(kHuge2));
    const Rotor<T> hand =
        s.has(SWIVEL_WITH_PLANT_ROTATION)
            ? planted_turn(s, planted.step, point.state.locked, point.support.rotation, point.animated.rotation)
            : point.animated.rotation;
    if (s.has(SWIVEL_WITH_GROUND)) {
        point.lock_to_ground();
        hold_back(s, SWIVEL_PROBE, 0, place + s.body.vector(kRootRow));
        hold_back(s, SWIVEL_LIFT, 0, point.lift.at);
        hold_back(s, SWIVEL_LIFT, 1, point.lift.rate);
        hold_back(s, SWIVEL_LIFT, 2, T(1));
        const Spring<Vector<T>> normal = point.normal();
        hold_back(s, SWIVEL_LIFT, kSlope, normal.at);
        hold_back(s, SWIVEL_LIFT, kSlopeRate, normal.rate);
    }
    hold_back_plant(s, point.state);
    set_goal(s, place, hand);
    s.body.set(point.limb.goal + kGoalFlagsRow,
               word_where(point.state.locked, SWIVEL_PLANTED) | word_where(planted.step.releases, SWIVEL_RELEASED) |
                   word_where(planted.too_far, SWIVEL_BROKE_AWAY) | word_where(planted.cut, SWIVEL_CUT));
}

template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::ground>, const S& s)
{
    using T = typename S::T;
    const BodyLimb& limb = s.strip.run.plan->limb;
    const GroundRules& rules = limb.ground;
    const Vector<T> up = up_of(s);
    const T scale = s.body.get(limb.parent + kScaleRow), share = s.io.load(SWIVEL_GROUND_WEIGHT, 0);
    const Vector<T> heel = vector(T(rules.given.heel[0]), T(rules.given.heel[1]), T(rules.given.heel[2]));
    const Vector<T> heel_from_toe = scale * (heel - s.io.load_vector(SWIVEL_EFFECTOR));
    s.require(is_share(share) & (len2(heel_from_toe) <= T(kHuge2)));
    const Foot<T> planted{s.body.vector(limb.goal + kGoalPlaceRow), s.body.rotor(limb.goal + kGoalHandRow)};
    const Vector<T> normal = s.body.vector(limb.goal + waiting_row(SWIVEL_LIFT) + kSlope);
    const GroundPlane<T> ground = ground_of(s, up);
    const Foot<T> foot =
        foot_on_ground(ground, ground_plane(ground.place, normal, up), up, planted, heel_from_toe, scale, share, rules);
    set_goal(s, foot.toe, foot.rotation);
}

// Stores what waited. Bad input keeps what is carried, or clears it where limbs go to rest.
template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::commit>, const S& s)
{
    using T = typename S::T;
    const Rows<T, kRuntimeFeatures> out = s.good_rows(),
                                    cleared = s.rows_of(s.strip.run.keeps_pose ? 0 : s.chosen() & ~s.good());
    const float* waiting = s.body.at(s.strip.run.plan->limb.goal + kGoalResultsRow);
    for (const swivel_field field : kWaitingResults) {
        const FieldRow& row = row_of(field);
        const std::size_t size = row.component_count * kLanes;
        if ((s.strip.run.features & row.needs) == row.needs) {
            float* const to = out.results + std::size_t{out.row(field, 0)} * kLanes;
            for (std::size_t at = 0; at < size; at += kLanes) out.store_at(to + at, load_lanes<T>(waiting + at));
            if (cleared.chosen != 0 && row.kind == SWIVEL_FIELD_CARRIED)
                for (std::size_t at = 0; at < size; at += kLanes) cleared.store_at(to + at, T(0));
        }
        waiting += size;
    }
}

}  // namespace swivel::inline SWIVEL_ISA
