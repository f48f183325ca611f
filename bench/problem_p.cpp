// SPDX-License-Identifier: MIT
//
// Problem P: targets, poles and bone lengths in; shoulder rotors, half flexions and flags out. By swivel with each
// instruction set in each level of memory. On the same arms within the level 2 cache: by hand, at once and in loops
// over strips, and by the rivals at each level of flags.
#include <cstring>
#include <memory>
#include <stdexcept>

#include "bench/rivals/check.h"
#include "bench/rivals/contenders.h"
#include "bench/rivals/probe.h"
#include "bench/suite.h"

namespace bench {

namespace {

// The same rows by hand, into rows of its own: they must be the crowd's to the bit.
void add_by_hand(const std::string& name, bool (*by_hand)(const float*, float*, std::size_t),
                 const std::shared_ptr<swivel::Crowd>& crowd)
{
    const swivel_rows in = swivel_input_rows(crowd->get(), 0), own = swivel_result_rows(crowd->get(), 0);
    const auto rows = std::make_shared<Columns<1>>(std::size_t{own.block_count} * own.row_count * SWIVEL_LANES);
    const auto solve = [crowd, in, rows, by_hand] { return by_hand(in.base, (*rows)[0], in.block_count); };
    if (!solve() || std::memcmp((*rows)[0], own.base, rows->count() * sizeof(float)) != 0)
        throw std::runtime_error(name + " does not give swivel's bits; nothing is measured");
    add(name, swivel_group_limb_count(crowd->get(), 0), Clock::cpu, [solve]() -> Work { return [solve] { solve(); }; });
}

}  // namespace

void add_problem_p(Suite& suite)
{
    const std::vector<Limb> limbs = random_limbs(arms_within(1, 0));
    for (const std::string& isa : suite.isas) {
        const auto crowd = std::make_shared<swivel::Crowd>(make_crowd(0, limbs.size(), limbs));
        solve_all(*crowd, isa);
        const Notes error = checked(isa, worst_error(limbs, poses_of(*crowd)));
        const Probe& probe = probe_of(isa.c_str());
        add_by_hand("hand/" + isa, probe.solve_by_hand, crowd);
        add_by_hand("hand_staged/" + isa, probe.solve_by_stages, crowd);
        for (std::size_t level = 0; level < kMemoryLevels.size(); ++level)
            add_solve(suite, "P/" + isa + "/" + kMemoryLevels[level], isa, 0, arms_within(level, 0), error);
    }
    for (const Level* level : runnable_levels())
        for (const Contender& contender : contenders(*level, limbs)) {
            const std::string name = contender.name + "/" + contender.level;
            contender.solve();
            const Notes error = checked(name, worst_error(limbs, contender.poses()));
            add(
                name, limbs.size(), Clock::cpu, [solve = contender.solve] { return solve; }, error);
        }
}

}  // namespace bench
