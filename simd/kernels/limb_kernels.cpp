// SPDX-License-Identifier: MIT
//
// The kernels of whole limbs, compiled once for each instruction set: the functions of all stages, and the loop that
// takes the strips of a run through those of its group.
#include <array>
#include <utility>

#include "core/allowed_arcs.h"
#include "simd/bodies/body_stages.h"
#include "simd/limbs/choose_stages.h"
#include "simd/limbs/store_stages.h"

namespace swivel::inline SWIVEL_ISA {

namespace {

using Number = typename KernelNumber<SWIVEL_ARCH, 1>::type;

template <Stage stage, swivel_features Has>
SWIVEL_FLATTEN [[gnu::noinline]] void run_stage(Strip& strip)
{
    constexpr StageRow row = row_of(stage);
    for_each_slice<Number, constants_of(row), Has | implied_by(row)>(
        strip, [](const auto& s) SWIVEL_INLINE_LAMBDA { advance(AtStage<stage>(), s); });
}

using StageFunction = void (*)(Strip& strip);
template <std::size_t number>
constexpr StageFunction stage_function()
{
    constexpr Stage stage = [] {
        Stage last = Stage::goal_to_parent;
        for (const StageRow& row : kStages)
            if (first_function(row.stage) <= number) last = row.stage;
        return last;
    }();
    constexpr std::size_t n = number - first_function(stage);
    if constexpr (stage == Stage::choose)
        return choose < Number, n + 1 < kLineCounts ? n + 1 : 0, 0 > ;
    else if constexpr (stage == Stage::choose_in_box)
        return choose<Number, 0, kMaxBoxes>;
    else if constexpr (stage == Stage::choose_in_region)
        return choose<Number, 0, kMaxBoxes, true>;
    else
        return run_stage<stage, subset(row_of(stage).knows, n)>;
}
template <std::size_t... number>
constexpr std::array<StageFunction, sizeof...(number)> all_functions(std::index_sequence<number...>)
{
    return {stage_function<number>()...};
}
constexpr auto kFunctions = all_functions(std::make_index_sequence<kStageFunctions>());

void add_block(Strip& strip, std::uint32_t block, std::uint32_t lanes)
{
    strip.block[strip.block_count] = block;
    strip.chosen[strip.block_count] = strip.good[strip.block_count] = lanes;
    ++strip.block_count;
}

void solve_limbs(const SolveRun& run)
{
    constexpr std::uint32_t whole_block = (1u << kLanes) - 1;
    const Binding bind = binding_of<kRuntimeFeatures>(run);
    const std::size_t end = run.limb_count < run.first_padding ? run.limb_count : run.first_padding;
    for (std::size_t limb = 0; limb < end;) {
        Strip strip{run, bind, run.strip.rows};
        for (; limb < end && strip.block_count < run.strip.block_count; limb += kLanes) {
            const std::size_t left = end - limb;
            const std::uint32_t exist = left < kLanes ? (1u << left) - 1 : whole_block,
                                lanes = chosen_lanes(run, limb, kLanes) & exist;
            if (lanes != 0) add_block(strip, static_cast<std::uint32_t>(limb / kLanes), lanes);
        }
        if (strip.block_count == 0) return;
        for (std::uint32_t n = 0; n < run.stages->count; ++n) kFunctions[run.stages->function[n]](strip);
    }
}

#ifdef SWIVEL_SINGLE_LIMBS  // of one instruction set (dispatch.h)
std::uint32_t store_arcs(const SolveRun& run, std::size_t limb, ArcEnds (&arcs)[kMaxArcs])
{
    const Binding bind = binding_of<kRuntimeFeatures>(run);
    Strip strip{run, bind, run.strip.rows};
    add_block(strip, static_cast<std::uint32_t>(limb / kLanes), 1u << limb % kLanes);
    constexpr std::size_t first_choice = first_function(Stage::choose);
    for (std::uint32_t n = 0; run.stages->function[n] < first_choice; ++n) kFunctions[run.stages->function[n]](strip);
    static_assert(kMaxAllowedArcs == kMaxArcs);
    std::uint32_t count = 0;
    const auto store = [&](const AllowedArcs<float>& allowed) {
        count = static_cast<std::uint32_t>(allowed.count);
        for (std::uint32_t n = 0; n < count; ++n) {
            const Arc<float>& arc = allowed.arc[n];
            arcs[n] = {{arc.from.cos, arc.from.sin}, {arc.to.cos, arc.to.sin}};
        }
    };
    const LimitList list(run.features);
    for_each_slice<float, 0, 0>(strip, [&](const auto& s) {
        if (s.good() == 0) return;
        const Limits<float> limits = load_limits<kMaxBoxes>(s, list.line_count, list);
        if (run.region)
            store(allowed_arcs(LimitsInRegion<float, kMaxBoxes>{limits, load_region(s)}));
        else
            store(allowed_arcs(limits));
    });
    return count;
}
#else
constexpr decltype(LimbKernels::allowed_arcs) store_arcs = nullptr;
#endif

}  // namespace

extern const LimbKernels limb_kernels;
const LimbKernels limb_kernels{solve_limbs, store_arcs};

}  // namespace swivel::inline SWIVEL_ISA
