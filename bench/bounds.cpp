// SPDX-License-Identifier: MIT
//
// The bound of the ports, measured like everything else: as many roots and divisions as an arm of P takes, and as many
// multiplications and additions, none of which waits for another. The larger of both times is the bound.
#include "bench/rivals/probe.h"
#include "bench/suite.h"

namespace bench {

void add_bounds(Suite& suite)
{
    constexpr std::size_t registers = 1200;  // of arms; a multiple of the probes' streams
    const auto count = [](int operations) { return static_cast<std::size_t>(operations) * registers; };
    for (const std::string& isa : suite.isas) {
        const Probe& probe = probe_of(isa.c_str());
        const auto arithmetic = count(suite.ops.multiplications + suite.ops.additions);
        const auto roots = count(suite.ops.roots), divisions = count(suite.ops.divisions);
        const std::size_t arm_count = registers * probe.lanes;
        add("bound/" + isa + "/divider", arm_count, Clock::cpu, [&probe, roots, divisions]() -> Work {
            return [&probe, roots, divisions] { probe.root(roots), probe.divide(divisions); };
        });
        add("bound/" + isa + "/arithmetic", arm_count, Clock::cpu,
            [&probe, arithmetic]() -> Work { return [&probe, arithmetic] { probe.multiply_add(arithmetic); }; });
    }
}

}  // namespace bench
