// SPDX-License-Identifier: MIT
//
// What a filling may hold at once, by the memory that it is given.
#pragma once

#include "tools/cache/fill.h"

namespace swivel::tools {

// How many chunks may be on their way, by the memory that is left beside the program, the clip and the solvers.
// compares: chunks that are done are read, too. threads: that solve.
// Throws InputError, saying how much it takes, if the memory is less than one chunk and the solvers take.
std::size_t chunks_in_flight(const Cache& cache, std::uint64_t memory, bool compares, unsigned threads);

}  // namespace swivel::tools
