// SPDX-License-Identifier: MIT
//
// The closing tables: who is how many times faster, and how far everyone is from what the machine can do.
#pragma once

#include "bench/medians.h"
#include "bench/suite.h"

namespace bench {

// On stdout. Rows whose benchmarks did not run are left out.
void print_tables(const Suite& suite, const Medians& medians);

}  // namespace bench
