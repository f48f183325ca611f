// SPDX-License-Identifier: MIT
//
// Does an arm cost the same in any crowd? Problem P from one arm to ten million, with each instruction set, on one
// thread; and the crowd's memory for each arm.
#include "bench/suite.h"

namespace bench {

void add_growth(Suite& suite)
{
    for (std::size_t arm_count = 1; arm_count <= 10'000'000; arm_count *= 10) {
        const swivel_group_def group = swivel::group(static_cast<std::uint32_t>(arm_count));
        swivel_crowd_def def = swivel_default_crowd_def();
        def.group_count = 1;
        def.groups = &group;
        for (const std::string& isa : suite.isas)
            add_solve(suite, "growth/" + isa + "/" + std::to_string(arm_count), isa, 0, arm_count,
                      {{"bytes/arm", static_cast<double>(swivel_crowd_bytes(&def)) / static_cast<double>(arm_count)}});
    }
}

}  // namespace bench
