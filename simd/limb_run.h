// SPDX-License-Identifier: MIT
//
// A run of whole limbs, slice by slice. A slice takes as long as its slowest limb. With Euler boxes, a search for the
// nearest end takes as long as the rest of the limb, and one for the least violation ten times as long. So limbs that
// need a search are put aside, and solved together.
#pragma once

#include <bit>

#include "core/allowed_arcs.h"
#include "simd/aside.h"
#include "simd/limb_slice.h"

namespace swivel::inline SWIVEL_ISA {

// Solves the slices of a run from a limb on, and calls left(first limb, Waiting) after each, until that returns true.
// Returns the first limb that is left. A slice has one register. Two were no faster, because their values do not stay
// in registers.
template <class T, swivel_features Features, bool Aims, class Policy, class Left>
SWIVEL_FLATTEN [[gnu::noinline]] std::size_t solve_limb_slices(const SolveRun& run, std::size_t limb, Left left)
{
    LimbUse use = limb_use<Features>(run);
    use.aim = Aims;  // as it is, but now the compiler knows
    const Binding bind = binding_of<Features>(run);
    bool is_enough = false;
    for (; limb < run.limb_count && !is_enough; limb += lane_count<T>)
        if (const std::uint32_t chosen = chosen_lanes(run, limb, lane_count<T>))
            is_enough =
                left(limb, solve_limb_slice<Aims, Policy>(use, bind, slice_rows<T, Features>(run, limb, chosen)));
    return limb;
}
template <class T, swivel_features Features, bool Aims, class Policy = SearchNow>
void search_limbs(const SolveRun& run)
{
    solve_limb_slices<T, Features, Aims, Policy>(
        run, 0, [](std::size_t, const Waiting&) SWIVEL_INLINE_LAMBDA { return false; });
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

// Puts the lanes of a slice that wait on the list of their search. True: that list is full.
struct WaitingLists {
    WaitingLimbs for_end, for_least;

    SWIVEL_INLINE bool put(std::size_t first, const Waiting& waiting)
    {
        if (waiting.lanes == 0) return false;
        WaitingLimbs& list = waiting.search == Search::nearest_end ? for_end : for_least;
        list.add(first, waiting.lanes);
        return list.is_full();
    }
};

// A run of limbs with Euler boxes.
template <class T, bool Aims>
struct BoxedLimbs {
    const SolveRun& run;
    WaitingLists waiting = {};
    BlockAside<kEveryFeature> aside;

    explicit BoxedLimbs(const SolveRun& of) : run(of) {}
    void solve()
    {
        for (std::size_t limb = 0; limb < run.limb_count;) {
            limb = solve_until_full(run, limb, waiting);
            if (waiting.for_end.is_full()) find_ends();
            if (waiting.for_least.is_full()) find_least();
        }
        if (waiting.for_end.count > 0) find_ends();
        while (waiting.for_least.count > 0) find_least();
    }
    static std::size_t solve_until_full(const SolveRun& slices, std::size_t limb, WaitingLists& lists)
    {
        return solve_limb_slices<T, kToldFeatures, Aims, SearchForMany>(
            slices, limb, [&lists](std::size_t first, const Waiting& of_slice) SWIVEL_INLINE_LAMBDA {
                return lists.put(first, of_slice);
            });
    }
    // All limbs aside need the nearest end, so it is not put off. Those that then wait again need the least violation.
    void find_ends()
    {
        WaitingLists again;  // lanes of the block aside
        solve_until_full(aside.gather(run, waiting.for_end), 0, again);
        aside.give_back(run, waiting.for_end);
        for (std::uint32_t n = 0; n < again.for_least.count; ++n)
            if (const std::uint32_t lane = again.for_least.limb[n]; lane < waiting.for_end.first_count())
                waiting.for_least.add(waiting.for_end.limb[lane], 1);
        waiting.for_end.drop_first();
    }
    void find_least()
    {
        search_limbs<T, kToldFeatures, Aims>(aside.gather(run, waiting.for_least));
        aside.give_back(run, waiting.for_least);
        waiting.for_least.drop_first();
    }
};

// Boxed: the number type for limbs with Euler boxes. A block alone searches at once: there is no other limb to wait
// for.
template <class T, class Boxed, bool Aims>
void solve_told(const SolveRun& run)
{
    if (!(run.features & (SWIVEL_WITH_SHOULDER_BOX | SWIVEL_WITH_WRIST_BOX)))
        search_limbs<T, kToldWithoutBoxes, Aims>(run);
    else if (lane_count<Boxed> == 1 || run.limb_count <= kLanes)
        search_limbs<Boxed, kToldFeatures, Aims>(run);
    else
        BoxedLimbs<Boxed, Aims>(run).solve();
}
template <class T, class Boxed>
void solve_limbs(const SolveRun& run)
{
    if (run.features == kConeAndTwist)
        search_limbs<T, kConeAndTwist, false, ShortSearch>(run);
    else if (run.features & SWIVEL_WITH_AIM)
        solve_told<T, Boxed, true>(run);
    else
        solve_told<T, Boxed, false>(run);
}

// The swivels that the limits of one limb of a run allow.
inline AllowedArcs<float> allowed_arcs_of(const SolveRun& run, std::size_t limb)
{
    const LimbUse use = limb_use<kToldFeatures>(run);
    LimbGoal<float> goal;
    const LimbEntry<float> entry =
        load_limb(use, binding_of<kToldFeatures>(run), slice_rows<float, kToldFeatures>(run, limb, kEveryLane), goal);
    if (!entry.valid || !is_valid(use, goal)) return {};
    if (use.aim) return allowed_arcs(swivel_limits(use.limits, goal.limits, place_limb<true>(use, goal).arm).limits);
    return allowed_arcs(swivel_limits(use.limits, goal.limits, place_limb<false>(use, goal).arm).limits);
}

}  // namespace swivel::inline SWIVEL_ISA
