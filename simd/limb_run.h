// SPDX-License-Identifier: MIT
//
// A run of whole limbs, step by step. A step takes as long as its slowest limb. Finding the least violation of Euler
// boxes takes five to ten times as long as the rest. So limbs that need it are put aside, and solved together.
#pragma once

#include "core/allowed_arcs.h"
#include "simd/limb_step.h"

namespace swivel::inline SWIVEL_ISA {

// One block of limbs put aside, and where each of them belongs.
struct LimbsAside {
    alignas(64) float input[input_row_count(kEveryFeature) * kLanes];
    alignas(64) float results[result_row_count(kEveryFeature) * kLanes];
    std::size_t limb[kLanes];
    std::size_t count = 0;
    bool filled = false;  // lanes that nothing is put into hold numbers all the same

    static void copy_lane(std::uint32_t row_count, const float* from, float* to)
    {
        for (std::uint32_t row = 0; row < row_count; ++row) to[row * kLanes] = from[row * kLanes];
    }
    void take(const LimbRun& run, std::size_t from)
    {
        if (!filled) {
            for (float& x : input) x = 0;
            for (float& x : results) x = 0;
            filled = true;
        }
        copy_lane(run.input_row_count, run.input + row_offset(from, run.input_row_count, 0), input + count);
        copy_lane(run.result_row_count, run.results + row_offset(from, run.result_row_count, 0), results + count);
        limb[count++] = from;
    }
    void give_back(const LimbRun& run)
    {
        for (std::size_t n = 0; n < count; ++n)
            copy_lane(run.result_row_count, results + n, run.results + row_offset(limb[n], run.result_row_count, 0));
        count = 0;
    }
};

// Solves the steps of a run, and calls settled(first limb, mask) after each. A step has one register. Two were no
// faster, because their values do not stay in registers.
template <class T, FeatureSet Features, bool Aims, bool Searches, class Settled>
SWIVEL_FLATTEN [[gnu::noinline]] void solve_limb_steps(const LimbRun& run, Settled settled)
{
    LimbUse use = limb_use<Features>(run);
    use.aim = Aims;  // as it is, but now the compiler knows
    const LimbBinding<T> bind = limb_binding<T, Features>(run);
    for (std::size_t limb = 0; limb < std::size_t{run.block_count} * kLanes; limb += lane_count<T>)
        settled(limb, solve_limb_step<Aims, Searches>(use, bind, rows_of<T, Features>(run, limb)));
}

template <class T, FeatureSet Features, bool Aims>
void search_limbs(const LimbRun& run)
{
    solve_limb_steps<T, Features, Aims, true>(run, [](std::size_t, const Mask<T>&) SWIVEL_INLINE_LAMBDA {});
}

template <class T, bool Aims>
[[gnu::noinline]] void search_aside(const LimbRun& run, LimbsAside& aside)
{
    LimbRun block = run;
    block.input = aside.input;
    block.results = aside.results;
    block.block_count = 1;
    search_limbs<T, kToldFeatures, Aims>(block);
    aside.give_back(run);
}

template <class T, bool Aims>
void solve_limbs(const LimbRun& run)
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
                alignas(64) float waits[lane_count<T>];
                store_lanes([&](std::size_t lane) SWIVEL_INLINE_LAMBDA { return waits + lane; },
                            select(settled, T(0), T(1)));
                for (std::size_t lane = 0; lane < lane_count<T>; ++lane) {
                    if (waits[lane] == 0) continue;
                    aside.take(run, first + lane);
                    if (aside.count == kLanes) search_aside<T, Aims>(run, aside);
                }
            });
        if (aside.count > 0) search_aside<T, Aims>(run, aside);
    }
}
template <class T>
void solve_limbs(const LimbRun& run)
{
    if (run.features == kConeAndTwist)
        search_limbs<T, kConeAndTwist, false>(run);
    else if (run.features == kWholeArm)
        search_limbs<T, kWholeArm, false>(run);
    else if (run.features & feature::aim)
        solve_limbs<T, true>(run);
    else
        solve_limbs<T, false>(run);
}

// The swivels that the limits of one limb of a run allow.
inline AllowedArcs<float> allowed_arcs_of(const LimbRun& run, std::size_t limb)
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
