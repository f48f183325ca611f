// SPDX-License-Identifier: MIT
//
// The stages that shift a body so that its limbs reach: what each limb asks for, and the shift.
#pragma once

#include "core/fit.h"
#include "simd/bodies/goal_rows.h"

namespace swivel::inline SWIVEL_ISA {

// A limb that is to fit asks for this beside its goal.
template <class S>
struct FitWish {
    using T = typename S::T;
    T weight, time = T(0);
    Vector<T> next_target = vector(T(0), T(0), T(0));

    SWIVEL_INLINE explicit FitWish(const S& s) : weight(s.io.load(SWIVEL_PELVIS_FIT_WEIGHT, 0))
    {
        if (!s.has(SWIVEL_WITH_NEXT_TARGET)) return;
        next_target = s.io.load_vector(SWIVEL_NEXT_TARGET);
        time = s.io.load(SWIVEL_NEXT_TIME, 0);
    }
    SWIVEL_INLINE Mask<T> is_valid() const
    {
        return is_share(weight) & (len2(next_target) <= T(kHuge2)) & is_within(time, 0, kHuge);
    }
};

// How a limb asks its body to shift.
template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::span>, const S& s)
{
    using T = typename S::T;
    const BodyLimb& limb = s.strip.run.plan->limb;
    const FitWish<S> wish(s);
    const T scale = s.body.get(limb.parent + kScaleRow);
    const Vector<T> up = up_of(s);
    const Vector<T> shoulder = s.body.vector(limb.shoulder + kPlaceRow), root = s.body.vector(kRootRow);
    const bool is_planted = s.has(SWIVEL_WITH_PLANT);
    const Vector<T> target =
        is_planted ? s.body.vector(limb.goal + kGoalPlaceRow) : s.io.load_vector(SWIVEL_TARGET) - root;
    Vector<T> from_wrist = vector(T(0), T(0), T(0));
    if (s.has(SWIVEL_WITH_EFFECTOR)) {
        const Rotor<T> hand = is_planted ? s.body.rotor(limb.goal + kGoalHandRow) : normalise(wanted_hand(s).rotation);
        from_wrist = scale * turned(hand, s.io.load_vector(SWIVEL_EFFECTOR));
    }
    const T reach = limb_reach(s).far;
    const auto asks = [&](const Vector<T>& place, const T& share) SWIVEL_INLINE_LAMBDA {
        return counted(shift_span(shoulder + from_wrist - place, up, reach), share);
    };
    ShiftSpan<T> span{s.body.get(kSpanRow), s.body.get(kSpanRow + 1), s.body.get(kSpanRow + 2) > T(0.5)};
    const T weight = s.has(SWIVEL_WITH_WEIGHTS) ? wish.weight * s.io.load(SWIVEL_WEIGHTS, 0) : wish.weight;
    ShiftSpan<T> asked = span & asks(target, weight);
    if (s.has(SWIVEL_WITH_NEXT_TARGET)) {
        const T near = hi(T(1) - wish.time * T(limb.per_ahead), T(0));
        asked = asked & asks(wish.next_target - root, near * near);
    }
    s.require(is_posed(s) & wish.is_valid() & (len2(target) <= T(kHuge2)) & (len2(from_wrist) <= T(kHuge2)));
    const Mask<T> counts = lanes_where<T>(s.good());  // bad input asks for nothing
    s.body.set(kSpanRow, select(counts, asked.low, span.low));
    s.body.set(kSpanRow + 1, select(counts, asked.high, span.high));
    s.body.set(kSpanRow + 2, select(asked.reaches | !counts, s.body.get(kSpanRow + 2), T(0)));
}

// The body's shift.
template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::fit>, const S& s)
{
    using T = typename S::T;
    const ShiftPlan& shift = s.strip.run.plan->shift;
    const T wish = s.io.load(SWIVEL_SHIFT_WISH, 0), time = s.body.get(kTimeRow);
    const Rotor<T> root = s.body.rotor(kRootJoint + kTurnRow);
    const T length = T(s.strip.run.plan->rest_length) * s.body.get(kRootJoint + kScaleRow);
    s.require(is_within(wish, -kHuge, kHuge) & is_within(time, 0, kHuge) & is_almost_unit(root) &
              (len2(s.body.vector(kRootRow)) <= T(kHuge2)) & is_within(length, kTiny, kHuge));
    const ShiftSpan<T> span{s.body.get(kSpanRow), s.body.get(kSpanRow + 1), s.body.get(kSpanRow + 2) > T(0.5)};
    const FittedShift<T> fitted = fitted_shift(span, wish, T(shift.drop) * length, T(shift.rise) * length);
    const EasedHeight<T> eased_shift = eased(s, SWIVEL_SHIFT, fitted.shift, no_lanes<T>(), shift.spring);
    s.good_rows().store(SWIVEL_SHIFT, 0, vector(eased_shift.at, eased_shift.rate, T(1)));
    s.store_flags(word_where(fitted.all_reach, SWIVEL_REACHED) | word_where(!fitted.all_reach, SWIVEL_CLAMPED_FAR));
    const Mask<T> valid = lanes_where<T>(s.good());
    const Vector<T> shifted = select(valid, eased_shift.at, eased_shift.before) * up_of(s);
    s.body.set(kShiftedRow, shifted);
    s.body.set(kRootRow, s.body.vector(kRootRow) + shifted);
}

}  // namespace swivel::inline SWIVEL_ISA
