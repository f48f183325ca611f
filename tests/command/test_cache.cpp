// SPDX-License-Identifier: MIT
//
// The promise: a cache is cut in the same way whoever fills it; shards share nothing and leave nothing out. Numbers in
// it ask for no more memory than is given, and metadata that no store writes are refused, whatever their digest. What
// damaged caches make a user see is in tests/transcripts/caches.txt.
#include <rapidcheck/catch.h>
#include <catch2/catch.hpp>

#include <set>

#include "tests/plain_motion.h"
#include "tests/run_command.h"
#include "tools/cache/cache.h"
#include "tools/cache/cache_attributes.h"
#include "tools/cache/fill.h"

using namespace swivel;
using namespace swivel::test;
using namespace swivel::tools;
using Catch::Matchers::Contains;

namespace {

std::uint32_t up_to(std::uint32_t max) { return *rc::gen::inRange(1u, max + 1); }

CachedCrowd some_crowd()
{
    CachedCrowd crowd;
    crowd.frame_count = up_to(60);
    crowd.character_count = up_to(300);
    crowd.limbs.resize(up_to(4));
    if (*rc::gen::arbitrary<bool>()) crowd.limbs.back().setup.features = SWIVEL_WITH_PLANT;
    crowd.chunk = {up_to(20), 16 * up_to(6)};
    return crowd;
}

// A folder with a cache of 40 characters, whose elbows have limits.
struct CacheStage {
    TempFolder folder;

    CacheStage()
    {
        spill(folder / "clip.bvh", kTwoArms);
        spill(folder / "c.toml", "[limb.arms]\nlimits.flexion_deg = [0, 90]\nhand = false\n");
        done(run_command(folder.path,
                         {"store", "clip.bvh", "cache", "--crowd", "c.toml", "--characters", "40", "--chunk", "1,16"}));
    }
};

// Where a chunk is, as a number that orders work.
std::pair<std::uint32_t, std::uint32_t> in_order(ChunkAt at) { return {at.column, at.time}; }

}  // namespace

TEST_CASE("Chunks hold whole blocks, cover the crowd and depend on nothing else")
{
    rc::prop("chunk_shape", [] {
        const std::uint32_t frames = up_to(100'000), characters = up_to(10'000'000), limbs = up_to(4);
        const bool carries_state = up_to(2) == 2;
        const ChunkShape shape = chunk_shape(frames, characters, limbs, carries_state);
        RC_ASSERT(shape.frames >= 1 && shape.frames <= frames);
        RC_ASSERT(shape.characters % SWIVEL_LANES == 0);
        RC_ASSERT(std::uint64_t{shape.frames} * shape.characters * limbs <= 65'536u);
        RC_ASSERT(!carries_state || std::uint64_t{shape.characters} * limbs <= 4'096u);
        CachedCrowd crowd;
        crowd.frame_count = frames, crowd.character_count = characters, crowd.chunk = shape;
        std::uint64_t all = 0;
        for (std::uint32_t time = 0; time < crowd.time_count(); ++time) all += crowd.frames_in(time);
        RC_ASSERT(all == frames);
        all = 0;
        for (std::uint32_t column = 0; column < crowd.column_count(); ++column) all += crowd.characters_in(column);
        RC_ASSERT(all == characters);
    });
}

TEST_CASE("Shards share no chunk and leave none out")
{
    rc::prop("chunks_of", [] {
        const CachedCrowd crowd = some_crowd();
        const std::uint32_t count = up_to(9);
        std::set<std::pair<std::uint32_t, std::uint32_t>> all;
        std::map<std::uint32_t, std::uint32_t> shard_of_column;
        std::size_t chunks = 0;
        for (std::uint32_t index = 0; index < count; ++index) {
            const std::vector<ChunkAt> mine = chunks_of(crowd, {index, count});
            RC_ASSERT(std::ranges::is_sorted(mine, {}, in_order));
            for (const ChunkAt at : mine) {
                all.insert(in_order(at));
                const bool is_own = shard_of_column.try_emplace(at.column, index).first->second == index;
                RC_ASSERT(is_own || !crowd.carries_state());
            }
            chunks += mine.size();
        }
        RC_ASSERT(chunks == all.size());
        RC_ASSERT(chunks == std::size_t{crowd.time_count()} * crowd.column_count());
    });
}

TEST_CASE("Numbers of a crowd take no more memory than is given")
{
    const CacheStage stage;
    CachedCrowd crowd = Cache(stage.folder / "cache").crowd();
    crowd.frame_count = 1u << 30;
    for (const bool has_long_clip : {false, true}) {
        if (has_long_clip) crowd.clip_frames = crowd.frame_count;
        const CacheArrays arrays(crowd);
        const ZarrStore store(PlainFolder(stage.folder / "cache", "is gone"));
        store.write_attributes(attributes_of(crowd));
        for (const auto& each : {arrays.filled(crowd), arrays.made()})
            for (const ZarrArray& array : each) store.write_array(array);
        for (const Words& words : std::vector<Words>{{"fill", "cache"}, {"replay", "cache"}, {"view", "cache"}}) {
            const Outcome outcome = spawn_command(stage.folder.path, words);
            CHECK(outcome.exit_code == 1);
            CHECK_THAT(outcome.err, Contains(" MiB of memory at once, more than 1024; "));
            CHECK(outcome.peak_kib < 100 << 10);
        }
    }
}

TEST_CASE("Metadata that no store writes is refused, whatever its digest")
{
    const CacheStage stage;
    const fs::path path = stage.folder / "cache/.zattrs";
    const CachedCrowd whole = Cache(stage.folder / "cache").crowd();
    const std::pair<const char*, void (*)(CachedCrowd&)> changes[] = {
        {"frames is 0", [](CachedCrowd& crowd) { crowd.frame_count = 0; }},
        {"characters is 4294967295", [](CachedCrowd& crowd) { crowd.character_count = ~0u; }},
        {"chunk_frames is 0", [](CachedCrowd& crowd) { crowd.chunk.frames = 0; }},
        {"chunk_characters is 0", [](CachedCrowd& crowd) { crowd.chunk.characters = 0; }},
        {"chunk_characters is no multiple of 16", [](CachedCrowd& crowd) { crowd.chunk.characters = 17; }},
        {"clip_frames is 0", [](CachedCrowd& crowd) { crowd.clip_frames = 0; }},
        {"a name is empty, or it holds a comma",
         [](CachedCrowd& crowd) { crowd.names.assign(crowd.character_count, "Anna\n"); }},
        {"a joint comes before its parent", [](CachedCrowd& crowd) { crowd.joints[1].parent = 77; }},
        {"a limb's joints are not three",
         [](CachedCrowd& crowd) {
             crowd.limbs[1].joints = {99, 1, 2};
         }},
        {"a limb's joints are not three", [](CachedCrowd& crowd) { crowd.limbs[1].joints.clear(); }},
        {"unknown features: bits 0x8000000000000000",
         [](CachedCrowd& crowd) { crowd.limbs[0].setup.features |= std::uint64_t{1} << 63; }},
        {"SWIVEL_POLE_DIRECTION excludes SWIVEL_POLE_NORMAL",
         [](CachedCrowd& crowd) { crowd.limbs[0].setup.features |= SWIVEL_POLE_DIRECTION | SWIVEL_POLE_NORMAL; }},
        {"shoulder_order is 6, not a number from 0 to 5",
         [](CachedCrowd& crowd) { crowd.limbs[0].setup.shoulder_order = static_cast<swivel_euler_order>(6); }},
        {"twist_bones is 8, not a number from 0 to 7",
         [](CachedCrowd& crowd) { crowd.limbs[0].setup.twist_bone_count = 8; }},
        {"twist bones need SWIVEL_WITH_HAND", [](CachedCrowd& crowd) { crowd.limbs[0].setup.twist_bone_count = 3; }},
        {"there is no such field",
         [](CachedCrowd& crowd) { crowd.limbs[0].setup.fields[0].field = static_cast<swivel_field>(200); }},
        {"field is ", [](CachedCrowd& crowd) { crowd.limbs[0].setup.fields[0].field = SWIVEL_RESULT_END; }},
        {"shoulder is a result", [](CachedCrowd& crowd) { crowd.limbs[0].setup.fields[0].field = SWIVEL_SHOULDER; }},
        {"pole is 3", [](CachedCrowd& crowd) { crowd.limbs[0].setup.goals.pole = 3; }},
        {"holds_pole is 2", [](CachedCrowd& crowd) { crowd.limbs[0].setup.goals.holds_pole = 2; }},
        {"a limb holds none that is before it", [](CachedCrowd& crowd) { crowd.limbs[1].setup.goals.holds = 2; }},
        {"holds is 5", [](CachedCrowd& crowd) { crowd.limbs[1].setup.goals.holds = 5; }},
        {"a look holds a hand",
         [](CachedCrowd& crowd) {
             crowd.look.emplace().setup.look = swivel_default_look_def();
             crowd.look->setup.look->joint_count = 1;
             crowd.look->setup.goals.holds = 1;
         }},
        {"quaternion", [](CachedCrowd& crowd) { std::ranges::fill(crowd.limbs[1].setup.rest.elbow_rotation, 0.0f); }}};
    CHECK_NOTHROW(crowd_of_attributes(attributes_of(whole), path));
    CachedCrowd twisted = whole;
    twisted.limbs[0].setup.features |= SWIVEL_WITH_HAND;
    twisted.limbs[0].setup.twist_bone_count = 3;
    CHECK(crowd_of_attributes(attributes_of(twisted), path).limbs[0].setup.twist_bone_count == 3);
    for (const auto& [what, change] : changes) {
        CachedCrowd changed = whole;
        change(changed);
        CHECK_THROWS_WITH(crowd_of_attributes(attributes_of(changed), path), Contains(what));
    }
}
