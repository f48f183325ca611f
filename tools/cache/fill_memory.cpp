// SPDX-License-Identifier: MIT
#include "tools/cache/fill_memory.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/formats/error.h"

namespace swivel::tools {

namespace {

constexpr double kMostInFlight = 16;  // chunks

}  // namespace

std::size_t chunks_in_flight(const Cache& cache, std::uint64_t memory, bool compares, unsigned threads)
{
    const CachedCrowd& crowd = cache.crowd();
    const double of_chunk = bytes_of_chunk(crowd, cache.arrays(), compares);
    const double solvers = threads * bytes_of_solver(crowd, crowd.chunk.characters);
    const double least = bytes_all_along(crowd, cache.arrays()) + kProgramBytes + solvers + of_chunk;
    const double given = static_cast<double>(memory);
    if (given < least)
        throw formats::InputError(
            cache.folder(),
            fmt::format("one chunk takes {} MiB of memory with {} threads that solve, and --memory is {} "
                        "MiB; give more, use fewer threads, or store the crowd in smaller chunks",
                        mebibytes(least), threads, memory >> 20));
    return static_cast<std::size_t>(std::min((given - least) / of_chunk + 1, kMostInFlight));
}

}  // namespace swivel::tools
