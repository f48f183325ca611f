// SPDX-License-Identifier: MIT
//
// Whole limbs against the share that their limits hold back: of 5, 14, 50 and 100 % of the limbs the limits forbid the
// swivel that is wished for (limited), or every swivel (infeasible). The other limbs are free. Each row counts both
// shares from its flags.
#include <cmath>
#include <stdexcept>

#include "bench/shares.h"

namespace bench {

namespace {

void add_row(const std::string& name, const std::string& isa, const Pool& pool, Held kind, double share)
{
    const auto crowd = mixed_crowd(pool, arms_within(1, pool.features), kind, share);
    solve_all(*crowd, isa);
    const Notes notes = shares_of(*crowd);
    for (const auto& [note, counted] : notes)
        if (std::fabs(counted - (note == kHeldNames[static_cast<std::size_t>(kind)] ? share : 0)) > 0.01)
            throw std::runtime_error(name + " has another share than it says; nothing is measured");
    add_solve(name, isa, crowd, notes);
}

}  // namespace

void add_limits(Suite& suite)
{
    const std::string& isa = suite.best_isa();
    for (const auto& [name, features] : {std::pair("cone+twist", SWIVEL_WITH_SHOULDER_CONE | SWIVEL_WITH_HUMERAL_TWIST),
                                         {"full_arm", kFullArm},
                                         {"full_arm+box", kFullArm | SWIVEL_WITH_SHOULDER_BOX}}) {
        const Pool pool = make_pool(features, isa);
        const std::string family = std::string("limits/") + name + "/";
        add_row(family + "free/0/" + isa, isa, pool, Held::free, 0);
        for (const Held kind : {Held::limited, Held::infeasible})
            for (const int percent : {5, 14, 50, 100})
                add_row(family + kHeldNames[static_cast<std::size_t>(kind)] + "/" + std::to_string(percent) + "/" + isa,
                        isa, pool, kind, percent / 100.0);
    }
}

}  // namespace bench
