// SPDX-License-Identifier: MIT
//
// A crowd in a folder: what it is asked for, its poses, or both, cut into chunks that any number of machines fill. One
// process makes it (cache_maker.h); then any number open it. Each chunk's digest is written after all else of the
// chunk, so a chunk with a digest is done. Objects of Cache may be used by several threads at once, also on one chunk.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "tools/cache/cache_arrays.h"
#include "tools/cache/cache_memory.h"

namespace swivel::tools {

// A chunk of the results: frames time * chunk.frames and on, characters column * chunk.characters and on.
struct ChunkAt {
    std::uint32_t time, column;

    friend bool operator==(const ChunkAt&, const ChunkAt&) = default;
};

// Results of a chunk, or of a frame of it, one list for each of result_fields(): [frame][limb][character][part], all of
// them as wide as a whole chunk. Floats are kept as their bits; those of nobody are NaN.
using Results = std::vector<std::vector<std::uint32_t>>;

// What a chunk is asked for beside the formula.
struct ChunkGoals {
    // [frame][limb][character][3, 3 and 4]; x of the target is NaN where the formula holds. Empty: nowhere.
    std::vector<float> target, pole, hand;
    std::vector<std::uint8_t> chosen;  // [frame][limb][block of 16 characters]; empty: all are solved
};

// All calls throw InputError, naming the file, where one may not be read or written.
class Cache {
public:
    // Reads and checks the metadata and the clip. memory: bytes that the process may have resident. Throws InputError
    // naming the file that is missing, damaged or of another version, and if the lists and the clip take more memory.
    explicit Cache(const std::filesystem::path& folder, std::uint64_t memory = kUsualMemory);

    const std::filesystem::path& folder() const { return store_.folder(); }
    const CachedCrowd& crowd() const { return crowd_; }
    const CacheArrays& arrays() const { return arrays_; }

    // Throws InputError if the cache keeps poses alone: then nothing can be solved again.
    void require_goals() const;
    // The characters of a column, and what a chunk is asked for. Throws InputError naming the file that is missing, or
    // whose bytes are not those that were made.
    std::vector<goal_character> characters(std::uint32_t column) const;
    ChunkGoals goals(ChunkAt at) const;

    // 0: the chunk is not done, or the file of its digest is damaged, which comes to the same.
    std::uint64_t digest(ChunkAt at) const;
    // The chunks that are done, in the order of chunks_of().
    std::vector<ChunkAt> done() const;
    // The stored poses of a chunk; nothing if a file of them is missing or cut.
    std::optional<Results> results(ChunkAt at) const;
    // The files that hold a chunk's poses and their digest, by their names within the folder.
    std::vector<std::string> pose_files(ChunkAt at) const;
    // What the chunk after this one starts from; nothing if it is missing or damaged.
    std::optional<Results> state(ChunkAt at) const;
    // The same; throws InputError that says what to do.
    Results require_state(ChunkAt at) const;

    // Writes poses, as far as the cache keeps them, then state, then the digest. Returns the bytes of the files.
    std::size_t write(ChunkAt at, const Results& results, std::uint64_t digest) const;

    // Ends the filling: removes what unfinished writers left, and all but poses and characters if the cache keeps poses
    // alone. It removes files of a cache's own names alone. For one process with no other at work. A closed cache with
    // nothing to remove is only read.
    void close();

private:
    Cache(PlainFolder folder, std::uint64_t memory);
    void read_clip();
    bool read_made(const ZarrArray& array, const ChunkPlace& place, std::span<std::byte> bytes) const;
    void require_made(const ZarrArray& array, const ChunkPlace& place, std::span<std::byte> bytes) const;
    std::optional<Results> read(const std::vector<ZarrArray>& arrays, const ChunkPlace& place) const;

    CachedCrowd crowd_;
    CacheArrays arrays_;
    ZarrStore store_;
    GoalDigests made_;
};

// A folder's name without a slash at its end.
std::filesystem::path folder_name(const std::filesystem::path& folder);

// The last frame of a chunk's results: what the next chunk starts from.
Results last_frame(const Results& results, const CachedCrowd& crowd, std::uint32_t time);

}  // namespace swivel::tools
