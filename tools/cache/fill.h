// SPDX-License-Identifier: MIT
//
// Fills a cache, chunk by chunk, or proves what is there: reads what a chunk is asked for, solves it, writes it. The
// three overlap. Only a few chunks are on their way at once, whatever the crowd's size.
#pragma once

#include <functional>

#include "tools/cache/cache.h"

namespace swivel::tools {

// Which part of a cache a process has.
struct Shard {
    std::uint32_t index = 0, count = 1;  // index < count
};

struct FillOptions {
    Shard shard;
    // Whether to solve and compare finished chunks, too, and write damaged ones again.
    bool proves = false;
    // Solving threads, beside two that wait for the disk. 1: this thread does everything. 0: as many as the machine
    // has.
    unsigned threads = 0;
    // Called after each chunk, by one thread at a time, with the number of finished chunks. Its exception ends the
    // filling.
    std::function<void(std::uint64_t)> progress;
};

// What was wrong with a chunk that a proof came to.
struct Difference {
    ChunkAt at;
    std::string what;
    // It is written. Not where both its digest and its poses are others than the goals give: then the goals may be
    // those of another crowd.
    bool is_mended;
};

struct FillReport {
    std::uint64_t written = 0, left = 0;  // chunks; left: as they were
    std::uint64_t limbs = 0;              // solved, counted once a frame
    double seconds = 0;
    std::vector<Difference> differences;
};

// The chunks of this shard, in the order of work: columns of characters, and the frames of each in order. Where state
// is carried, a column is one shard's.
std::vector<ChunkAt> chunks_of(const CachedCrowd& crowd, const Shard& shard);

// Throws InputError for goals that are missing or damaged, and for files that cannot be written. Chunks that were done
// before it failed stay done.
FillReport fill(const Cache& cache, const FillOptions& options);

}  // namespace swivel::tools
