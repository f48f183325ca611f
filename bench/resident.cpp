// SPDX-License-Identifier: MIT
//
// Resident crowds, from rows to rows: world targets to local rotations. By each instruction set within the level 2
// cache, and by the best one in every level of memory.
#include "bench/suite.h"

namespace bench {

void add_resident(Suite& suite)
{
    for (const std::string& isa : suite.isas)
        for (std::size_t level = 0; level < kMemoryLevels.size(); ++level)
            if (level == 1 || isa == suite.best_isa())
                add_solve(suite, "resident/" + isa + "/" + kMemoryLevels[level], isa, kResident,
                          arms_within(level, kResident));
}

}  // namespace bench
