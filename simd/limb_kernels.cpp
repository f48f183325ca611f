// SPDX-License-Identifier: MIT
//
// The kernels of whole limbs, compiled once for each instruction set.
#include "simd/kernels.h"
#include "simd/lanes.h"
#include "simd/limb_run.h"

namespace swivel::inline SWIVEL_ISA {

namespace {

// This takes one limb at a time, so one build of it is enough.
std::uint32_t store_arcs([[maybe_unused]] const SolveRun& run, [[maybe_unused]] std::size_t limb,
                         [[maybe_unused]] ArcEnds (&arcs)[kMostArcs])
{
    if constexpr (std::is_same_v<SWIVEL_ARCH, float>) {
        const AllowedArcs<float> allowed = allowed_arcs_of(run, limb);
        static_assert(std::size(allowed.arc) == kMostArcs);
        const auto count = static_cast<std::uint32_t>(allowed.count);
        for (std::uint32_t n = 0; n < count; ++n) {
            const Arc<float>& arc = allowed.arc[n];
            arcs[n] = {{arc.from.cos, arc.from.sin}, {arc.to.cos, arc.to.sin}};
        }
        return count;
    } else {
        return 0;
    }
}

}  // namespace

extern const LimbKernels limb_kernels;
const LimbKernels limb_kernels{solve_limbs<typename KernelNumber<SWIVEL_ARCH, 1>::type, NarrowNumber<SWIVEL_ARCH>>,
                               store_arcs};

}  // namespace swivel::inline SWIVEL_ISA
