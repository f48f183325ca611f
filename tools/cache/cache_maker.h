// SPDX-License-Identifier: MIT
//
// Makes a cache under another name beside it; it appears whole or not at all.
#pragma once

#include <filesystem>
#include <span>

#include "tools/cache/cache.h"
#include "tools/formats/partial.h"

namespace swivel::tools {

// Throws InputError if there is something of that name, or no folder for it to be in.
void require_new(const std::filesystem::path& folder);

// All calls throw InputError where a file cannot be written. One object belongs to one thread.
class CacheMaker {
public:
    // Makes a new folder beside the target, .swivel-PID-N, which is gone with the object unless it got the target's
    // name. Throws InputError as require_new() and require_memory() do, and if the folder cannot be made.
    CacheMaker(const std::filesystem::path& folder, CachedCrowd crowd);

    const CachedCrowd& crowd() const { return crowd_; }
    // Columns, and chunks of goals, each once, in any order. Goals that are empty are left out.
    void write_characters(std::uint32_t column, std::span<const goal_character> characters);
    void write_goals(ChunkAt at, const ChunkGoals& goals);
    // Writes all else and makes the cache appear; to be called once, last. Throws InputError if something has got the
    // target's name meanwhile, or it cannot be renamed. Returns the bytes of the goals.
    std::size_t commit();

private:
    void write(const ZarrArray& array, const ChunkPlace& place, std::span<const std::byte> bytes);
    void write_clip();

    std::filesystem::path target_;
    formats::Partial partial_;
    CachedCrowd crowd_;
    CacheArrays arrays_;
    ZarrStore store_;
    GoalDigests digests_;
    std::size_t bytes_ = 0;
};

}  // namespace swivel::tools
