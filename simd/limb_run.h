// SPDX-License-Identifier: MIT
//
// A run of whole limbs, step by step. A step takes as long as its slowest limb. With Euler boxes, a search for the
// nearest end takes as long as the rest of the limb, and one for the least violation ten times as long. So limbs that
// need a search are put aside, and solved together.
#pragma once

#include <bit>

#include "core/allowed_arcs.h"
#include "simd/aside.h"
#include "simd/limb_step.h"

namespace swivel::inline SWIVEL_ISA {

// Solves the steps of a run, and calls left(first limb, Waiting) after each. A step has one register. Two were no
// faster, because their values do not stay in registers.
template <class T, FeatureSet Features, bool Aims, class Policy, class Left>
SWIVEL_FLATTEN [[gnu::noinline]] void solve_limb_steps(const SolveRun& run, Left left)
{
    LimbUse use = limb_use<Features>(run);
    use.aim = Aims;  // as it is, but now the compiler knows
    const Binding<T> bind = binding_of<T, Features>(run);
    for (std::size_t limb = 0; limb < run.limb_count; limb += lane_count<T>)
        left(limb, solve_limb_step<Aims, Policy>(use, bind, rows_of<T, Features>(run, limb)));
}
template <class T, FeatureSet Features, bool Aims, class Policy = SearchNow>
void search_limbs(const SolveRun& run)
{
    solve_limb_steps<T, Features, Aims, Policy>(run, [](std::size_t, const Waiting<T>&) SWIVEL_INLINE_LAMBDA {});
}

// Aside, a limb is copied and solved again, which takes about as long as two limbs without a search. The nearest end
// takes about as long as one, so it is put off unless more than a third of the lanes need it. The least violation takes
// as long as ten, and is always put off.
struct SearchForMany {
    static constexpr bool is_short = false;
    template <class M>
    SWIVEL_INLINE static bool is_worth(Search search, const M& lanes)
    {
        return search == Search::nearest_end && 3 * std::popcount(lane_bits(lanes)) > static_cast<int>(lane_count<M>);
    }
};

// A run of limbs with Euler boxes.
template <class T, bool Aims>
struct BoxedLimbs {
    const SolveRun& run;
    LimbsAside for_end, for_least;

    explicit BoxedLimbs(const SolveRun& of) : run(of) {}
    void solve()
    {
        solve_or_put_aside(run, nullptr);
        if (for_end.count > 0) find_ends();
        if (for_least.count > 0) find_least();
    }
    // Lanes that wait for a search are put aside, or added to `waits`, a bit for each.
    void solve_or_put_aside(const SolveRun& steps, std::uint32_t* waits)
    {
        solve_limb_steps<T, kToldFeatures, Aims, SearchForMany>(
            steps, [&](std::size_t first, const Waiting<T>& waiting) SWIVEL_INLINE_LAMBDA {
                if (!any(waiting.lanes)) return;
                if (waits)
                    *waits |= lane_bits(waiting.lanes) << first;
                else
                    put_aside(first, lane_bits(waiting.lanes), waiting.search);
            });
    }
    void put_aside(std::size_t first, std::uint32_t lanes, Search search)
    {
        LimbsAside& aside = search == Search::nearest_end ? for_end : for_least;
        for (; lanes != 0; lanes &= lanes - 1) {
            aside.take(run, first + static_cast<std::size_t>(std::countr_zero(lanes)));
            if (aside.count == kLanes) search == Search::nearest_end ? find_ends() : find_least();
        }
    }
    // All limbs aside need the nearest end, so it is not put off. Those that then wait again need the least violation.
    void find_ends()
    {
        std::uint32_t waits = 0;
        solve_or_put_aside(for_end.block_of(run), &waits);
        waits &= (1u << for_end.count) - 1;
        for_end.give_back(run);
        for (; waits != 0; waits &= waits - 1)
            put_aside(for_end.limb[std::countr_zero(waits)], 1, Search::least_violation);
    }
    void find_least()
    {
        search_limbs<T, kToldFeatures, Aims>(for_least.block_of(run));
        for_least.give_back(run);
    }
};

template <class T, bool Aims>
void solve_told(const SolveRun& run)
{
    if constexpr (1 < lane_count<T>)  // a limb alone keeps no neighbour waiting
        if (run.features & (feature::shoulder_box | feature::wrist_box)) return BoxedLimbs<T, Aims>(run).solve();
    search_limbs<T, kToldFeatures, Aims>(run);
}
template <class T>
void solve_limbs(const SolveRun& run)
{
    const FeatureSet seen = run.features & ~(feature::compact | feature::budget);  // kernels do not see these
    if (seen == kConeAndTwist)
        search_limbs<T, kConeAndTwist, false, ShortSearch>(run);
    else if (run.features & feature::aim)
        solve_told<T, true>(run);
    else
        solve_told<T, false>(run);
}

// The swivels that the limits of one limb of a run allow.
inline AllowedArcs<float> allowed_arcs_of(const SolveRun& run, std::size_t limb)
{
    const LimbUse use = limb_use<kToldFeatures>(run);
    LimbGoal<float> goal;
    const LimbEntry<float> entry =
        load_limb(use, binding_of<float, kToldFeatures>(run), rows_of<float, kToldFeatures>(run, limb), goal);
    if (!entry.valid || !is_valid(use, goal)) return {};
    if (use.aim) return allowed_arcs(swivel_limits(use.limits, goal.limits, place_limb<true>(use, goal).arm).limits);
    return allowed_arcs(swivel_limits(use.limits, goal.limits, place_limb<false>(use, goal).arm).limits);
}

}  // namespace swivel::inline SWIVEL_ISA
