// SPDX-License-Identifier: MIT
#include "tools/cache/fill_memory.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/formats/error.h"

namespace swivel::tools {

namespace {

constexpr std::uint64_t kProgramBytes = std::uint64_t{48} << 20;  // of code, libraries and threads
constexpr std::uint64_t kBytesOfLimb = 1024;                      // of a solver's limb with its inputs, at most
constexpr std::size_t kMostInFlight = 16;                         // chunks

// Of one chunk on its way.
std::uint64_t bytes_of_chunk(const Cache& cache, bool verifies)
{
    const CacheArrays& arrays = cache.arrays();
    std::uint64_t bytes = 0;
    for (const ZarrArray& array : arrays.results) bytes += array.chunk_bytes();
    for (const ZarrArray& array : arrays.state) bytes += array.chunk_bytes();
    // Those that are stored, as a file and as numbers, or else files to be packed.
    if (verifies || cache.crowd().is_compressed) bytes *= 3;
    for (const ZarrArray& array : arrays.given) bytes += 2 * array.chunk_bytes();
    return bytes;
}

// Of what is there from the first chunk to the last: lists of chunks, the clip, digests of goals.
std::uint64_t bytes_all_along(const Cache& cache, std::size_t chunk_count)
{
    const CachedCrowd& crowd = cache.crowd();
    std::uint64_t bytes = 2 * sizeof(ChunkAt) * chunk_count;
    bytes += 2 * crowd.limbs.size() * crowd.clip_frame_count() * sizeof(goal_source);
    bytes += 2 * crowd.positions.size() * sizeof(float);
    for (const ZarrArray& array : cache.arrays().made(crowd)) bytes += array.chunk_count() * sizeof(std::uint64_t);
    return bytes;
}

}  // namespace

std::size_t chunks_in_flight(const Cache& cache, const FillOptions& options, unsigned threads, std::size_t chunk_count)
{
    const CachedCrowd& crowd = cache.crowd();
    const std::uint64_t solvers = kBytesOfLimb * crowd.chunk.characters * crowd.limbs.size() * threads;
    const std::uint64_t of_chunk = bytes_of_chunk(cache, options.verifies);
    const std::uint64_t least = kProgramBytes + bytes_all_along(cache, chunk_count) + solvers + of_chunk;
    if (options.memory < least)
        throw formats::InputError(
            cache.folder(),
            fmt::format("one chunk takes {} MiB of memory with {} threads that solve, and --memory is {} "
                        "MiB; give more, use fewer threads, or store the crowd in smaller chunks",
                        (least >> 20) + 1, threads, options.memory >> 20));
    return std::clamp<std::size_t>((options.memory - least) / of_chunk + 1, 1, kMostInFlight);
}

}  // namespace swivel::tools
