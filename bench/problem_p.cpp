// SPDX-License-Identifier: MIT
//
// Problem P: targets, poles and bone lengths in; shoulder rotors, half flexions and flags out. By swivel with each
// instruction set in each level of memory. The rivals solve the same arms within the level 2 cache, at each level of
// flags.
#include "bench/rivals/check.h"
#include "bench/rivals/contenders.h"
#include "bench/suite.h"

namespace bench {

void add_problem_p(Suite& suite)
{
    const std::vector<Limb> limbs = random_limbs(arms_within(1, 0));
    for (const std::string& isa : suite.isas) {
        swivel::Crowd crowd = make_crowd(0, limbs.size(), limbs);
        solve_all(crowd, isa);
        const Notes error = checked(isa, worst_error(limbs, poses_of(crowd)));
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
