// SPDX-License-Identifier: MIT
#include "batch/query/allowed_arcs.h"

#include <algorithm>

#include "batch/solve/solve.h"
#include "simd/dispatch.h"

namespace swivel {

std::uint32_t allowed_arcs(const Group& group, std::uint32_t limb, swivel_arc* arcs, std::uint32_t capacity)
{
    alignas(64) float strip[kStripBlockFloats];
    const SolveRun run = run_of(group, {0, group.block_count}, {strip, 1}, false, nullptr);
    ArcEnds ends[kMaxArcs];
    const std::uint32_t count = single_limb_kernels().limbs.allowed_arcs(run, limb, ends);
    for (std::uint32_t n = 0; n < std::min(count, capacity); ++n)
        arcs[n] = {{ends[n].from[0], ends[n].from[1]}, {ends[n].to[0], ends[n].to[1]}};
    return count;
}

}  // namespace swivel
