// SPDX-License-Identifier: MIT
//
// Problem P with arms that the plain formula does not hold for: one in 64, at any place, or hard arms only. Degenerate
// poles, extreme sizes and bad numbers take turns; with the best instruction set each kind also runs alone. Compare
// with P/ in the level 2 cache, which has as many arms.
#include <stdexcept>

#include "bench/hard_limbs.h"
#include "bench/rivals/check.h"
#include "bench/suite.h"

namespace bench {

namespace {

// One limb of each so many is hard, of these kinds in turns.
void add_row(const std::string& name, const std::string& isa, std::size_t one_in, std::span<const Hard> kinds,
             swivel_features features = 0)
{
    std::vector<Limb> limbs = random_limbs(arms_within(1, features));
    std::vector<const Hard*> made(limbs.size());
    std::size_t count = 0;
    for (std::size_t first = 0; first + one_in <= limbs.size(); first += one_in, ++count) {
        const std::size_t n = first + count * 37 % one_in;  // 37: at every place of a block
        made[n] = &kinds[count % kinds.size()];
        make_hard(limbs[n], *made[n], count / kinds.size());
    }
    const auto crowd = std::make_shared<swivel::Crowd>(make_crowd(features, limbs.size(), limbs));
    solve_all(*crowd, isa);
    // Of resident crowds, flags tell more than rounding in the world allows: targets near shoulders move.
    if (features == 0 && (!solved_as_hard(*crowd, made) || !(worst_error(limbs, poses_of(*crowd)) < kRightWithin)))
        throw std::runtime_error(name + " is not solved as its limbs ask for; nothing is measured");
    add_solve(name, isa, crowd, {{"hard", static_cast<double>(count) / static_cast<double>(limbs.size())}});
}

}  // namespace

void add_hard(Suite& suite)
{
    for (const std::string& isa : suite.isas) {
        add_row("hard/" + isa + "/one_in_64", isa, 64, kHardKinds);
        add_row("hard/" + isa + "/only", isa, 1, kHardKinds);
    }
    const std::string best = "hard/" + suite.best_isa();
    for (const auto& [name, kind] :
         {std::pair("poles", Hard::pole), {"sizes", Hard::size}, {"numbers", Hard::number}}) {
        add_row(best + "/" + name + "/one_in_64", suite.best_isa(), 64, {&kind, 1});
        add_row(best + "/" + name + "/only", suite.best_isa(), 1, {&kind, 1});
    }
    add_row(best + "/resident/one_in_64", suite.best_isa(), 64, kHardKinds, kResident);
    add_row(best + "/resident/only", suite.best_isa(), 1, kHardKinds, kResident);
}

}  // namespace bench
