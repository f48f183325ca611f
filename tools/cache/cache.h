// SPDX-License-Identifier: MIT
//
// A crowd in a folder: what it is asked for, its poses, or both, cut into chunks that any number of machines fill. One
// process makes it (CacheMaker); then any number open it (Cache). Each chunk's digest is written after all else of the
// chunk, so a chunk with a digest is done. Objects of Cache may be used by several threads at once, also on one chunk.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "tools/cache/cached_crowd.h"

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

// The arrays of a cache, in the one order in which it lists them.
struct CacheArrays {
    explicit CacheArrays(const CachedCrowd& crowd);

    std::vector<ResultField> fields;
    std::vector<ZarrArray> results, state;  // one for each field; no state where none is carried
    ZarrArray digest;
    std::vector<ZarrArray> clip;        // sources, one array for each member of goal_source; then positions of joints
    std::vector<ZarrArray> characters;  // size, place, start
    std::vector<ZarrArray> given;       // target, pole, hand; none without goals of one's own
    std::optional<ZarrArray> chosen;    // with a budget
};

class Cache {
public:
    // Reads and checks the metadata. Throws InputError naming the file that is missing, damaged or of another version.
    explicit Cache(const std::filesystem::path& folder);

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
    // The stored poses of a chunk; nothing if a file of them is missing or cut.
    std::optional<Results> results(ChunkAt at) const;
    // What the chunk after this one starts from.
    std::optional<Results> state(ChunkAt at) const;

    // Writes poses, as far as the cache keeps them, then state, then the digest. Returns the bytes of the files.
    std::size_t write(ChunkAt at, const Results& results, std::uint64_t digest) const;

    // Ends the filling: removes what unfinished writers left, and goals but for the characters if the cache keeps poses
    // alone. For one process with no other at work.
    void close();

private:
    void read_clip();
    bool read_made(const ZarrArray& array, const ChunkPlace& place, std::span<std::byte> bytes) const;
    std::optional<Results> read(const std::vector<ZarrArray>& arrays, const ChunkPlace& place) const;

    CachedCrowd crowd_;
    CacheArrays arrays_;
    ZarrStore store_;
    std::map<std::string, nlohmann::ordered_json> made_;  // digests of chunks of goals, by array
};

// A folder's name without a slash at its end.
std::filesystem::path folder_name(const std::filesystem::path& folder);

// The last frame of a chunk's results: what the next chunk starts from.
Results last_frame(const Results& results, const CachedCrowd& crowd, std::uint32_t time);

// Makes a cache under another name beside it; it appears whole or not at all.
class CacheMaker {
public:
    // Throws InputError if there is something of that name, or the folder cannot be made.
    CacheMaker(const std::filesystem::path& folder, CachedCrowd crowd);
    ~CacheMaker();  // removes what was not committed
    CacheMaker(const CacheMaker&) = delete;
    CacheMaker& operator=(const CacheMaker&) = delete;

    const CachedCrowd& crowd() const { return crowd_; }
    // Columns, and chunks of goals, each once, in any order. Goals that are empty are left out.
    void write_characters(std::uint32_t column, std::span<const goal_character> characters);
    void write_goals(ChunkAt at, const ChunkGoals& goals);
    // Writes all else and makes the cache appear; to be called once, last. Returns the bytes of what it has.
    std::size_t commit();

private:
    void write(const ZarrArray& array, const ChunkPlace& place, std::span<const std::byte> bytes);
    void write_clip();

    std::filesystem::path target_, partial_;
    CachedCrowd crowd_;
    CacheArrays arrays_;
    ZarrStore store_;
    nlohmann::ordered_json digests_;  // of chunks of goals, by array and chunk
    std::size_t bytes_ = 0;
};

}  // namespace swivel::tools
