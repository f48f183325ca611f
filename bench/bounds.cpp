// SPDX-License-Identifier: MIT
//
// The bound of the ports for character C, measured like everything else. One loop has its roots and divisions, another
// its multiplications and additions. No operation waits for another. The longer time is the bound.
#include "bench/rivals/op_counts.h"
#include "bench/rivals/probe.h"
#include "bench/suite.h"

namespace bench {

void add_bounds(Suite& suite)
{
    constexpr std::size_t registers = 1200;  // of characters; a multiple of the probes' streams
    const OpCounts ops = count_character_ops();
    const auto count = [](int operations) { return static_cast<std::size_t>(operations) * registers; };
    const auto roots = count(ops.roots), divisions = count(ops.divisions),
               arithmetic = count(ops.multiplications + ops.additions);
    for (const std::string& isa : suite.isas) {
        const Probe& probe = probe_of(isa.c_str());
        const std::size_t character_count = registers * probe.lanes;
        add("bound_character/" + isa + "/divider", character_count, Clock::cpu, [&probe, roots, divisions]() -> Work {
            return [&probe, roots, divisions] { probe.root(roots), probe.divide(divisions); };
        });
        add("bound_character/" + isa + "/arithmetic", character_count, Clock::cpu,
            [&probe, arithmetic]() -> Work { return [&probe, arithmetic] { probe.multiply_add(arithmetic); }; });
    }
}

}  // namespace bench
