// SPDX-License-Identifier: MIT
#include "tools/cache/cache_arrays.h"

#include <fmt/format.h>

#include "tools/cache/digest.h"
#include "tools/cache/members.h"

namespace swivel::tools {

namespace {

// Frames, limbs and characters of the whole crowd, and of one chunk.
ZarrArray by_character(const CachedCrowd& crowd, std::string name, std::string type, std::string meaning,
                       const std::vector<std::uint64_t>& parts, const std::vector<std::string>& part_dimensions)
{
    ZarrArray array{std::move(name),
                    std::move(type),
                    {"frame", "limb", "character"},
                    {crowd.frame_count, crowd.limb_count(), crowd.character_count},
                    {crowd.chunk.frames, crowd.limb_count(), crowd.chunk.characters},
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

// One number for each chunk of the results, each in a file of its own.
ZarrArray by_chunk(const CachedCrowd& crowd, std::string name, std::string meaning)
{
    return {std::move(name),   "<u8", {"chunk", "column"}, {crowd.time_count(), crowd.column_count()}, {1, 1},
            std::move(meaning)};
}

ZarrArray character_array(const CachedCrowd& crowd, const Member& member)
{
    ZarrArray array{fmt::format("character/{}", member.name),
                    member.type,
                    {"character"},
                    {crowd.character_count},
                    {crowd.chunk.characters},
                    member.meaning};
    if (member.count == 1) return array;
    array.dimensions.push_back("xyz");
    array.shape.push_back(member.count);
    array.chunks.push_back(member.count);
    return array;
}

ZarrArray state_array(const CachedCrowd& crowd, ZarrArray results)
{
    results.name = "state/" + results.name;
    results.meaning += ", after each chunk's last frame";
    results.dimensions[0] = "chunk";
    results.shape[0] = crowd.time_count();
    results.chunks[0] = 1;
    return results;
}

}  // namespace

CacheArrays::CacheArrays(const CachedCrowd& crowd)
    : fields(result_fields(crowd)),
      digest(by_chunk(crowd, "digest", "of a chunk's results; 0: not done")),
      state_digest(by_chunk(crowd, "state/digest", "of a chunk's state"))
{
    for (const ResultField& field : fields) {
        const char* const type = field.field == SWIVEL_FLAGS ? "<u4" : "<f4";
        results.push_back(by_character(crowd, field.name, type, field.meaning, field.parts, field.part_dimensions));
        if (crowd.carries_state()) state.push_back(state_array(crowd, results.back()));
    }
    const std::uint64_t limb_count = crowd.limb_count(), clip_frames = crowd.clip_frames;
    for (const Member& member : kSourceMembers)
        clip.push_back(whole(fmt::format("clip/{}", member.name), member.type, {"limb", "clip_frame", "part"},
                             {limb_count, clip_frames, member.count}, member.meaning));
    clip.push_back(whole("clip/position", "<f4", {"clip_frame", "joint", "xyz"}, {clip_frames, crowd.joints.size(), 3},
                         "joints in the world, the clip's unit"));
    if (crowd.ground && crowd.ground->grid.columns > 0)
        ground.push_back(whole("ground/height", "<f4", {"row", "column"},
                               {crowd.ground->grid.rows, crowd.ground->grid.columns},
                               "heights of the ground, as shares of its size along Y"));
    for (const Member& member : kCharacterMembers) characters.push_back(character_array(crowd, member));
    if (!crowd.has_given) return;
    const auto add_given = [&](const char* name, const char* type, const char* meaning, std::uint64_t count) {
        given.push_back(by_character(crowd, name, type, meaning, {count}, {"part"}));
    };
    add_given("given/target", "<f8", "target of one's own, in the world; NaN: the clip's", 3);
    add_given("given/pole", "<f8", "pole of one's own, in the world; NaN: the clip's", 3);
    add_given("given/hand", "<f4", "world rotation of the hand of one's own, x y z w", 4);
}

std::vector<ZarrArray> CacheArrays::made() const
{
    std::vector<ZarrArray> arrays = characters;
    for (const auto& more : {clip, ground, given}) arrays.insert(arrays.end(), more.begin(), more.end());
    return arrays;
}

std::vector<ZarrArray> CacheArrays::filled(const CachedCrowd& crowd) const
{
    std::vector<ZarrArray> arrays{digest};
    for (std::size_t n = 0; n < fields.size(); ++n)
        if (crowd.has_poses && !fields[n].is_state_alone) arrays.push_back(results[n]);
    if (!crowd.carries_state()) return arrays;
    arrays.insert(arrays.end(), state.begin(), state.end());
    arrays.push_back(state_digest);
    return arrays;
}

ZarrArray digest_array(const ZarrArray& made)
{
    std::vector<std::string> dimensions;
    for (const std::string& dimension : made.dimensions) dimensions.push_back(dimension + "_chunk");
    return whole("goal_digest/" + made.name, "<u8", std::move(dimensions), made.chunk_counts(),
                 "of the chunks of " + made.name + "; 0: there is none");
}

std::uint64_t digest_of(const GoalDigests& digests)
{
    std::vector<std::uint64_t> all;
    for (const auto& [name, of_array] : digests) all.insert(all.end(), of_array.begin(), of_array.end());
    return digest_of(all);
}

}  // namespace swivel::tools
