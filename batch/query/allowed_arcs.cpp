// SPDX-License-Identifier: MIT
#include "batch/query/allowed_arcs.h"

#include "batch/query/one_limb.h"
#include "batch/solve/solve.h"
#include "simd/dispatch.h"

namespace swivel {

namespace {

// Not inlined, so that no compiler lays two strips on the stack.
[[gnu::noinline]] std::uint32_t free_arcs(const Group& group, std::uint32_t limb, ArcEnds (&arcs)[kMaxArcs])
{
    alignas(64) float strip[kStripBlockFloats];
    const SolveRun run = run_of(group, {0, group.block_count}, {strip, 1}, false, nullptr);
    return single_limb_kernels().limbs.allowed_arcs(run, limb, arcs);
}

}  // namespace

std::uint32_t allowed_arcs(const Group& group, std::uint32_t limb, ArcEnds (&arcs)[kMaxArcs])
{
    if (!(group.features & kBody)) return free_arcs(group, limb, arcs);
    OneLimb one(group);
    one.take(limb);
    return free_arcs(one.group(), 0, arcs);
}

}  // namespace swivel
