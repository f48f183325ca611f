// SPDX-License-Identifier: MIT
#include "bench/rivals/machine.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "bench/rivals/arms.h"
#include "bench/rivals/cpu_model.h"
#include "bench/rivals/limbs.h"
#include "bench/rivals/probe.h"
#include "bench/rivals/timing.h"

namespace bench {

namespace {

constexpr int kRounds = 9;
constexpr double kRoundNs = 1e6;

// A limit is what was reached once: whatever else the machine does only adds to a time.
template <class Work>
double least_ns(Work work)
{
    double least = ns_a_call(work, kRoundNs);
    for (int n = 1; n < kRounds; ++n) least = std::min(least, ns_a_call(work, kRoundNs));
    return least;
}

IsaLimits measure_isa(const Probe& probe)
{
    constexpr std::size_t count = 12000;  // a multiple of the probes' streams; microseconds
    const auto ns_each = [&](void (*work)(std::size_t)) { return least_ns([&] { work(count); }) / count; };
    return {probe.isa,
            static_cast<double>(probe.lanes),
            probe.lanes / ns_each(probe.multiply_add),
            ns_each(probe.divide),
            ns_each(probe.root),
            2 * ns_each(probe.divide_and_root)};
}

std::size_t cache_bytes(int level)
{
    const std::string folder = "/sys/devices/system/cpu/cpu0/cache/index";
    for (int n = 0; n < 8; ++n) {
        const std::string index = folder + std::to_string(n);
        std::ifstream level_file(index + "/level"), type_file(index + "/type"), size_file(index + "/size");
        int found = 0;
        std::string type;
        std::size_t size = 0;
        char unit = 0;
        if (!(level_file >> found && type_file >> type && size_file >> size >> unit)) continue;
        if (found == level && type != "Instruction") return unit == 'M' ? size << 20 : size << 10;
    }
    return std::array<std::size_t, 3>{32 << 10, 512 << 10, 16 << 20}[static_cast<std::size_t>(level - 1)];
}

std::array<std::size_t, 3> all_cache_bytes() { return {cache_bytes(1), cache_bytes(2), cache_bytes(3)}; }

}  // namespace

std::string library_build() { return SWIVEL_BUILD_TEXT; }

std::array<std::size_t, 4> working_sets()
{
    const auto [l1, l2, l3] = all_cache_bytes();
    return {l1 / 2, l2 / 2, l3 / 2, std::clamp(4 * l3, std::size_t{256} << 20, std::size_t{1} << 30)};
}

Machine measure_machine()
{
    Machine machine{cpu_model(), all_cache_bytes(), {}, {}, 0};
    for (const std::string& isa : runnable_isas()) machine.isas.push_back(measure_isa(probe_of(isa.c_str())));

    const Probe& best = probe_of(machine.isas.front().isa.c_str());
    const auto rate = [](auto copy, Columns<2>& floats) {
        const double ns = least_ns([&] { copy(floats[0], floats[1], floats.count()); });
        return 2 * sizeof(float) * static_cast<double>(floats.count()) / ns;
    };
    const std::array<std::size_t, 4> sets = working_sets();
    for (std::size_t level = 0; level < sets.size(); ++level) {
        Columns<2> floats(sets[level] / (2 * sizeof(float)) / 64 * 64);
        machine.copy_bytes_per_ns[level] = rate(best.copy, floats);
        if (level + 1 == sets.size()) machine.streamed_bytes_per_ns = rate(best.copy_streamed, floats);
    }
    return machine;
}

const IsaLimits& limits_of(const Machine& machine, const std::string& isa)
{
    for (const IsaLimits& limits : machine.isas)
        if (limits.isa == isa) return limits;
    throw std::out_of_range("no limits of " + isa);
}

}  // namespace bench
