// SPDX-License-Identifier: MIT
//
// A crowd in a folder: what it is asked for and its poses, cut into chunks that any number of machines fill. One
// process makes it (cache_maker.h); then any number open it. Each chunk's digest is written after all else of the
// chunk, so a chunk with a digest is done. Objects of Cache may be used by several threads at once, also on one chunk.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "tools/cache/cache_arrays.h"

namespace swivel::tools {

// A chunk of the results: frames time * chunk.frames and on, characters column * chunk.characters and on.
struct ChunkAt {
    std::uint32_t time, column;

    friend bool operator==(const ChunkAt&, const ChunkAt&) = default;
};

// Results of a chunk, or of a frame of it, one list for each of result_fields(): [frame][limb][character][part], all of
// them as wide as a whole chunk. Floats are kept as their bits; those of nobody are NaN.
using Results = std::vector<std::vector<std::uint32_t>>;

// What a chunk is asked for beside the formula, in the world: [frame][limb][character][3, 3 and 4]; x of target and of
// pole is NaN where the formula's counts. Empty: everywhere.
struct ChunkGoals {
    std::vector<double> target, pole;
    std::vector<float> hand;
};

// All calls throw InputError, naming the file, where one may not be read or written.
class Cache {
public:
    // Reads and checks the metadata and the clip. Throws InputError naming the file that is missing, damaged or of
    // another version, and as require_memory() does.
    explicit Cache(const std::filesystem::path& folder);

    const std::filesystem::path& folder() const { return store_.folder(); }
    const CachedCrowd& crowd() const { return crowd_; }
    const CacheArrays& arrays() const { return arrays_; }

    // The characters of a column, and what a chunk is asked for. Throws InputError naming the file that is missing, or
    // whose bytes are not those that were made.
    std::vector<goal_character> characters(std::uint32_t column) const;
    ChunkGoals goals(ChunkAt at) const;

    // 0: the chunk is not done, or the file of its digest is damaged, which comes to the same.
    std::uint64_t digest(ChunkAt at) const;
    // The stored poses of a chunk, with no numbers of what is state alone; nothing if a file is missing or cut.
    std::optional<Results> results(ChunkAt at) const;
    // What the chunk after this one starts from; nothing if it is missing or damaged.
    std::optional<Results> state(ChunkAt at) const;
    // The same; throws InputError that says what to do.
    Results require_state(ChunkAt at) const;

    // Writes poses, if the cache keeps them, then state, then the digest.
    void write(ChunkAt at, const Results& results, std::uint64_t digest) const;
    // Removes what killed writers left; nothing else. For one process with no other at work.
    void remove_unfinished() const;

private:
    explicit Cache(PlainFolder folder);
    void read_clip();
    bool read_made(const ZarrArray& array, const ChunkPlace& place, std::span<std::byte> bytes) const;
    void require_made(const ZarrArray& array, const ChunkPlace& place, std::span<std::byte> bytes) const;
    std::optional<Results> read(const std::vector<ZarrArray>& arrays, const ChunkPlace& place, bool is_state) const;

    CachedCrowd crowd_;
    CacheArrays arrays_;
    ZarrStore store_;
    GoalDigests made_;
};

// Throws InputError if it takes more than 1 GiB to have the clip, the lists of chunks, one chunk and a solver of that
// many characters. advice: what to do. Known by the attributes alone, before anything of that size is read or made.
void require_memory(const std::filesystem::path& folder, const CachedCrowd& crowd, const CacheArrays& arrays,
                    std::uint32_t characters, const char* advice);

// A folder's name without a slash at its end.
std::filesystem::path folder_name(const std::filesystem::path& folder);

// The last frame of a chunk's results: what the next chunk starts from.
Results last_frame(const Results& results, const CachedCrowd& crowd, std::uint32_t time);

}  // namespace swivel::tools
