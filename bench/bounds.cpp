// SPDX-License-Identifier: MIT
//
// The bound of the ports, measured like everything else: for an arm of P, a production limb, two stages of a
// body, a planted foot, the shift of a body, a look, and character C.
// One loop has its roots and divisions, another its multiplications and additions. No operation waits for another. The
// longer time is the bound.
#include "bench/rivals/probe.h"
#include "bench/suite.h"

namespace bench {

namespace {

void add_bound(const std::string& name, const OpCounts& ops, const std::string& isa)
{
    constexpr std::size_t registers = 1200;  // of arms; a multiple of the probes' streams
    const auto count = [](int operations) { return static_cast<std::size_t>(operations) * registers; };
    const Probe& probe = probe_of(isa.c_str());
    const auto arithmetic = count(ops.multiplications + ops.additions);
    const auto roots = count(ops.roots), divisions = count(ops.divisions);
    const std::size_t arm_count = registers * probe.lanes;
    add(name + "/" + isa + "/divider", arm_count, Clock::cpu, [&probe, roots, divisions]() -> Work {
        return [&probe, roots, divisions] { probe.root(roots), probe.divide(divisions); };
    });
    add(name + "/" + isa + "/arithmetic", arm_count, Clock::cpu,
        [&probe, arithmetic]() -> Work { return [&probe, arithmetic] { probe.multiply_add(arithmetic); }; });
}

}  // namespace

void add_bounds(Suite& suite)
{
    const OpCounts production = count_production_ops();
    const BodyOps body = count_body_ops();
    const FeetOps feet = count_feet_ops();
    const OpCounts look = count_look_ops(), character = count_character_ops();
    for (const std::string& isa : suite.isas) {
        add_bound("bound", suite.ops, isa);
        add_bound("bound_production", production, isa);
        add_bound("bound_forward", body.forward, isa);
        add_bound("bound_limbs", body.limbs, isa);
        add_bound("bound_plant", feet.plant, isa);
        add_bound("bound_fit", feet.fit, isa);
        add_bound("bound_look", look, isa);
        add_bound("bound_character", character, isa);
    }
}

}  // namespace bench
