// SPDX-License-Identifier: MIT
//
// What a filling may hold at once, by the memory that it is given.
#pragma once

#include "tools/cache/fill.h"

namespace swivel::tools {

// How many chunks may be on their way, by the memory that is left beside the program, the clip and the solvers.
// threads: that solve. chunk_count: of all that the filling goes through.
// Throws InputError, saying how much it takes, if the memory is less than one chunk and the solvers take.
std::size_t chunks_in_flight(const Cache& cache, const FillOptions& options, unsigned threads, std::size_t chunk_count);

}  // namespace swivel::tools
