// SPDX-License-Identifier: MIT
//
// The production limb, with a reach region of four cones in order in place of its shoulder cone. Of none, 10 and 100 %
// of the limbs the region forbids the swivel that is wished for (limited), or every swivel (infeasible).
#include "bench/rivals/production_limb.h"
#include "bench/shares.h"
#include "swivel/swivel_regions.hpp"

namespace bench {

void add_regions(Suite& suite)
{
    static const swivel::Region region = swivel::Region().add_cones(
        {{{0, 0.2f, 1}, 1.1f}, {{0, 1, 0.3f}, 0.8f}, {{1, 0.3f, 0.2f}, 0.9f}, {{0.5f, -0.6f, 0.8f}, 0.7f}});
    const swivel_features features = (kProduction & ~SWIVEL_WITH_SHOULDER_CONE) | SWIVEL_WITH_REGION;
    const Pool pool = make_pool(features, suite.best_isa(), &region.get());
    const auto add_row = [&](const std::string& isa, Held kind, int percent) {
        const auto crowd = mixed_crowd(pool, arms_within(1, kProduction), kind, percent / 100.0);
        solve_all(*crowd, isa);
        add_solve(std::string("regions/") + isa + "/" + kHeldNames[static_cast<std::size_t>(kind)] + "/" +
                      std::to_string(percent),
                  isa, crowd, shares_of(*crowd));
    };
    for (const std::string& isa : suite.isas) {
        add_row(isa, Held::free, 0);
        for (const int percent : {10, 100}) add_row(isa, Held::limited, percent);
    }
    add_row(suite.best_isa(), Held::infeasible, 10);
}

}  // namespace bench
