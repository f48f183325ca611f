// SPDX-License-Identifier: MIT
#include "tools/cache/cache_memory.h"

#include <fmt/format.h>

#include "tools/formats/error.h"

namespace swivel::tools {

namespace {

constexpr double kBytesOfLimb = 1024;    // of a solver's limb with its inputs, at most
constexpr double kBytesInLists = 4 * 8;  // of a chunk, in the lists that a check or filling goes through

double count_of(const ZarrArray& array)
{
    double count = 1;
    for (const std::uint64_t along : array.chunk_counts()) count *= static_cast<double>(along);
    return count;
}

double chunk_bytes_of(const std::vector<ZarrArray>& arrays)
{
    double bytes = 0;
    for (const ZarrArray& array : arrays) bytes += static_cast<double>(array.chunk_bytes());
    return bytes;
}

}  // namespace

double bytes_all_along(const CachedCrowd& crowd, const CacheArrays& arrays)
{
    double bytes = kBytesInLists * count_of(arrays.digest);
    if (crowd.has_goals()) bytes += 2 * chunk_bytes_of(arrays.clip);                     // as files, and as structures
    for (const ZarrArray& array : arrays.made(crowd)) bytes += 2 * 8 * count_of(array);  // each, and all in one list
    return bytes;
}

double bytes_of_chunk(const CachedCrowd& crowd, const CacheArrays& arrays, bool compares)
{
    double bytes = chunk_bytes_of(arrays.results) + chunk_bytes_of(arrays.state);
    // Those that are stored, as a file and as numbers, or else files to be packed.
    if (compares || crowd.is_compressed) bytes *= 3;
    return bytes + 2 * chunk_bytes_of(arrays.given);
}

double bytes_of_solver(const CachedCrowd& crowd, double characters)
{
    return kBytesOfLimb * characters * static_cast<double>(crowd.limbs.size());
}

double bytes_to_replay(const CachedCrowd& crowd, const CacheArrays& arrays)
{
    return kProgramBytes + bytes_all_along(crowd, arrays) + bytes_of_chunk(crowd, arrays, true) +
           bytes_of_solver(crowd, crowd.chunk.characters);
}

std::uint64_t mebibytes(double bytes) { return static_cast<std::uint64_t>(bytes / 1048576) + 1; }

void require_memory(const std::filesystem::path& folder, double bytes, std::uint64_t memory, const std::string& what,
                    const std::string& advice)
{
    if (bytes > static_cast<double>(memory))
        throw formats::InputError(folder, fmt::format("{} takes {} MiB of memory, more than {} MiB; {}", what,
                                                      mebibytes(bytes), memory >> 20, advice));
}

}  // namespace swivel::tools
