// SPDX-License-Identifier: MIT
#include "tools/cache/cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

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
    return digest_of(std::as_bytes(std::span(of_fields)));
}

}  // namespace

Cache::Cache(const fs::path& folder, std::uint64_t memory) : Cache(PlainFolder(folder_name(folder), kNoCache), memory)
{
}

Cache::Cache(PlainFolder files, std::uint64_t memory)
    : crowd_(read_crowd(files)), arrays_(crowd_), store_(std::move(files), crowd_.is_compressed)
{
    const std::vector<ZarrArray> made = arrays_.made(crowd_);
    for (const auto& arrays : {arrays_.filled(crowd_), made})
        for (const ZarrArray& array : arrays) store_.require(array);
    // With less memory than the program's own, filling says how much a chunk takes, which tells more.
    const auto most = std::max(memory, static_cast<std::uint64_t>(kProgramBytes));
    require_memory(folder(), bytes_all_along(crowd_, arrays_), most, "the clip with the lists of chunks",
                   "give more, or store the crowd in larger chunks");
    made_ = read_digests(store_, made);
    if (digest_of(made_) != crowd_.goals_digest)
        throw InputError(folder() / "goal_digest",
                         "was changed: its digest is another; take it from a copy, or make the cache anew");
    if (crowd_.has_goals()) read_clip();
}

void Cache::require_goals() const
{
    if (!crowd_.has_goals())
        throw InputError(folder(),
                         "keeps poses and no goals, so nothing can be solved again; docs/cache.md says how to read it");
}

void Cache::read_clip()
{
    for (CachedLimb& limb : crowd_.limbs) limb.sources.resize(crowd_.clip_frames);
    for (std::size_t n = 0; n < std::size(kSourceMembers); ++n) {
        std::vector<std::byte> bytes(arrays_.clip[n].chunk_bytes());
        require_made(arrays_.clip[n], {}, bytes);
        const std::size_t of_limb = bytes.size() / crowd_.limbs.size();
        for (std::size_t limb = 0; limb < crowd_.limbs.size(); ++limb)
            scatter(std::span(bytes).subspan(limb * of_limb, of_limb), kSourceMembers[n],
                    std::span(crowd_.limbs[limb].sources));
    }
    crowd_.positions.resize(arrays_.clip.back().chunk_bytes() / sizeof(float));
    require_made(arrays_.clip.back(), {}, std::as_writable_bytes(std::span(crowd_.positions)));
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
    return characters;
}

ChunkGoals Cache::goals(ChunkAt at) const
{
    ChunkGoals goals;
    const ChunkPlace place{at.time, 0, at.column};
    for (std::size_t n = 0; n < arrays_.given.size(); ++n) {
        std::vector<float>& numbers = *std::array{&goals.target, &goals.pole, &goals.hand}[n];
        numbers.resize(arrays_.given[n].chunk_bytes() / sizeof(float));
        if (!read_made(arrays_.given[n], place, std::as_writable_bytes(std::span(numbers)))) numbers.clear();
    }
    if (arrays_.chosen) {
        goals.chosen.resize(arrays_.chosen->chunk_bytes());
        require_made(*arrays_.chosen, place, std::as_writable_bytes(std::span(goals.chosen)));
    }
    return goals;
}

std::uint64_t Cache::digest(ChunkAt at) const
{
    return store_.read_number(arrays_.digest, {at.time, at.column}).value_or(0);
}

std::vector<ChunkAt> Cache::done() const
{
    std::vector<ChunkAt> done;
    store_.for_chunks(arrays_.digest, [&](const ChunkPlace& place) {
        const ChunkAt at{static_cast<std::uint32_t>(place[0]), static_cast<std::uint32_t>(place[1])};
        if (digest(at) != 0) done.push_back(at);
    });
    std::ranges::sort(done, {}, [](ChunkAt at) { return std::pair(at.column, at.time); });
    return done;
}

std::optional<Results> Cache::read(const std::vector<ZarrArray>& arrays, const ChunkPlace& place) const
{
    Results results;
    for (const ZarrArray& array : arrays) {
        std::vector<std::uint32_t>& numbers = results.emplace_back(array.chunk_bytes() / sizeof(std::uint32_t));
        const auto bytes = std::as_writable_bytes(std::span(numbers));
        if (store_.read_chunk(array, place, bytes) != ChunkRead::whole) return std::nullopt;
    }
    return results;
}

std::optional<Results> Cache::results(ChunkAt at) const { return read(arrays_.results, {at.time, 0, at.column}); }

std::vector<std::string> Cache::pose_files(ChunkAt at) const
{
    std::vector<std::string> files;
    const auto add = [&](const ZarrArray& array, const ChunkPlace& place) {
        files.push_back(store_.chunk_path(array, place).lexically_relative(folder()).string());
    };
    for (const ZarrArray& array : arrays_.results) add(array, {at.time, 0, at.column});
    add(arrays_.digest, {at.time, at.column});
    return files;
}

std::optional<Results> Cache::state(ChunkAt at) const
{
    std::optional<Results> state = read(arrays_.state, {at.time, 0, at.column});
    if (state && store_.read_number(arrays_.state_digest, {at.time, at.column}) != state_digest(*state)) state.reset();
    return state;
}

Results Cache::require_state(ChunkAt at) const
{
    std::optional<Results> found = state(at);
    if (!found)
        throw InputError(folder(), fmt::format("the state after chunk {}.{} is missing or damaged; run swivel fill "
                                               "--verify",
                                               at.time, at.column));
    return std::move(*found);
}

std::size_t Cache::write(ChunkAt at, const Results& results, std::uint64_t digest) const
{
    const ChunkPlace place{at.time, 0, at.column};
    std::size_t bytes = 0;
    if (crowd_.has_poses())
        for (std::size_t n = 0; n < results.size(); ++n)
            bytes += store_.write_chunk(arrays_.results[n], place, bytes_in(results[n]));
    if (crowd_.carries_state()) {
        const Results last = last_frame(results, crowd_, at.time);
        for (std::size_t n = 0; n < last.size(); ++n)
            bytes += store_.write_chunk(arrays_.state[n], place, bytes_in(last[n]));
        bytes += store_.write_number(arrays_.state_digest, {at.time, at.column}, state_digest(last));
    }
    return bytes + store_.write_number(arrays_.digest, {at.time, at.column}, digest);
}

void Cache::close()
{
    if (!crowd_.is_closed) {
        crowd_.is_closed = true;
        GoalDigests kept;
        for (const ZarrArray& array : arrays_.made(crowd_)) kept[array.name] = made_.at(array.name);
        made_ = std::move(kept);
        crowd_.goals_digest = digest_of(made_);
        store_.write_attributes(attributes_of(crowd_));
    }
    store_.remove_unfinished_attributes();
    for (const auto& arrays : {arrays_.filled(crowd_), arrays_.made(crowd_)})
        for (const ZarrArray& array : arrays) store_.remove_unfinished(array);
    if (crowd_.has_goals()) return;
    for (const ZarrArray& array : arrays_.left_out()) {
        store_.remove(array);
        store_.remove(digest_array(array));
    }
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
