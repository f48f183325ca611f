// SPDX-License-Identifier: MIT
//
// A run of whole limbs, step by step. A step takes as long as its slowest limb. Finding the least violation of Euler
// boxes takes five to ten times as long as the rest. So limbs that need it are put aside, and solved together.
#pragma once

#include <bit>

#include "core/allowed_arcs.h"
#include "simd/aside.h"
#include "simd/limb_step.h"

namespace swivel::inline SWIVEL_ISA {

// Solves the steps of a run, and calls settled(first limb, mask) after each. A step has one register. Two were no
// faster, because their values do not stay in registers.
template <class T, FeatureSet Features, bool Aims, bool Searches, class Settled>
SWIVEL_FLATTEN [[gnu::noinline]] void solve_limb_steps(const SolveRun& run, Settled settled)
{
    LimbUse use = limb_use<Features>(run);
    use.aim = Aims;  // as it is, but now the compiler knows
    const LimbBinding<T> bind = limb_binding<T, Features>(run);
    for (std::size_t limb = 0; limb < run.limb_count; limb += lane_count<T>)
        settled(limb, solve_limb_step<Aims, Searches>(use, bind, rows_of<T, Features>(run, limb)));
}

template <class T, FeatureSet Features, bool Aims>
void search_limbs(const SolveRun& run)
{
    solve_limb_steps<T, Features, Aims, true>(run, [](std::size_t, const Mask<T>&) SWIVEL_INLINE_LAMBDA {});
}

template <class T, bool Aims>
[[gnu::noinline]] void search_aside(const SolveRun& run, LimbsAside& aside)
{
    search_limbs<T, kToldFeatures, Aims>(aside.block_of(run));
    aside.give_back(run);
}

template <class T, bool Aims>
void solve_limbs(const SolveRun& run)
{
    if constexpr (lane_count<T> == 1) {  // no neighbour has to wait
        search_limbs<T, kToldFeatures, Aims>(run);
    } else if (!(run.features & (feature::shoulder_box | feature::wrist_box))) {  // a short search
        search_limbs<T, kToldFeatures, Aims>(run);
    } else {
        LimbsAside aside;
        solve_limb_steps<T, kToldFeatures, Aims, false>(
            run, [&](std::size_t first, const Mask<T>& settled) SWIVEL_INLINE_LAMBDA {
                if (all(settled)) return;
                for (std::uint32_t waits = lane_bits(!settled); waits != 0; waits &= waits - 1) {
                    aside.take(run, first + static_cast<std::size_t>(std::countr_zero(waits)));
                    if (aside.count == kLanes) search_aside<T, Aims>(run, aside);
                }
            });
        if (aside.count > 0) search_aside<T, Aims>(run, aside);
    }
}
template <class T>
void solve_limbs(const SolveRun& run)
{
    const FeatureSet seen = run.features & ~(feature::compact | feature::budget);  // kernels do not see these
    if (seen == kConeAndTwist)
        search_limbs<T, kConeAndTwist, false>(run);
    else if (run.features & feature::aim)
        solve_limbs<T, true>(run);
    else
        solve_limbs<T, false>(run);
}

// The swivels that the limits of one limb of a run allow.
inline AllowedArcs<float> allowed_arcs_of(const SolveRun& run, std::size_t limb)
{
    const LimbUse use = limb_use<kToldFeatures>(run);
    LimbGoal<float> goal;
    const LimbEntry<float> entry =
        load_limb(use, limb_binding<float, kToldFeatures>(run), rows_of<float, kToldFeatures>(run, limb), goal);
    if (!entry.valid || !is_valid(use, goal)) return {};
    if (use.aim) return allowed_arcs(swivel_limits(use.limits, goal.limits, place_limb<true>(use, goal).arm).limits);
    return allowed_arcs(swivel_limits(use.limits, goal.limits, place_limb<false>(use, goal).arm).limits);
}

}  // namespace swivel::inline SWIVEL_ISA
