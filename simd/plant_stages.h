// SPDX-License-Identifier: MIT
//
// The stages of bodies that run before any limb is solved: where planted points go, how each limb asks the body to
// shift, and the shift.
#pragma once

#include <cstddef>

#include "core/fit.h"
#include "core/limb_bones.h"
#include "core/plant_turn.h"
#include "simd/goal_stages.h"

namespace swivel::inline SWIVEL_ISA {

// A run's lanes of what they write: those of a slice that are good.
template <class S>
SWIVEL_INLINE Rows<typename S::T, kTold> good_rows(const S& s)
{
    Rows<typename S::T, kTold> rows = s.io;
    rows.chosen = s.good() == S::kEvery ? kEveryLane : s.good();
    return rows;
}

// The results of a planted limb that it has before all of its input is known to be good. Their rows lie side by side.
inline constexpr swivel_field kPlantResults[] = {SWIVEL_PLANT, SWIVEL_PLANT_TURN, SWIVEL_MOTION, SWIVEL_GOAL};
static_assert([] {
    std::uint32_t count = 0;
    for (const swivel_field field : kPlantResults) count += row_of(field).component_count;
    return kGoalResultsRow + count == kGoalRows;
}());
// The same rows, where they wait for that.
template <class S>
SWIVEL_INLINE Rows<typename S::T, kTold> waiting_rows(const S& s)
{
    Rows<typename S::T, kTold> rows = s.io;
    const std::ptrdiff_t from = s.strip.run.limb->goal + kGoalResultsRow, first = rows.row(SWIVEL_PLANT, 0);
    rows.results = s.body + (from - first) * std::ptrdiff_t{kLanes};
    return rows;
}

// A body's axis of heights and shifts, in the world.
template <class S>
SWIVEL_INLINE Vector<typename S::T> up_of(const S& s)
{
    using T = typename S::T;
    const float(&up)[3] = s.strip.run.limb->up;
    return turned(s.body_rotor(kRootJoint + kTurnRow), vector(T(up[0]), T(up[1]), T(up[2])));
}

// The frame that planted points are carried in, as the body's root sees it.
template <class T>
struct SupportFrame {
    bool is_turned;  // of no body, if the pose has no rotations of supports
    Rotor<T> rotation;
    Vector<T> root;  // the root's place from the support's, along the world's axes

    template <class S>
    SWIVEL_INLINE static SupportFrame of(const S& s)
    {
        const bool is_turned = s.strip.run.strip.pose->support_rotation.data != nullptr;
        return {is_turned, is_turned ? s.body_rotor(kSupportRow) : one<T>(), s.body_vector(kRootFromSupportRow)};
    }
    SWIVEL_INLINE Vector<T> from_root(const Vector<T>& place) const
    {
        return is_turned ? turned(~rotation, place + root) : place + root;
    }
    SWIVEL_INLINE Vector<T> to_root(const Vector<T>& place) const
    {
        return (is_turned ? turned(rotation, place) : place) - root;
    }
};

// A planted state in its row, besides its vectors: kBegun plus a bit each.
constexpr float kBegun = 8, kIsWaiting = 4, kIsArmed = 2, kIsLocked = 1;
enum PlantNumber : int { kMark, kOffset = 3, kVelocity = 6, kLeft = 9, kState = 10 };
enum TurnNumber : int { kTurnMark, kTurnOffset = 4, kTurnVelocity = 7 };

template <class S>
SWIVEL_INLINE PlantState<typename S::T> load_plant(const S& s)
{
    using T = typename S::T;
    T rest = s.io.load_result(SWIVEL_PLANT, kState);
    const auto next = [&](float bit) SWIVEL_INLINE_LAMBDA {
        const Mask<T> is = rest >= T(bit);
        rest = select(is, rest - T(bit), rest);
        return is;
    };
    PlantState<T> state;
    state.fresh = !next(kBegun);
    state.waiting = next(kIsWaiting);
    state.armed = next(kIsArmed);
    state.locked = next(kIsLocked);
    state.mark = s.io.load_result_vector(SWIVEL_PLANT, kMark);
    state.offset = s.io.load_result_vector(SWIVEL_PLANT, kOffset);
    state.velocity = s.io.load_result_vector(SWIVEL_PLANT, kVelocity);
    state.left = s.io.load_result(SWIVEL_PLANT, kLeft);
    return state;
}
template <class T>
SWIVEL_INLINE void store_plant(const Rows<T, kTold>& out, const PlantState<T>& state)
{
    const auto bit = [](const Mask<T>& is, float value) SWIVEL_INLINE_LAMBDA { return select(is, T(value), T(0)); };
    out.store_vector(SWIVEL_PLANT, state.mark, kMark);
    out.store_vector(SWIVEL_PLANT, state.offset, kOffset);
    out.store_vector(SWIVEL_PLANT, state.velocity, kVelocity);
    out.store(SWIVEL_PLANT, kLeft, state.left);
    out.store(SWIVEL_PLANT, kState,
              T(kBegun) + bit(state.waiting, kIsWaiting) + bit(state.armed, kIsArmed) + bit(state.locked, kIsLocked));
}

// Where a limb's point is as animated, from the root's place, and the hand's rotation. What the caller has written
// counts instead of the pose's.
template <class T>
struct AnimatedHand {
    Vector<T> point;
    Rotor<T> rotation;
};
template <class S>
SWIVEL_INLINE AnimatedHand<typename S::T> animated_hand(const S& s)
{
    using T = typename S::T;
    const BodyLimb& limb = *s.strip.run.limb;
    AnimatedHand<T> is{s.body_vector(limb.wrist + kPlaceRow), s.body_rotor(limb.wrist + kTurnRow)};
    if (s.has(SWIVEL_WITH_EFFECTOR))
        is.point =
            is.point + s.body_row(limb.parent + kScaleRow) * turned(is.rotation, s.io.load_vector(SWIVEL_EFFECTOR));
    const Vector<T> target = s.io.load_vector(SWIVEL_TARGET);
    const T distance2 = len2(target);
    if (const Mask<T> is_given = distance2 == distance2; any(is_given))
        is.point = select(is_given, target - s.body_vector(kRootRow), is.point);
    if (s.has(SWIVEL_WITH_HAND)) {
        const Rotor<T> hand = s.io.load_rotor(SWIVEL_HAND);
        const T length2 = len2(hand);
        if (const Mask<T> is_given = length2 == length2; any(is_given)) {
            s.require(is_orientation(hand) | !is_given);
            is.rotation = select(is_given, normalise(hand), is.rotation);
        }
    }
    return is;
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
    const BodyLimb& limb = *s.strip.run.limb;
    MotionState<T> motion{s.io.load_result_vector(SWIVEL_MOTION, 0), s.io.load_result(SWIVEL_MOTION, 3) > T(0.5)};
    const Mask<T> is = contact_by_motion(motion, fresh, in, scalar_product(up_of(s), point), limb.rules);
    const Rows<T, kTold> out = waiting_rows(s);
    out.store_vector(SWIVEL_MOTION, motion.place);
    out.store(SWIVEL_MOTION, 3, select(motion.contact, T(1), T(0)));
    return is;
}

// The planted rotation of the hand.
template <class S>
SWIVEL_INLINE Rotor<typename S::T> planted_turn(const S& s, const PlantStep<typename S::T>& step,
                                                const Mask<typename S::T>& locked, const Rotor<typename S::T>& support,
                                                const Rotor<typename S::T>& hand)
{
    using T = typename S::T;
    TurnState<T> turn{s.io.load_result_rotor(SWIVEL_PLANT_TURN, kTurnMark),
                      s.io.load_result_vector(SWIVEL_PLANT_TURN, kTurnOffset),
                      s.io.load_result_vector(SWIVEL_PLANT_TURN, kTurnVelocity)};
    const Rotor<T> is = plant_turn(turn, step, locked, unit_rotation(~support * hand), s.strip.run.limb->rules);
    const Rows<T, kTold> out = waiting_rows(s);
    out.store_rotor(SWIVEL_PLANT_TURN, turn.mark, kTurnMark);
    out.store_vector(SWIVEL_PLANT_TURN, turn.offset, kTurnOffset);
    out.store_vector(SWIVEL_PLANT_TURN, turn.velocity, kTurnVelocity);
    return support * is;
}

template <>
struct StageBody<Stage::plant> {
    template <class S>
    SWIVEL_INLINE static void slice(const S& s)
    {
        using T = typename S::T;
        const BodyLimb& limb = *s.strip.run.limb;
        const SupportFrame<T> support = SupportFrame<T>::of(s);
        s.require(is_posed(s) & is_within(len2(support.rotation), 0.99, 1.01));
        const AnimatedHand<T> animated = animated_hand(s);
        PlantState<T> state = load_plant(s);
        PlantInput<T> in;
        in.point = support.from_root(animated.point);
        in.time = s.body_row(kTimeRow);
        in.length = T(limb.rest_length) * s.body_row(kRootJoint + kScaleRow);
        s.require((len2(in.point) <= T(kHuge2)) & is_within(in.time, 0, kHuge));
        forget_old(state, in.time, limb.rules);
        in.label = in_contact(s, state.fresh, in, animated.point);
        const Planted<T> planted = plant(state, in, limb.rules);
        const Vector<T> place = support.to_root(planted.target);
        s.require(len2(place) <= T(kHuge2));
        const Rotor<T> hand = s.has(SWIVEL_WITH_PLANT_TURN)
                                  ? planted_turn(s, planted.step, state.locked, support.rotation, animated.rotation)
                                  : animated.rotation;
        const Rows<T, kTold> out = waiting_rows(s);
        store_plant(out, state);
        // The limb finds bad input here.
        const T nan = T(__builtin_nan(""));
        const Mask<T> valid = lanes_where<T>(s.good());
        s.set_body_vector(limb.goal + kGoalPlaceRow, select(valid, place, vector(nan, nan, nan)));
        s.set_body_rotor(limb.goal + kGoalHandRow, hand);
        s.set_body(limb.goal + kGoalFlagsRow,
                   bits_where(state.locked, SWIVEL_PLANTED) | bits_where(planted.step.releases, SWIVEL_RELEASED) |
                       bits_where(planted.too_far, SWIVEL_BROKE_AWAY) | bits_where(planted.cut, SWIVEL_CUT));
        if (s.has(SWIVEL_WITH_RECORD)) {
            out.store_vector(SWIVEL_GOAL, place + s.body_vector(kRootRow));
            out.store_rotor(SWIVEL_GOAL, hand, 3);
        }
    }
};

// Stores what waited. Bad input keeps what is carried, or clears it where limbs go to rest.
template <>
struct StageBody<Stage::stand> {
    template <class S>
    SWIVEL_INLINE static void slice(const S& s)
    {
        using T = typename S::T;
        const Rows<T, kTold> from = waiting_rows(s), out = good_rows(s);
        Rows<T, kTold> cleared = s.io;
        cleared.chosen = s.strip.run.keeps ? 0 : s.chosen() & ~s.good();
        for (const swivel_field field : kPlantResults) {
            const FieldRow& row = row_of(field);
            if ((s.strip.run.features & row.needs) != row.needs) continue;
            for (int c = 0; c < static_cast<int>(row.component_count); ++c) {
                out.store(field, c, from.load_result(field, c));
                if (cleared.chosen != 0 && row.kind == SWIVEL_FIELD_CARRIED) cleared.store(field, c, T(0));
            }
        }
    }
};

// What a limb that is to fit asks for beside its goal.
template <class S>
struct FitWish {
    using T = typename S::T;
    T weight, time = T(0);
    Vector<T> coming = vector(T(0), T(0), T(0));

    SWIVEL_INLINE explicit FitWish(const S& s) : weight(s.io.load(SWIVEL_FIT_WEIGHT, 0))
    {
        if (!s.has(SWIVEL_WITH_COMING)) return;
        coming = s.io.load_vector(SWIVEL_COMING);
        time = s.io.load(SWIVEL_COMING_TIME, 0);
    }
    SWIVEL_INLINE Mask<T> is_valid() const
    {
        return is_share(weight) & (len2(coming) <= T(kHuge2)) & is_within(time, 0, kHuge);
    }
};

// How a limb asks its body to shift.
template <>
struct StageBody<Stage::span> {
    template <class S>
    SWIVEL_INLINE static void slice(const S& s)
    {
        using T = typename S::T;
        const BodyLimb& limb = *s.strip.run.limb;
        const FitWish<S> wish(s);
        const T scale = s.body_row(limb.parent + kScaleRow);
        const Vector<T> up = up_of(s);
        const Vector<T> shoulder = s.body_vector(limb.shoulder + kPlaceRow), root = s.body_vector(kRootRow);
        const bool is_planted = s.has(SWIVEL_WITH_PLANT);
        const Vector<T> target =
            is_planted ? s.body_vector(limb.goal + kGoalPlaceRow) : s.io.load_vector(SWIVEL_TARGET) - root;
        Vector<T> from_wrist = vector(T(0), T(0), T(0));
        if (s.has(SWIVEL_WITH_EFFECTOR)) {
            const Rotor<T> hand =
                is_planted ? s.body_rotor(limb.goal + kGoalHandRow) : normalise(s.io.load_rotor(SWIVEL_HAND));
            from_wrist = scale * turned(hand, s.io.load_vector(SWIVEL_EFFECTOR));
        }
        const T reach = farthest(s, shoulder, scale);
        const auto asks = [&](const Vector<T>& place, const T& share) SWIVEL_INLINE_LAMBDA {
            return counted(shift_span(shoulder + from_wrist - place, up, reach), share);
        };
        ShiftSpan<T> span{s.body_row(kSpanRow), s.body_row(kSpanRow + 1), s.body_row(kSpanRow + 2) > T(0.5)};
        const T weight = s.has(SWIVEL_WITH_WEIGHTS) ? wish.weight * s.io.load(SWIVEL_WEIGHTS, 0) : wish.weight;
        ShiftSpan<T> is = span & asks(target, weight);
        if (s.has(SWIVEL_WITH_COMING)) {
            const T near = hi(T(1) - wish.time * T(limb.per_ahead), T(0));
            is = is & asks(wish.coming - root, near * near);
        }
        s.require(is_posed(s) & wish.is_valid() & (len2(target) <= T(kHuge2)) & (len2(from_wrist) <= T(kHuge2)));
        const Mask<T> counts = lanes_where<T>(s.good());  // bad input asks for nothing
        s.set_body(kSpanRow, select(counts, is.low, span.low));
        s.set_body(kSpanRow + 1, select(counts, is.high, span.high));
        s.set_body(kSpanRow + 2, select(is.reaches | !counts, s.body_row(kSpanRow + 2), T(0)));
    }

private:
    // How far the wrist gets from the shoulder.
    template <class S>
    SWIVEL_INLINE static typename S::T farthest(const S& s, const Vector<typename S::T>& shoulder,
                                                const typename S::T& scale)
    {
        using T = typename S::T;
        const BodyLimb& limb = *s.strip.run.limb;
        const Vector<T> elbow = s.body_vector(limb.elbow + kPlaceRow), wrist = s.body_vector(limb.wrist + kPlaceRow);
        const auto length = [&](int bone, const Vector<T>& posed) SWIVEL_INLINE_LAMBDA {
            const T given = s.io.load(SWIVEL_LENGTHS, bone);
            s.require(is_length(given) | !(given == given));
            return select(given == given, scale * given, sqrt(len2(posed)));
        };
        const T bones = length(0, elbow - shoulder) + length(1, wrist - elbow);
        if (!s.has(SWIVEL_WITH_CAP)) return bones;
        const Cap<T> cap{s.io.load(SWIVEL_CAP, 0), s.io.load(SWIVEL_CAP, 1), s.io.load(SWIVEL_CAP, 2),
                         sqrt(len2(wrist - shoulder))};
        s.require(is_valid(cap));
        return capped_reach(cap, bones, bones).far;
    }
};

// The body's shift.
template <>
struct StageBody<Stage::fit> {
    template <class S>
    SWIVEL_INLINE static void slice(const S& s)
    {
        using T = typename S::T;
        const BodyLimb& limb = *s.strip.run.limb;
        const T wish = s.io.load(SWIVEL_SHIFT_WISH, 0), time = s.body_row(kTimeRow);
        const Rotor<T> root = s.body_rotor(kRootJoint + kTurnRow);
        const T length = T(limb.rest_length) * s.body_row(kRootJoint + kScaleRow);
        s.require(is_within(wish, -kHuge, kHuge) & is_within(time, 0, kHuge) & is_within(len2(root), 0.99, 1.01) &
                  (len2(s.body_vector(kRootRow)) <= T(kHuge2)) & is_within(length, kTiny, kHuge));
        const ShiftSpan<T> span{s.body_row(kSpanRow), s.body_row(kSpanRow + 1), s.body_row(kSpanRow + 2) > T(0.5)};
        const FittedShift<T> fitted = fitted_shift(span, wish, T(limb.drop) * length, T(limb.rise) * length);
        const Spring<T> was{s.io.load_result(SWIVEL_SHIFT, 0), s.io.load_result(SWIVEL_SHIFT, 1)};
        const Mask<T> is_number = (was.at == was.at) & (was.rate == was.rate), stands = time == T(0),
                      begun = (s.io.load_result(SWIVEL_SHIFT, 2) > T(0.5)) & is_number;
        const Spring<T> next = sprung(was, fitted.shift, time, limb.spring);
        const T at = select(begun, select(stands, was.at, next.at), fitted.shift),
                rate = select(begun, select(stands, was.rate, next.rate), T(0));
        s.require(is_within(at, -kHuge, kHuge) & (rate == rate));

        const Rows<T, kTold> out = good_rows(s);
        out.store(SWIVEL_SHIFT, 0, at);
        out.store(SWIVEL_SHIFT, 1, rate);
        out.store(SWIVEL_SHIFT, 2, T(1));
        Rows<T, kTold> all = s.io, cleared = s.io;
        all.chosen = s.chosen() == S::kEvery ? kEveryLane : s.chosen();
        cleared.chosen = s.strip.run.keeps ? 0 : s.chosen() & ~s.good();
        if (cleared.chosen != 0) cleared.store_vector(SWIVEL_SHIFT, vector(T(0), T(0), T(0)));
        const Mask<T> valid = lanes_where<T>(s.good());
        all.store(
            SWIVEL_FLAGS, 0,
            select(valid,
                   bits_where(fitted.all_reach, SWIVEL_REACHED) | bits_where(!fitted.all_reach, SWIVEL_CLAMPED_FAR),
                   bits<T>(SWIVEL_BAD_INPUT)));
        const Vector<T> shift = select(valid, at, select(begun, was.at, T(0))) * up_of(s);
        s.set_body_vector(kShiftedRow, shift);
        s.set_body_vector(kRootRow, s.body_vector(kRootRow) + shift);
    }
};

}  // namespace swivel::inline SWIVEL_ISA
