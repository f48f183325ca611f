// SPDX-License-Identifier: MIT
//
// Fills a cache, chunk by chunk: reads what a chunk is asked for, solves it, writes it. The three overlap, within a
// bound of memory that holds whatever the crowd's size.
#pragma once

#include <functional>

#include "tools/cache/cache.h"
#include "tools/cache/shard.h"

namespace swivel::tools {

struct FillOptions {
    Shard shard;
    // Chunks that are done: solve and compare them, and write those again that differ; or leave them as they are.
    bool verifies = false;
    std::uint64_t memory = kUsualMemory;  // bytes that the process may have resident
    // That solve, beside two that wait for the disk; 1: this thread does all, and none is started; 0: as many as the
    // machine has.
    unsigned threads = 0;
    // Called after each chunk, by one thread at a time, with how many are through. What it throws ends the filling.
    std::function<void(std::uint64_t)> progress;
};

// A stored chunk that was not what its goals give.
struct Difference {
    ChunkAt at;
    std::string what;  // the file that differs, or is missing
};

struct FillReport {
    std::uint64_t written = 0, compared = 0, skipped = 0;  // chunks
    std::uint64_t limbs = 0;                               // solved, counted once a frame
    std::uint64_t bytes = 0;                               // of files written
    double seconds = 0;                                    // in all
    double solve_seconds = 0, disk_seconds = 0;            // while a chunk was solved; was read or written
    std::vector<Difference> differences;                   // of chunks compared; fill() has written them again
};

// The chunks of this shard, in the order of work: columns of characters, and the frames of each in order. Where state
// is carried, a column is one shard's.
std::vector<ChunkAt> chunks_of(const CachedCrowd& crowd, const Shard& shard);

// Throws InputError for goals that are missing or damaged, for files that cannot be written, and if the memory is less
// than one chunk takes. Chunks that were done before it failed stay done.
FillReport fill(const Cache& cache, const FillOptions& options);

// Solves all chunks of the shard and compares them with what is stored; writes nothing. Throws as fill() does.
FillReport compare(const Cache& cache, const FillOptions& options);
// Solves chunks that compare() found to differ, in its order, and writes them again. Throws as fill() does.
FillReport mend(const Cache& cache, const FillOptions& options, const std::vector<Difference>& differences);

}  // namespace swivel::tools
