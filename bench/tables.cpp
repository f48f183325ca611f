// SPDX-License-Identifier: MIT
#include "bench/tables.h"

#include <cstdio>

#include "bench/rivals/level.h"

namespace bench {

namespace {

// A row: what, the faster one's time, the slower one's, and how many times as long that takes.
void row(const Medians& medians, const std::string& what, const std::string& fast, const std::string& slow)
{
    const auto a = medians.ns(fast), b = medians.ns(slow);
    if (!a || !b) return;
    std::printf("%-26s %-24s %8.2f   %-24s %8.2f %8.2f\n", what.c_str(), fast.c_str(), *a, slow.c_str(), *b, *b / *a);
}

void print_rivals(const Suite& suite, const Medians& medians)
{
    std::puts("\nBeside each other in this run, nanoseconds an arm, medians; the second by the first:");
    for (const std::string& isa : suite.isas) {
        const Level* level = level_for(isa);
        if (!level) continue;
        const std::string own = "P/" + isa + "/L2", same = std::string("/") + level->name;
        if (level->isa == isa)
            for (const Loop& loop : level->loops) row(medians, "P in cache", own, loop.name + same);
        row(medians, "P, one arm at a time", own, "single_glm" + same);
        row(medians, "P, written out by hand", "hand/" + isa, own);
    }
    for (const std::string& isa : suite.isas) row(medians, "P out of cache", "copy/P/memory", "P/" + isa + "/memory");
    const std::string best = suite.best_isa();
    if (const Level* level = level_for(best)) {
        const std::string glm = std::string("frame_glm/") + level->name;
        row(medians, "resident, whole frame", "resident/" + best + "/L2", glm);
        row(medians, "whole frame", "frame/" + best + "/in_one", glm);
    }
    for (const char* step : {"write", "solve", "read", "apart"})
        row(medians, "whole frame, its steps", "frame/" + best + "/in_one", "frame/" + best + "/" + step);
    for (const char* limits : {"cone+twist", "box", "full_arm", "full_arm+box"})
        row(medians, "whole limbs, beside P", "P/" + best + "/L2", std::string("features/") + limits + "/" + best);
    row(medians, "resident out of cache", "copy/resident/memory", "resident/" + best + "/memory");
    for (int threads = 2; threads <= 1024; ++threads)
        for (const char* arms : {"64", "1024", "16384", "262144"})
            for (const char* family : {"threads/", "frame_threads/"})
                row(medians, "threads", family + std::to_string(threads) + "/" + arms,
                    std::string(family) + "1/" + arms);
}

void print_bounds(const Suite& suite, const Medians& medians)
{
    const OpCounts& ops = suite.ops;
    std::printf(
        "\nP costs an ordinary arm %d roots, %d divisions, %d multiplications, %d additions, %d comparisons and %d "
        "selects and signs.\n",
        ops.roots, ops.divisions, ops.multiplications, ops.additions, ops.comparisons, ops.selects);
    std::puts("Bound by the ports, nanoseconds an arm:");
    std::printf("%-10s %10s %10s %10s %10s %10s\n", "", "divider", "arithmetic", "bound", "measured", "measured/bound");
    for (const IsaLimits& limits : suite.machine.isas) {
        const auto measured = medians.ns("P/" + limits.isa + "/L1");
        if (!measured) continue;
        const PortBound bound = port_bound(ops, limits);
        std::printf("%-10s %10.2f %10.2f %10.2f %10.2f %10.2f\n", limits.isa.c_str(), bound.divider_ns,
                    bound.arithmetic_ns, bound.ns(), *measured, *measured / bound.ns());
    }
}

void print_roofline(const Suite& suite, const Medians& medians)
{
    const auto bytes = static_cast<double>(row_bytes(0));
    std::printf("\nRoofline: P does %d operations on %.0f bytes an arm, %.2f a byte. GFLOP/s:\n", suite.ops.flops(),
                bytes, suite.ops.flops() / bytes);
    std::printf("%-10s %-8s %10s %14s %10s\n", "", "", "peak", "copy, GB/s", "measured");
    for (const IsaLimits& limits : suite.machine.isas)
        for (std::size_t level = 0; level < kMemoryLevels.size(); ++level) {
            const auto ns = medians.ns("P/" + limits.isa + "/" + kMemoryLevels[level]);
            if (!ns) continue;
            std::printf("%-10s %-8s %10.1f %14.1f %10.1f\n", limits.isa.c_str(), kMemoryLevels[level],
                        limits.flops_per_ns, suite.machine.copy_bytes_per_ns[level], suite.ops.flops() / *ns);
        }
    std::printf("A copy in memory past the caches: %.1f GB/s.\n", suite.machine.streamed_bytes_per_ns);
}

}  // namespace

void print_tables(const Suite& suite, const Medians& medians)
{
    print_rivals(suite, medians);
    if (!medians.ns("P/" + suite.best_isa() + "/L1")) return;
    print_bounds(suite, medians);
    print_roofline(suite, medians);
}

}  // namespace bench
