// SPDX-License-Identifier: MIT
#include "tools/cache/cache.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cstring>
#include <numeric>

#include "tools/formats/error.h"

namespace swivel::tools {

namespace {

namespace fs = std::filesystem;
using formats::InputError;
using Json = nlohmann::ordered_json;

// A member of goal_source, of type <f8 or <f4.
struct SourceMember {
    const char* name;
    const char* type;
    std::size_t offset, count;
    const char* meaning;
};
constexpr SourceMember kSourceMembers[] = {
    {"elbow", "<f8", offsetof(goal_source, elbow), 3, "elbow from the shoulder, world axes, the clip's unit"},
    {"wrist", "<f8", offsetof(goal_source, wrist), 3, "wrist from the shoulder, world axes, the clip's unit"},
    {"hand", "<f8", offsetof(goal_source, hand), 4, "world rotation of the hand, x y z w"},
    {"lengths", "<f8", offsetof(goal_source, lengths), 2, "upper arm and forearm, the clip's unit"},
    {"origin", "<f8", offsetof(goal_source, origin), 3, "the shoulder in the world, the clip's unit"},
    {"parent", "<f4", offsetof(goal_source, parent), 4, "world rotation of the shoulder's parent joint, x y z w"},
    {"shoulder", "<f4", offsetof(goal_source, shoulder), 4, "the clip's own local rotation, x y z w"},
    {"elbow_local", "<f4", offsetof(goal_source, elbow_local), 4, "the clip's own local rotation, x y z w"},
    {"wrist_local", "<f4", offsetof(goal_source, wrist_local), 4, "the clip's own local rotation, x y z w"}};

constexpr SourceMember kCharacterMembers[] = {
    {"size", "<f8", offsetof(goal_character, size), 1, "factor of limb lengths and of targets"},
    {"place", "<f8", offsetof(goal_character, place), 3, "where it stands in the world, the clip's unit"},
    {"start", "<u4", offsetof(goal_character, start), 1, "frame of the clip that it starts at"}};

constexpr std::tuple<const char*, std::uint64_t, const char*> kGiven[] = {
    {"target", 3, "target of one's own, as solved: from the shoulder, mirrored for mirrored limbs; NaN: the clip's"},
    {"pole", 3, "pole of one's own, as solved"},
    {"hand", 4, "orientation of the hand of one's own, as solved, x y z w"}};

// Copies a member of structures to numbers side by side, or back.
template <class Struct>
std::vector<std::byte> gathered(std::span<const Struct> from, const SourceMember& member, std::size_t rows)
{
    const std::size_t bytes = member.count * static_cast<std::size_t>(member.type[2] - '0');
    std::vector<std::byte> out(rows * bytes);
    for (std::size_t n = 0; n < from.size(); ++n)
        std::memcpy(&out[n * bytes], reinterpret_cast<const std::byte*>(&from[n]) + member.offset, bytes);
    return out;
}
template <class Struct>
void scatter(std::span<const std::byte> from, const SourceMember& member, std::span<Struct> to)
{
    const std::size_t bytes = member.count * static_cast<std::size_t>(member.type[2] - '0');
    for (std::size_t n = 0; n < to.size(); ++n)
        std::memcpy(reinterpret_cast<std::byte*>(&to[n]) + member.offset, &from[n * bytes], bytes);
}

// Frames, limbs and characters of the whole crowd, and of one chunk.
ZarrArray by_character(const CachedCrowd& crowd, std::string name, std::string type, std::string meaning,
                       const std::vector<std::uint64_t>& parts, const std::vector<std::string>& part_dimensions)
{
    ZarrArray array{std::move(name),
                    std::move(type),
                    {"frame", "limb", "character"},
                    {crowd.frame_count, crowd.limbs.size(), crowd.character_count},
                    {crowd.chunk.frames, crowd.limbs.size(), crowd.chunk.characters},
                    std::move(meaning)};
    array.dimensions.insert(array.dimensions.end(), part_dimensions.begin(), part_dimensions.end());
    array.shape.insert(array.shape.end(), parts.begin(), parts.end());
    array.chunks.insert(array.chunks.end(), parts.begin(), parts.end());
    return array;
}

// An array that is one chunk.
ZarrArray whole(std::string name, std::string type, std::vector<std::string> dimensions,
                std::vector<std::uint64_t> shape, std::string meaning)
{
    return {std::move(name), std::move(type), std::move(dimensions), shape, shape, std::move(meaning)};
}

std::string place_text(const ZarrArray& array, ChunkPlace place)
{
    place.resize(array.shape.size());
    return fmt::format("{}", fmt::join(place, "."));
}

}  // namespace

CacheArrays::CacheArrays(const CachedCrowd& crowd) : fields(result_fields(crowd))
{
    for (const ResultField& field : fields) {
        const char* const type = field.field == SWIVEL_FLAGS ? "<u4" : "<f4";
        results.push_back(by_character(crowd, field.name, type, field.meaning, field.parts, field.part_dimensions));
        if (!crowd.carries_state()) continue;
        state.push_back(by_character(crowd, fmt::format("state/{}", field.name), type,
                                     fmt::format("{}, after each chunk's last frame", field.meaning), field.parts,
                                     field.part_dimensions));
        state.back().dimensions[0] = "chunk";
        state.back().shape[0] = crowd.time_count();
        state.back().chunks[0] = 1;
    }
    digest = {"digest",
              "<u8",
              {"chunk", "column"},
              {crowd.time_count(), crowd.column_count()},
              {1, 1},
              "of a chunk's results; 0: not done"};
    const std::uint64_t limb_count = crowd.limbs.size(), clip_frames = crowd.clip_frame_count();
    for (const SourceMember& member : kSourceMembers)
        clip.push_back(whole(fmt::format("clip/{}", member.name), member.type, {"limb", "clip_frame", "part"},
                             {limb_count, clip_frames, member.count}, member.meaning));
    clip.push_back(whole("clip/position", "<f4", {"clip_frame", "joint", "xyz"}, {clip_frames, crowd.joints.size(), 3},
                         "joints in the world, the clip's unit"));
    for (const SourceMember& member : kCharacterMembers) {
        ZarrArray& array = characters.emplace_back(ZarrArray{fmt::format("character/{}", member.name),
                                                             member.type,
                                                             {"character"},
                                                             {crowd.character_count},
                                                             {crowd.chunk.characters},
                                                             member.meaning});
        if (member.count == 1) continue;
        array.dimensions.push_back("xyz");
        array.shape.push_back(member.count);
        array.chunks.push_back(member.count);
    }
    if (crowd.has_given)
        for (const auto& [name, count, meaning] : kGiven)
            given.push_back(by_character(crowd, fmt::format("given/{}", name), "<f4", meaning, {count}, {"part"}));
    if (crowd.budget_blocks > 0) {
        chosen = by_character(crowd, "chosen", "|u1", "1: the frame solves this block of 16 characters", {}, {});
        chosen->dimensions[2] = "block";
        chosen->shape[2] = (crowd.character_count + SWIVEL_LANES - 1) / SWIVEL_LANES;
        chosen->chunks[2] = crowd.chunk.characters / SWIVEL_LANES;
    }
}

// ---- a cache that is there

namespace {

CachedCrowd read_crowd(const fs::path& folder)
{
    const fs::path path = folder / ".zattrs";
    std::error_code ignored;
    if (!fs::exists(path, ignored)) throw InputError(folder, "is no cache of swivel; swivel store makes one");
    const ZarrStore store(folder, false);
    std::uint32_t clip_frames = 0;
    CachedCrowd crowd = crowd_of_attributes(store.attributes(""), path, &clip_frames);
    for (CachedLimb& limb : crowd.limbs) limb.sources.resize(clip_frames);
    crowd.positions.resize(std::size_t{clip_frames} * crowd.joints.size() * 3);
    return crowd;
}

}  // namespace

Cache::Cache(const fs::path& folder)
    : crowd_(read_crowd(folder_name(folder))), arrays_(crowd_), store_(folder_name(folder), crowd_.is_compressed)
{
    if (crowd_.has_poses())
        for (const ZarrArray& array : arrays_.results) store_.require(array);
    for (const ZarrArray& array : arrays_.state) store_.require(array);
    store_.require(arrays_.digest);
    std::vector<ZarrArray> made = arrays_.characters;
    if (crowd_.has_goals()) {
        for (const auto& arrays : {arrays_.clip, arrays_.given}) made.insert(made.end(), arrays.begin(), arrays.end());
        if (arrays_.chosen) made.push_back(*arrays_.chosen);
    }
    for (const ZarrArray& array : made) {
        store_.require(array);
        made_[array.name] = store_.attributes(array.name).value("digests", Json::object());
    }
    if (crowd_.has_goals()) read_clip();
}

void Cache::require_goals() const
{
    if (!crowd_.has_goals())
        throw InputError(folder(),
                         "keeps poses and no goals, so nothing can be solved again; docs/cache.md reads them");
}

void Cache::read_clip()
{
    const std::size_t frame_count = crowd_.clip_frame_count();
    for (std::size_t n = 0; n < std::size(kSourceMembers); ++n) {
        std::vector<std::byte> bytes(arrays_.clip[n].chunk_bytes());
        read_made(arrays_.clip[n], {}, bytes);
        const std::size_t of_limb = bytes.size() / crowd_.limbs.size();
        for (std::size_t limb = 0; limb < crowd_.limbs.size(); ++limb)
            scatter(std::span(bytes).subspan(limb * of_limb, of_limb), kSourceMembers[n],
                    std::span(crowd_.limbs[limb].sources).first(frame_count));
    }
    read_made(arrays_.clip.back(), {}, std::as_writable_bytes(std::span(crowd_.positions)));
}

// Reads a chunk of the goals and compares it with what was made. False: none was.
bool Cache::read_made(const ZarrArray& array, const ChunkPlace& place, std::span<std::byte> bytes) const
{
    const Json& digests = made_.at(array.name);
    const auto digest = digests.find(place_text(array, place));
    const ChunkRead read = store_.read_chunk(array, place, bytes);
    const bool is_there = read != ChunkRead::missing;
    const auto damaged = [&](const char* how) {
        return InputError(
            store_.chunk_path(array, place),
            fmt::format("{}; goals cannot be computed again: take the file from a copy, or make the cache "
                        "anew",
                        how));
    };
    if (is_there != (digest != digests.end())) throw damaged(is_there ? "nobody made it" : "is missing");
    if (is_there && (read == ChunkRead::damaged || *digest != fmt::format("{:016x}", digest_of(bytes))))
        throw damaged("is damaged");
    return is_there;
}

std::vector<goal_character> Cache::characters(std::uint32_t column) const
{
    std::vector<goal_character> characters(crowd_.characters_in(column));
    for (std::size_t n = 0; n < std::size(kCharacterMembers); ++n) {
        std::vector<std::byte> bytes(arrays_.characters[n].chunk_bytes());
        read_made(arrays_.characters[n], {column}, bytes);
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
        read_made(*arrays_.chosen, place, std::as_writable_bytes(std::span(goals.chosen)));
    }
    return goals;
}

std::uint64_t Cache::digest(ChunkAt at) const
{
    std::vector<std::uint64_t> digest(1);
    const auto bytes = std::as_writable_bytes(std::span(digest));
    return store_.read_chunk(arrays_.digest, {at.time, at.column}, bytes) == ChunkRead::whole ? digest[0] : 0;
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
std::optional<Results> Cache::state(ChunkAt at) const { return read(arrays_.state, {at.time, 0, at.column}); }

std::size_t Cache::write(ChunkAt at, const Results& results, std::uint64_t digest) const
{
    const ChunkPlace place{at.time, 0, at.column};
    std::size_t bytes = 0;
    if (crowd_.has_poses())
        for (std::size_t n = 0; n < results.size(); ++n)
            bytes += store_.write_chunk(arrays_.results[n], place, bytes_of(results[n]));
    if (!arrays_.state.empty()) {
        const Results last = last_frame(results, crowd_, at.time);
        for (std::size_t n = 0; n < last.size(); ++n)
            bytes += store_.write_chunk(arrays_.state[n], place, bytes_of(last[n]));
    }
    return bytes + store_.write_chunk(arrays_.digest, {at.time, at.column}, bytes_of(std::vector{digest}));
}

void Cache::close()
{
    std::vector<fs::path> unfinished;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder()))
        if (entry.path().filename().string().starts_with(".swivel-")) unfinished.push_back(entry.path());
    for (const fs::path& path : unfinished) fs::remove(path);
    crowd_.is_closed = true;
    store_.write_group("", attributes_of(crowd_));
    if (crowd_.has_goals()) return;
    for (const char* group : {"clip", "given", "chosen"}) fs::remove_all(folder() / group);
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

// ---- a cache in the making

CacheMaker::CacheMaker(const fs::path& folder, CachedCrowd crowd)
    : target_(folder_name(folder)),
      partial_(target_.parent_path() / fmt::format(".swivel-{}-{}", ::getpid(), target_.filename().string())),
      crowd_(std::move(crowd)),
      arrays_(crowd_),
      store_(partial_, crowd_.is_compressed)
{
    std::error_code reason;
    if (fs::exists(fs::symlink_status(target_, reason)))
        throw InputError(target_, "is there already; remove it, or name another folder");
    if (target_.has_parent_path() && !fs::is_directory(target_.parent_path(), reason))
        throw InputError(target_.parent_path(), "is no folder; make it first");
    store_.write_group("clip", Json::object());
    store_.write_group("character", Json::object());
    if (crowd_.has_given) store_.write_group("given", Json::object());
}

CacheMaker::~CacheMaker()
{
    std::error_code ignored;
    if (!partial_.empty()) fs::remove_all(partial_, ignored);
}

void CacheMaker::write(const ZarrArray& array, const ChunkPlace& place, std::span<const std::byte> bytes)
{
    fs::create_directories(store_.folder() / array.name);
    bytes_ += store_.write_chunk(array, place, bytes);
    digests_[array.name][place_text(array, place)] = fmt::format("{:016x}", digest_of(bytes));
}

void CacheMaker::write_clip()
{
    const std::uint64_t frame_count = crowd_.clip_frame_count();
    for (std::size_t n = 0; n < std::size(kSourceMembers); ++n) {
        std::vector<std::byte> bytes;
        for (const CachedLimb& limb : crowd_.limbs) {
            const auto part = gathered(std::span(limb.sources), kSourceMembers[n], frame_count);
            bytes.insert(bytes.end(), part.begin(), part.end());
        }
        write(arrays_.clip[n], {}, bytes);
    }
    write(arrays_.clip.back(), {}, bytes_of(crowd_.positions));
}

void CacheMaker::write_characters(std::uint32_t column, std::span<const goal_character> characters)
{
    for (std::size_t n = 0; n < std::size(kCharacterMembers); ++n)
        write(arrays_.characters[n], {column}, gathered(characters, kCharacterMembers[n], crowd_.chunk.characters));
}

void CacheMaker::write_goals(ChunkAt at, const ChunkGoals& goals)
{
    const ChunkPlace place{at.time, 0, at.column};
    if (!goals.target.empty()) {
        write(arrays_.given[0], place, bytes_of(goals.target));
        write(arrays_.given[1], place, bytes_of(goals.pole));
        write(arrays_.given[2], place, bytes_of(goals.hand));
    }
    if (!goals.chosen.empty()) write(*arrays_.chosen, place, bytes_of(goals.chosen));
}

std::size_t CacheMaker::commit()
{
    write_clip();
    const auto describe = [&](const ZarrArray& array) {
        store_.write_array(array,
                           digests_.contains(array.name) ? Json{{"digests", digests_[array.name]}} : Json::object());
    };
    for (const auto& arrays : {arrays_.clip, arrays_.characters, arrays_.given})
        for (const ZarrArray& array : arrays) describe(array);
    if (arrays_.chosen) describe(*arrays_.chosen);
    if (crowd_.has_poses())
        for (const ZarrArray& array : arrays_.results) describe(array);
    if (!arrays_.state.empty()) store_.write_group("state", Json::object());
    for (const ZarrArray& array : arrays_.state) describe(array);
    describe(arrays_.digest);
    store_.write_group("", attributes_of(crowd_));
    fs::rename(partial_, target_);
    partial_.clear();
    return bytes_;
}

}  // namespace swivel::tools
