// SPDX-License-Identifier: MIT
//
// Crowds with features, rows in and rows out: resident (world targets to local rotations) with each instruction set,
// the other sets of features, whole limbs among them, with the best; within the level 2 cache, resident and compact
// results also in memory.
#include "bench/suite.h"

namespace bench {

void add_features(Suite& suite)
{
    for (const std::string& isa : suite.isas)
        add_solve(suite, "resident/" + isa + "/L2", isa, kResident, arms_within(1, kResident));
    add_solve(suite, "resident/" + suite.best_isa() + "/memory", suite.best_isa(), kResident,
              arms_within(3, kResident));
    // As many arms as without: the memory saved is the point.
    for (const std::uint32_t features : {std::uint32_t{0}, kResident})
        add_solve(suite, (features == 0 ? "compact/" : "resident_compact/") + suite.best_isa() + "/memory",
                  suite.best_isa(), features | SWIVEL_COMPACT, arms_within(3, features));

    struct Named {
        const char* name;
        std::uint32_t features;
    };
    for (const auto& [name, features] :
         {Named{"world", SWIVEL_WORLD}, Named{"joints", SWIVEL_JOINTS}, Named{"hand", SWIVEL_WITH_HAND},
          Named{"world+hand", SWIVEL_WORLD | SWIVEL_WITH_HAND}, Named{"joints+hand", SWIVEL_JOINTS | SWIVEL_WITH_HAND},
          Named{"world+joints+hand", kResident | SWIVEL_WITH_HAND}, Named{"compact", SWIVEL_COMPACT},
          Named{"resident+compact", kResident | SWIVEL_COMPACT}, Named{"at_rest", SWIVEL_WITH_ANGLE},
          Named{"cone+twist", SWIVEL_WITH_SHOULDER_CONE | SWIVEL_WITH_HUMERAL_TWIST},
          Named{"box", SWIVEL_WITH_SHOULDER_BOX}, Named{"full_arm", kFullArm},
          Named{"full_arm+box", kFullArm | SWIVEL_WITH_SHOULDER_BOX}})
        add_solve(suite, std::string("features/") + name + "/" + suite.best_isa(), suite.best_isa(), features,
                  arms_within(1, features));
}

}  // namespace bench
