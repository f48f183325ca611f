// SPDX-License-Identifier: MIT
#include "tools/cache/cache_maker.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>

#include "tools/cache/cache_attributes.h"
#include "tools/cache/digest.h"
#include "tools/cache/members.h"
#include "tools/formats/error.h"
#include "tools/formats/output_file.h"

namespace swivel::tools {

namespace {

namespace fs = std::filesystem;
using formats::InputError;

// Made beside the target.
PlainFolder partial_folder(const fs::path& target, formats::Partial& partial)
{
    require_new(target);
    if (partial.make(target.parent_path(), [](const char* name) { return ::mkdir(name, 0777); }) == 0)
        return PlainFolder(partial.name(), "is gone; store the crowd again");
    const std::error_code reason(errno, std::generic_category());
    throw InputError(target,
                     fmt::format("cannot be created: {}; check the folder and its permissions", reason.message()));
}

}  // namespace

void require_new(const fs::path& folder)
{
    std::error_code reason;
    const fs::path target = folder_name(folder), parent = target.parent_path();
    if (fs::exists(fs::symlink_status(target, reason)))
        throw InputError(target, "is there already; remove it, or name another folder");
    if (parent.empty()) return;
    const fs::file_status there = fs::status(parent, reason);
    if (there.type() == fs::file_type::none)
        throw InputError(parent,
                         fmt::format("cannot be reached: {}; check the path and its permissions", reason.message()));
    if (!fs::is_directory(there)) throw InputError(parent, "is no folder; make it first");
}

CacheMaker::CacheMaker(const fs::path& folder, CachedCrowd crowd)
    : target_(folder_name(folder)), crowd_(std::move(crowd)), arrays_(crowd_), store_(partial_folder(target_, partial_))
{
    require_memory(target_, crowd_, arrays_, crowd_.chunk.characters, "write smaller chunks by --chunk");
    store_.write_attributes(attributes_of(crowd_));  // throws if they are too long; commit() writes them again
    for (const auto& arrays : {arrays_.filled(crowd_), arrays_.made()})
        for (const ZarrArray& array : arrays) store_.write_array(array);
    for (const ZarrArray& array : arrays_.made()) digests_[array.name].resize(array.chunk_count());
}

void CacheMaker::write(const ZarrArray& array, const ChunkPlace& place, std::span<const std::byte> bytes)
{
    store_.write_chunk(array, place, bytes);
    bytes_ += bytes.size();
    digests_[array.name][array.chunk_index(place)] = digest_of(bytes);
}

void CacheMaker::write_clip()
{
    const std::uint64_t frame_count = crowd_.clip_frames;
    for (std::size_t n = 0; n < std::size(kSourceMembers); ++n) {
        std::vector<std::byte> bytes;
        for (const std::span<const goal_source> sources : sources_of(crowd_)) {
            const auto part = gathered(sources, kSourceMembers[n], frame_count);
            bytes.insert(bytes.end(), part.begin(), part.end());
        }
        write(arrays_.clip[n], {}, bytes);
    }
    write(arrays_.clip.back(), {}, bytes_in(crowd_.positions));
    if (!arrays_.ground.empty()) write(arrays_.ground[0], {}, bytes_in(crowd_.ground->heights));
}

void CacheMaker::write_characters(std::uint32_t column, std::span<const goal_character> characters)
{
    for (std::size_t n = 0; n < std::size(kCharacterMembers); ++n)
        write(arrays_.characters[n], {column}, gathered(characters, kCharacterMembers[n], crowd_.chunk.characters));
}

void CacheMaker::write_goals(ChunkAt at, const ChunkGoals& goals)
{
    const ChunkPlace place{at.time, 0, at.column};
    write(arrays_.given[0], place, bytes_in(goals.target));
    write(arrays_.given[1], place, bytes_in(goals.pole));
    write(arrays_.given[2], place, bytes_in(goals.hand));
}

std::size_t CacheMaker::commit()
{
    write_clip();
    for (const ZarrArray& array : arrays_.made()) {
        store_.write_array(digest_array(array));
        store_.write_chunk(digest_array(array), {}, bytes_in(digests_[array.name]));
    }
    crowd_.goals_digest = digest_of(digests_);
    store_.write_attributes(attributes_of(crowd_));
    require_new(target_);
    if (!partial_.rename(target_)) {
        const std::error_code reason(errno, std::generic_category());
        throw InputError(target_, fmt::format("cannot be made: {}; name another folder", reason.message()));
    }
    formats::sync_folder(target_.parent_path());
    return bytes_;
}

}  // namespace swivel::tools
