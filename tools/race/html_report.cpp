// SPDX-License-Identifier: MIT
#include "tools/race/html_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/rivals/level.h"

namespace swivel::tools {

namespace {

std::string two_digits(double number) { return fmt::format("{:.2f}", number); }

void put_machine(Report& report, const Measured& measured)
{
    std::vector<std::vector<Cell>> rows{
        {"CPU", measured.machine.cpu}, {"instruction set in use", measured.isa}, {"library", bench::library_build()}};
    for (const bench::Level* level : bench::runnable_levels())
        rows.push_back({fmt::format("rivals, {}", level->name), level->flags});
    report.table({"what", "value"}, rows);
}

void put_words(Report& report, const std::vector<std::vector<Cell>>& rows) { report.table({"word", "meaning"}, rows); }

void put_pairs(Report& report, const Measured& measured)
{
    report.heading("Beside others");
    report.paragraph(
        "Nanoseconds an arm: medians, measured in turns, on one thread unless said. The ratio is the other's time by "
        "swivel's.");
    put_words(
        report,
        {{"P",
          "the plain problem: targets, poles and lengths of bones in, rotations of shoulder and elbow out, all "
          "in the arm's own frame"},
         {"resident", "the same with targets in the world and parent frames in, a skeleton's local rotations out"},
         {"whole frame", "the same from and to an engine's own structures, 16,384 arms"},
         {"loop_trig", "the textbook formula as a loop over arrays, with arc cosines and cosines"},
         {"loop_light", "the same with one angle instead of two"},
         {"loop_roots", "the same with half-angle formulas and no angle"},
         {"single_glm, frame_glm", "the textbook formula with glm, one arm at a time"}});
    std::vector<std::vector<Cell>> rows;
    for (const Pair& pair : measured.pairs)
        rows.push_back({pair.work, pair.isa, two_digits(pair.own_ns), pair.other, two_digits(pair.other_ns),
                        two_digits(pair.other_ns / pair.own_ns), pair.note});
    report.table({"work", "instruction set", "swivel", "other", "its time", "ratio", "note"}, rows);
}

void put_sizes(Report& report, const Measured& measured)
{
    report.heading("By the crowd's size");
    Plot plot{"Nanoseconds an arm against the crowd's size, " + measured.isa + ", one thread",
              "arms",
              "nanoseconds an arm",
              true,
              false,
              {{"P: arms in their own frames", {}}, {"resident: parent frames and a skeleton's rotations", {}}}};
    std::vector<std::vector<Cell>> rows;
    for (const Size& size : measured.sizes) {
        const auto arms = static_cast<double>(size.arms);
        plot.series[0].points.emplace_back(arms, size.plain_ns);
        plot.series[1].points.emplace_back(arms, size.resident_ns);
        rows.push_back({std::to_string(size.arms), two_digits(size.plain_ns), two_digits(size.resident_ns)});
    }
    report.plot(plot);
    report.table({"arms", "P", "resident"}, rows);
}

// A ceiling of the roofline: bandwidth up to the peak.
Series ceiling(const std::string& name, double bytes_per_ns, double peak)
{
    Series series{fmt::format("{}, {:.0f} GB/s", name, bytes_per_ns), {}, true, true};
    for (const double intensity : {1.0 / 16, peak / bytes_per_ns, 64.0})
        series.points.emplace_back(intensity, std::min(peak, bytes_per_ns * intensity));
    return series;
}

void put_roofline(Report& report, const Measured& measured)
{
    report.heading("Beside what the machine can do");
    std::vector<std::vector<Cell>> rows;
    for (const Bound& bound : measured.bounds)
        rows.push_back({bound.isa, two_digits(bound.bound.divider_ns), two_digits(bound.bound.arithmetic_ns),
                        two_digits(bound.measured_ns), two_digits(bound.measured_ns / bound.bound.ns())});
    report.paragraph(
        "Nanoseconds an arm of problem P. The divider needs at least the first time for the roots and divisions of an "
        "ordinary arm, and the other ports of this CPU the second for all else. The longer one is the bound.");
    report.table({"instruction set", "divider", "arithmetic", "swivel", "swivel by the bound"}, rows);
    const double flops = measured.ops.flops(), intensity = flops / static_cast<double>(measured.row_bytes);
    const double peak = limits_of(measured.machine, measured.isa).flops_per_ns;
    Plot plot{"Roofline of problem P, " + measured.isa + "; without fused operations",
              "operations a byte",
              "GFLOP/s",
              true,
              true,
              {}};
    for (std::size_t level = 0; level < bench::kMemoryLevels.size(); ++level)
        plot.series.push_back(ceiling(fmt::format("copy in {}", bench::kMemoryLevels[level]),
                                      measured.machine.copy_bytes_per_ns[level], peak));
    plot.series.push_back(ceiling("copy past the caches", measured.machine.streamed_bytes_per_ns, peak));
    for (const Bound& bound : measured.bounds)
        plot.series.push_back({"P in cache, " + bound.isa, {{intensity, flops / bound.measured_ns}}, false});
    plot.series.push_back({"P out of cache", {{intensity, flops / measured.memory_ns}}, false});
    report.paragraph(
        "Roofline: a dashed line is the most that a memory as fast as that copy allows, up to the peak of the "
        "arithmetic. "
        "A dot is what swivel does with the operations and bytes of an arm of P.");
    report.plot(plot);
}

}  // namespace

void put_measured(Report& report, const Measured& measured)
{
    put_machine(report, measured);
    put_pairs(report, measured);
    put_sizes(report, measured);
    put_roofline(report, measured);
}

}  // namespace swivel::tools
