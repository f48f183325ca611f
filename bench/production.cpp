// SPDX-License-Identifier: MIT
//
// The production limb: 16,384 of them, from and to an engine's structures, in one call and step by step. What each
// feature adds is measured in cache, from a limb with a flexion limit up to the production limb.
#include <stdexcept>

#include "bench/rivals/production_limb.h"
#include "bench/shares.h"

namespace bench {

namespace {

constexpr std::size_t kLimbs = 16384;

struct Production {
    std::vector<ProductionLimb> limbs = std::vector<ProductionLimb>(kLimbs);
    FramedCrowd framed = production_crowd(limbs);
};

void add_frame(const Suite& suite)
{
    const auto all = std::make_shared<Production>();
    const auto timed = [&](const std::string& isa, const std::string& step, void (FramedCrowd::*work)(),
                           Notes notes = {}) {
        add(
            "production/" + isa + "/" + step, kLimbs, Clock::cpu,
            [=]() -> Work {
                swivel::check(swivel_use_isa(isa.c_str()));
                return [all, work] { (all->framed.*work)(); };
            },
            std::move(notes));
    };
    solve_all(all->framed.crowd(), suite.best_isa());
    const Notes shares = shares_of(all->framed.crowd());
    for (const std::string& isa : suite.isas) timed(isa, "in_one", &FramedCrowd::solve_in_one, shares);
    timed(suite.best_isa(), "write", &FramedCrowd::write);
    timed(suite.best_isa(), "solve", &FramedCrowd::solve);
    timed(suite.best_isa(), "read", &FramedCrowd::read);
}

}  // namespace

void add_production(Suite& suite)
{
    add_frame(suite);
    struct Step {
        const char* name;
        swivel_features adds;
    };
    swivel_features features = 0;
    for (const auto& [name, adds] :
         {Step{"1_flexion_limit", SWIVEL_WITH_FLEXION_LIMIT}, Step{"2_reach", SWIVEL_WITH_REACH},
          Step{"3_world", SWIVEL_WORLD}, Step{"4_joints", SWIVEL_JOINTS}, Step{"5_hand", SWIVEL_WITH_HAND},
          Step{"6_incoming", SWIVEL_WITH_INCOMING}, Step{"7_weights", SWIVEL_WITH_WEIGHTS},
          Step{"8_shoulder_cone", SWIVEL_WITH_SHOULDER_CONE}}) {
        features |= adds;
        for (const std::string& isa : suite.isas)
            add_solve(suite, "production/" + isa + "/" + name, isa, features, arms_within(1, features));
    }
    if (features != kProduction) throw std::logic_error("the steps do not end at the production limb");
}

}  // namespace bench
