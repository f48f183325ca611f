// SPDX-License-Identifier: MIT
//
// The stage that turns a hand to where the wrist does not get. A foot that is turned so keeps its toe over the ground.
#pragma once

#include "core/yielding_hand.h"
#include "simd/bodies/goal_rows.h"

namespace swivel::inline SWIVEL_ISA {

template <>
struct StageBody<Stage::yield> {
    template <class S>
    SWIVEL_INLINE static void slice(const S& s)
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

private:
    // The foot after the least turn about the ankle that keeps its toe over the ground.
    template <class S>
    SWIVEL_INLINE static Rotor<typename S::T> toe_over_ground(const S& s, const Mask<typename S::T>& misses,
                                                              const Vector<typename S::T>& ankle,
                                                              const Vector<typename S::T>& effector,
                                                              const Rotor<typename S::T>& foot)
    {
        using T = typename S::T;
        const GroundPlane<T> ground = ground_of(s, up_of(s));
        const ArmFrame<T> arm = arm_frame(s);
        const T scale = s.body.get(s.strip.run.plan->limb.parent + kScaleRow),
                height = ground.distance(arm.shoulder + scale * sandwich(arm.rotation, ankle)) / scale,
                wanted = T(s.strip.run.plan->limb.ground.toe_clearance) - height;
        return lifting_turn(ground.exists & misses, sandwich(~arm.rotation, ground.normal), sandwich(foot, effector),
                            wanted) *
               foot;
    }
};

}  // namespace swivel::inline SWIVEL_ISA
