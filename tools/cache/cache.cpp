// SPDX-License-Identifier: MIT
#include "tools/cache/cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "tools/cache/cache_attributes.h"
#include "tools/cache/digest.h"
#include "tools/cache/members.h"
#include "tools/formats/error.h"

namespace swivel::tools {

namespace {

namespace fs = std::filesystem;
using formats::InputError;

constexpr const char* kNoCache = "is no cache of swivel; swivel store makes one";

CachedCrowd read_crowd(const PlainFolder& folder)
{
    const fs::path path = folder.path() / ".zattrs";
    if (!folder.has(".zattrs") && folder.has("goal_digest"))
        throw InputError(path, "is missing; take it from a copy, or make the cache anew in another folder");
    if (!folder.has(".zattrs")) throw InputError(folder.path(), kNoCache);
    return crowd_of_attributes(attributes_in(folder), path);
}

GoalDigests read_digests(const ZarrStore& store, const std::vector<ZarrArray>& made)
{
    GoalDigests digests;
    for (const ZarrArray& array : made) {
        const ZarrArray of_array = digest_array(array);
        store.require(of_array);
        std::vector<std::uint64_t>& numbers = digests[array.name];
        numbers.resize(array.chunk_count());
        if (store.read_chunk(of_array, {}, std::as_writable_bytes(std::span(numbers))) != ChunkRead::whole)
            throw InputError(store.chunk_path(of_array, {}),
                             "is missing or damaged; take the file from a copy, or make the cache anew");
    }
    return digests;
}

std::uint64_t state_digest(const Results& results)
{
    std::vector<std::uint64_t> of_fields;
    for (const std::vector<std::uint32_t>& numbers : results)
        of_fields.push_back(digest_of(std::as_bytes(std::span(numbers))));
    return digest_of(of_fields);
}

// Whether a limb that stands on ground goes from frame to frame of the clip, and any other limb nowhere.
bool has_strides(std::span<const goal_source> sources, bool stands)
{
    for (std::size_t frame = 0; frame < sources.size(); ++frame) {
        const auto& [stand, leaves, lands, next] = sources[frame].stride;
        const bool is_in_clip = stand < sources.size() && next < sources.size() && lands < sources.size() &&
                                (frame < leaves || frame < lands);
        if (stands ? leaves == 0 || !is_in_clip : leaves != 0) return false;
    }
    return true;
}

}  // namespace

Cache::Cache(const fs::path& folder) : Cache(PlainFolder(folder_name(folder), kNoCache)) {}

Cache::Cache(PlainFolder files) : crowd_(read_crowd(files)), arrays_(crowd_), store_(std::move(files))
{
    const std::vector<ZarrArray> made = arrays_.made();
    for (const auto& arrays : {arrays_.filled(crowd_), made})
        for (const ZarrArray& array : arrays) store_.require(array);
    require_memory(folder(), crowd_, arrays_, crowd_.chunk.characters, "store the crowd in smaller chunks, or fewer");
    made_ = read_digests(store_, made);
    if (digest_of(made_) != crowd_.goals_digest)
        throw InputError(folder() / "goal_digest",
                         "was changed: its digest is another; take it from a copy, or make the cache anew");
    read_clip();
}

void Cache::read_clip()
{
    std::vector<std::vector<goal_source>*> sources;  // of each limb
    for (CachedLimb& limb : crowd_.limbs) sources.push_back(&limb.sources);
    if (crowd_.look) sources.push_back(&crowd_.look->sources);
    for (std::vector<goal_source>* of_limb : sources) of_limb->resize(crowd_.clip_frames);
    for (std::size_t n = 0; n < std::size(kSourceMembers); ++n) {
        std::vector<std::byte> bytes(arrays_.clip[n].chunk_bytes());
        require_made(arrays_.clip[n], {}, bytes);
        const std::size_t of_limb = bytes.size() / sources.size();
        for (std::size_t limb = 0; limb < sources.size(); ++limb)
            scatter(std::span(bytes).subspan(limb * of_limb, of_limb), kSourceMembers[n], std::span(*sources[limb]));
    }
    for (std::size_t limb = 0; limb < sources.size(); ++limb)
        if (!has_strides(*sources[limb],
                         limb < crowd_.limbs.size() && crowd_.limbs[limb].setup.has(SWIVEL_WITH_GROUND)))
            throw InputError(folder() / "clip",
                             "has strides that are not within the clip; make the cache anew by swivel store");
    crowd_.positions.resize(arrays_.clip.back().chunk_bytes() / sizeof(float));
    require_made(arrays_.clip.back(), {}, std::as_writable_bytes(std::span(crowd_.positions)));
    if (arrays_.ground.empty()) return;
    crowd_.ground->heights.resize(arrays_.ground[0].chunk_bytes() / sizeof(float));
    require_made(arrays_.ground[0], {}, std::as_writable_bytes(std::span(crowd_.ground->heights)));
    if (!std::ranges::all_of(crowd_.ground->heights, [](float height) { return height >= 0 && height <= 1; }))
        throw InputError(store_.chunk_path(arrays_.ground[0], {}),
                         "has heights that are not from 0 to 1; make the cache anew by swivel store");
}

// Reads a chunk of the goals and compares it with what was made. False: none was.
bool Cache::read_made(const ZarrArray& array, const ChunkPlace& place, std::span<std::byte> bytes) const
{
    const std::uint64_t made = made_.at(array.name)[array.chunk_index(place)];
    const ChunkRead read = store_.read_chunk(array, place, bytes);
    if (made == 0 && read == ChunkRead::missing) return false;
    const char* how = nullptr;
    if (read == ChunkRead::missing)
        how = "is missing";
    else if (made == 0)
        how = "nobody made it";
    else if (read == ChunkRead::damaged || digest_of(bytes) != made)
        how = "is damaged";
    if (how)
        throw InputError(store_.chunk_path(array, place),
                         fmt::format("{}; goals cannot be computed again: take the file "
                                     "from a copy, or make the cache anew",
                                     how));
    return true;
}

void Cache::require_made(const ZarrArray& array, const ChunkPlace& place, std::span<std::byte> bytes) const
{
    if (!read_made(array, place, bytes))
        throw InputError(store_.chunk_path(array, place), "is missing; make the cache anew");
}

std::vector<goal_character> Cache::characters(std::uint32_t column) const
{
    std::vector<goal_character> characters(crowd_.characters_in(column));
    for (std::size_t n = 0; n < std::size(kCharacterMembers); ++n) {
        std::vector<std::byte> bytes(arrays_.characters[n].chunk_bytes());
        require_made(arrays_.characters[n], {column}, bytes);
        scatter(bytes, kCharacterMembers[n], std::span(characters));
    }
    for (const goal_character& each : characters)
        if (each.count < 1 || each.first >= crowd_.clip_frames || each.count > crowd_.clip_frames - each.first)
            throw InputError(folder(),
                             fmt::format("character/first and character/count: a clip of {} frames from {} on "
                                         "is none of the cache's {}; make the cache anew",
                                         each.count, each.first, crowd_.clip_frames));
    return characters;
}

ChunkGoals Cache::goals(ChunkAt at) const
{
    ChunkGoals goals;
    const ChunkPlace place{at.time, 0, at.column};
    if (arrays_.given.empty()) return goals;
    const auto read = [&](const ZarrArray& array, auto& numbers) {
        numbers.resize(array.chunk_bytes() / sizeof numbers[0]);
        if (!read_made(array, place, std::as_writable_bytes(std::span(numbers)))) numbers.clear();
    };
    read(arrays_.given[0], goals.target);
    read(arrays_.given[1], goals.pole);
    read(arrays_.given[2], goals.hand);
    return goals;
}

std::uint64_t Cache::digest(ChunkAt at) const
{
    return store_.read_number(arrays_.digest, {at.time, at.column}).value_or(0);
}

std::optional<Results> Cache::read(const std::vector<ZarrArray>& arrays, const ChunkPlace& place, bool is_state) const
{
    Results results;
    for (std::size_t n = 0; n < arrays.size(); ++n) {
        const ZarrArray& array = arrays[n];
        std::vector<std::uint32_t>& numbers = results.emplace_back();
        if (!is_state && arrays_.fields[n].is_state_alone) continue;
        numbers.resize(array.chunk_bytes() / sizeof(std::uint32_t));
        const auto bytes = std::as_writable_bytes(std::span(numbers));
        if (store_.read_chunk(array, place, bytes) != ChunkRead::whole) return std::nullopt;
    }
    return results;
}

std::optional<Results> Cache::results(ChunkAt at) const
{
    return read(arrays_.results, {at.time, 0, at.column}, false);
}

std::optional<Results> Cache::state(ChunkAt at) const
{
    std::optional<Results> state = read(arrays_.state, {at.time, 0, at.column}, true);
    if (state && store_.read_number(arrays_.state_digest, {at.time, at.column}) != state_digest(*state)) state.reset();
    return state;
}

Results Cache::require_state(ChunkAt at) const
{
    std::optional<Results> found = state(at);
    if (!found)
        throw InputError(folder(), fmt::format("the state after chunk {}.{} is missing or damaged; run swivel check",
                                               at.time, at.column));
    return std::move(*found);
}

void Cache::write(ChunkAt at, const Results& results, std::uint64_t digest) const
{
    const ChunkPlace place{at.time, 0, at.column}, number{at.time, at.column};
    const auto write_all = [&](const std::vector<ZarrArray>& arrays, const Results& numbers, bool is_state) {
        for (std::size_t n = 0; n < numbers.size(); ++n)
            if (is_state || !arrays_.fields[n].is_state_alone)
                store_.write_chunk(arrays[n], place, bytes_in(numbers[n]));
    };
    if (crowd_.has_poses) write_all(arrays_.results, results, false);
    if (crowd_.carries_state()) {
        const Results last = last_frame(results, crowd_, at.time);
        write_all(arrays_.state, last, true);
        store_.write_number(arrays_.state_digest, number, state_digest(last));
    }
    store_.write_number(arrays_.digest, number, digest);
}

void Cache::remove_unfinished() const
{
    for (const ZarrArray& array : arrays_.filled(crowd_)) store_.remove_unfinished(array);
}

void require_memory(const fs::path& folder, const CachedCrowd& crowd, const CacheArrays& arrays,
                    std::uint32_t characters, const char* advice)
{
    constexpr double kMaxMemory = 1024, kMebibyte = 1048576;  // MiB
    constexpr double kSolverBytes = 1024;                     // of a limb with its inputs, at most
    const auto chunks_of = [](const ZarrArray& array) {
        double count = 1;
        for (const std::uint64_t along : array.chunk_counts()) count *= static_cast<double>(along);
        return count;
    };
    const auto bytes_of = [](const std::vector<ZarrArray>& of) {
        double bytes = 0;
        for (const ZarrArray& array : of) bytes += static_cast<double>(array.chunk_bytes());
        return bytes;
    };
    double bytes = 32 * chunks_of(arrays.digest);                                 // lists of work
    for (const ZarrArray& array : arrays.made()) bytes += 16 * chunks_of(array);  // digests: each, and all in one list
    for (const auto& made : {arrays.clip, arrays.ground, arrays.given}) bytes += 2 * bytes_of(made);  // files, numbers
    bytes += 3 * (bytes_of(arrays.results) + bytes_of(arrays.state));  // and as they are solved again
    bytes += kSolverBytes * characters * static_cast<double>(crowd.limb_count());
    if (bytes > kMaxMemory * kMebibyte)
        throw InputError(folder, fmt::format("takes {:.0f} MiB of memory at once, more than {:.0f}; {}",
                                             bytes / kMebibyte, kMaxMemory, advice));
}

fs::path folder_name(const fs::path& folder) { return folder.has_filename() ? folder : folder.parent_path(); }

Results last_frame(const Results& results, const CachedCrowd& crowd, std::uint32_t time)
{
    Results last;
    for (const std::vector<std::uint32_t>& numbers : results) {
        const auto of_frame = static_cast<std::ptrdiff_t>(numbers.size() / crowd.chunk.frames);
        const auto begin = numbers.begin() + of_frame * (crowd.frames_in(time) - 1);
        last.emplace_back(begin, begin + of_frame);
    }
    return last;
}

}  // namespace swivel::tools
