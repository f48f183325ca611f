// SPDX-License-Identifier: MIT
//
// What a cache's crowd takes of memory, by its attributes alone: known before anything of that size is read or made.
#pragma once

#include <cstdint>
#include <filesystem>

#include "tools/cache/cache_arrays.h"

namespace swivel::tools {

// Bytes that a process may have resident; and those of code, libraries, threads and usual
// attributes among them. The longest attributes take 100 MiB more for a moment (zarr.h).
constexpr std::uint64_t kUsualMemory = std::uint64_t{1} << 30;
constexpr double kProgramBytes = 48 * 1048576.0;

// Bytes, at most. They are doubles, so that no product of a crowd's numbers is too large.
// What is there as long as the cache is open: the clip, digests of goals, lists of chunks.
double bytes_all_along(const CachedCrowd& crowd, const CacheArrays& arrays);
// A chunk on its way; compares: beside the stored one.
double bytes_of_chunk(const CachedCrowd& crowd, const CacheArrays& arrays, bool compares);
// A solver of that many characters with its inputs.
double bytes_of_solver(const CachedCrowd& crowd, double characters);
// All that a process takes which solves one chunk at a time, the program included.
double bytes_to_replay(const CachedCrowd& crowd, const CacheArrays& arrays);

// For messages, rounded up.
std::uint64_t mebibytes(double bytes);
// Throws InputError naming folder if the bytes are more than memory. what: takes them, such as "a chunk". advice: what
// to do.
void require_memory(const std::filesystem::path& folder, double bytes, std::uint64_t memory, const std::string& what,
                    const std::string& advice);

}  // namespace swivel::tools
