// SPDX-License-Identifier: MIT
//
// Crowds with features, from rows to rows. Resident crowds (world targets to local rotations) run with each instruction
// set. Other sets of features, among them whole limbs, run with the best one. They are within the level 2 cache;
// resident crowds are also measured in memory.
#include "bench/shares.h"

namespace bench {

namespace {

// Limbs with limits as bodies have them, and how many these hold back.
void add_limited(Suite& suite, const std::string& name, swivel_features features)
{
    const std::size_t arm_count = arms_within(1, features);
    swivel::Crowd& crowd = suite.crowds.get(features, arm_count);
    solve_all(crowd, suite.best_isa());
    add_solve(suite, "features/" + name + "/" + suite.best_isa(), suite.best_isa(), features, arm_count,
              shares_of(crowd));
}

}  // namespace

void add_features(Suite& suite)
{
    for (const std::string& isa : suite.isas)
        add_solve(suite, "resident/" + isa + "/L2", isa, kResident, arms_within(1, kResident));
    for (const std::size_t level : {0u, 2u, 3u})
        add_solve(suite, "resident/" + suite.best_isa() + "/" + kMemoryLevels[level], suite.best_isa(), kResident,
                  arms_within(level, kResident));
    for (const auto& [name, features] : {std::pair("cone+twist", SWIVEL_WITH_SHOULDER_CONE | SWIVEL_WITH_HUMERAL_TWIST),
                                         {"box", SWIVEL_WITH_SHOULDER_BOX},
                                         {"full_arm", kFullArm},
                                         {"full_arm+box", kFullArm | SWIVEL_WITH_SHOULDER_BOX}})
        add_limited(suite, name, features);

    struct Named {
        const char* name;
        swivel_features features;
    };
    for (const auto& [name, features] :
         {Named{"world", SWIVEL_WORLD}, Named{"joints", SWIVEL_JOINTS}, Named{"hand", SWIVEL_WITH_HAND},
          Named{"world+hand", SWIVEL_WORLD | SWIVEL_WITH_HAND}, Named{"joints+hand", SWIVEL_JOINTS | SWIVEL_WITH_HAND},
          Named{"world+joints+hand", kResident | SWIVEL_WITH_HAND}, Named{"at_rest", SWIVEL_WITH_ANGLE},
          Named{"reach", SWIVEL_WITH_REACH}, Named{"flexion_limit", SWIVEL_WITH_FLEXION_LIMIT},
          Named{"most_swivel", SWIVEL_WITH_MOST_SWIVEL}, Named{"incoming", SWIVEL_WITH_INCOMING},
          Named{"incoming+weights", SWIVEL_WITH_INCOMING | SWIVEL_WITH_WEIGHTS},
          Named{"hand+effector", SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR},
          Named{"hand+aim", SWIVEL_WITH_HAND | SWIVEL_WITH_AIM},
          Named{"world+clavicle", SWIVEL_WORLD | SWIVEL_WITH_CLAVICLE},
          Named{"hand+2_twist_bones", SWIVEL_WITH_HAND | 2 * SWIVEL_WITH_TWIST_BONES}})
        add_solve(suite, std::string("features/") + name + "/" + suite.best_isa(), suite.best_isa(), features,
                  arms_within(1, features));
}

}  // namespace bench
