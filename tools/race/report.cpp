// SPDX-License-Identifier: MIT
#include "tools/race/report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bench/rivals/level.h"
#include "tools/cli/streams.h"

namespace swivel::tools {

using Json = nlohmann::ordered_json;

namespace {

Json json_of(const bench::Machine& machine)
{
    Json out{{"cpu", machine.cpu}, {"streamed_bytes_per_ns", machine.streamed_bytes_per_ns}};
    for (std::size_t level = 0; level < bench::kMemoryLevels.size(); ++level)
        out["copy_bytes_per_ns"][bench::kMemoryLevels[level]] = machine.copy_bytes_per_ns[level];
    for (const bench::IsaLimits& limits : machine.isas)
        out["limits"][limits.isa] = {{"lanes", limits.lanes},
                                     {"flops_per_ns", limits.flops_per_ns},
                                     {"division_ns", limits.division_ns},
                                     {"root_ns", limits.root_ns},
                                     {"divide_root_ns", limits.divide_root_ns}};
    return out;
}

void print_pairs(const Measured& measured)
{
    say(stdout, "\nNanoseconds an arm: medians, in turns, one thread unless said. Ratio: the other by swivel.\n");
    say(stdout, "{:<16}{:<8}{:>8}  {:<24}{:>8}{:>8}  {}\n", "work", "isa", "swivel", "other", "", "ratio", "");
    for (const Pair& pair : measured.pairs)
        say(stdout, "{:<16}{:<8}{:>8.2f}  {:<24}{:>8.2f}{:>8.2f}  {}\n", pair.work, pair.isa, pair.own_ns, pair.other,
            pair.other_ns, pair.other_ns / pair.own_ns, pair.note);
}

void print_bounds(const Measured& measured)
{
    const bench::OpCounts& ops = measured.ops;
    say(stdout,
        "\nAn ordinary arm of P takes {} roots, {} divisions, {} multiplications, {} additions, {} comparisons, {} "
        "selects and signs.\nThe ports of this CPU need for them, nanoseconds an arm:\n",
        ops.roots, ops.divisions, ops.multiplications, ops.additions, ops.comparisons, ops.selects);
    say(stdout, "{:<8}{:>10}{:>12}{:>10}{:>12}\n", "isa", "divider", "arithmetic", "swivel", "by bound");
    for (const Bound& bound : measured.bounds)
        say(stdout, "{:<8}{:>10.2f}{:>12.2f}{:>10.2f}{:>12.2f}\n", bound.isa, bound.bound.divider_ns,
            bound.bound.arithmetic_ns, bound.measured_ns, bound.measured_ns / bound.bound.ns());
}

void print_sizes(const Measured& measured)
{
    if (measured.sizes.empty()) return;
    say(stdout, "\nNanoseconds an arm by the crowd's size, {}, one thread:\n{:>10}{:>10}{:>12}\n", measured.isa, "arms",
        "P", "resident");
    for (const Size& size : measured.sizes)
        say(stdout, "{:>10}{:>10.2f}{:>12.2f}\n", size.arms, size.plain_ns, size.resident_ns);
}

void print_roofline(const Measured& measured)
{
    const auto bytes = static_cast<double>(measured.row_bytes);
    const double flops = measured.ops.flops();
    say(stdout, "\nRoofline: P does {:.2f} operations a byte; peak without fused ones, and P in cache, GFLOP/s:",
        flops / bytes);
    for (const Bound& bound : measured.bounds)
        say(stdout, " {} {:.0f} {:.0f}{}", bound.isa, limits_of(measured.machine, bound.isa).flops_per_ns,
            flops / bound.measured_ns, &bound == &measured.bounds.back() ? "" : ",");
    say(stdout, "\nCopies, GB/s:");
    for (std::size_t level = 0; level < bench::kMemoryLevels.size(); ++level)
        say(stdout, " {} {:.0f},", bench::kMemoryLevels[level], measured.machine.copy_bytes_per_ns[level]);
    say(stdout, " past the caches {:.0f}; P out of cache {:.0f}\n", measured.machine.streamed_bytes_per_ns,
        bytes / measured.memory_ns);
}

}  // namespace

Json json_of(const Measured& measured)
{
    Json out{{"isa", measured.isa}, {"library_build", bench::library_build()}, {"machine", json_of(measured.machine)}};
    for (const bench::Level* level : bench::runnable_levels()) out["rivals_build"][level->name] = level->flags;
    for (const Pair& pair : measured.pairs)
        out["pairs"].push_back({{"work", pair.work},
                                {"isa", pair.isa},
                                {"own", pair.own},
                                {"own_ns", pair.own_ns},
                                {"other", pair.other},
                                {"other_ns", pair.other_ns},
                                {"note", pair.note},
                                {"ratio", pair.other_ns / pair.own_ns}});
    const bench::OpCounts& ops = measured.ops;
    out["ops"] = {{"roots", ops.roots},         {"divisions", ops.divisions},
                  {"additions", ops.additions}, {"multiplications", ops.multiplications},
                  {"selects", ops.selects},     {"comparisons", ops.comparisons}};
    for (const Bound& bound : measured.bounds)
        out["bounds"].push_back({{"isa", bound.isa},
                                 {"divider_ns", bound.bound.divider_ns},
                                 {"arithmetic_ns", bound.bound.arithmetic_ns},
                                 {"bound_ns", bound.bound.ns()},
                                 {"measured_ns", bound.measured_ns}});
    for (const Size& size : measured.sizes)  // those of a report
        out["sizes"].push_back({{"arms", size.arms}, {"plain_ns", size.plain_ns}, {"resident_ns", size.resident_ns}});
    out["row_bytes"] = measured.row_bytes;
    out["memory_ns"] = measured.memory_ns;
    return out;
}

void print_measured(const Measured& measured)
{
    say(stdout, "cpu      {}\nlibrary  {}\n", measured.machine.cpu, bench::library_build());
    for (const bench::Level* level : bench::runnable_levels())
        say(stdout, "rivals   {}: {}\n", level->name, level->flags);
    print_pairs(measured);
    print_bounds(measured);
    print_sizes(measured);
    print_roofline(measured);
}

}  // namespace swivel::tools
