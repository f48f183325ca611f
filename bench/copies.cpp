// SPDX-License-Identifier: MIT
//
// What moving the rows costs without solving: of crowds in memory every input row is read and every result row written
// past the caches, by the best instruction set.
#include "bench/rivals/probe.h"
#include "bench/suite.h"

namespace bench {

void add_copies(Suite& suite)
{
    struct Named {
        const char* name;
        swivel_features features;
    };
    for (const auto& [name, features] : {Named{"P", 0}, Named{"resident", kResident}}) {
        const std::size_t arm_count = arms_within(3, features);
        const auto prepare = [&suite, features = features, arm_count]() -> Work {
            swivel::Crowd& crowd = suite.crowds.get(features, arm_count);
            const swivel_rows in = swivel_input_rows(crowd.get(), 0), out = swivel_result_rows(crowd.get(), 0);
            const Probe& probe = probe_of(suite.best_isa().c_str());
            return
                [=, copy = probe.copy_rows] { copy(in.base, in.row_count, out.base, out.row_count, in.block_count); };
        };
        add(std::string("copy/") + name + "/memory", arm_count, Clock::cpu, prepare);
    }
}

}  // namespace bench
