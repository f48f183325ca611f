// SPDX-License-Identifier: MIT
//
// The promise: a cache is cut in the same way whoever fills it; shards share nothing and leave nothing out; what was
// written is read back or known to be damaged; and a crowd goes through store, fill, check, replay and solve with the
// same bits.
#include <rapidcheck/catch.h>
#include <catch2/catch.hpp>

#include <fmt/format.h>
#include <unistd.h>

#include <set>
#include <sstream>

#include "tests/cache_stage.h"
#include "tools/cache/fill.h"

using namespace swivel;
using namespace swivel::test;
using namespace swivel::tools;
using Catch::Matchers::Contains;

namespace {

std::uint32_t up_to(std::uint32_t most) { return *rc::gen::inRange(1u, most + 1); }

CachedCrowd some_crowd()
{
    CachedCrowd crowd;
    crowd.frame_count = up_to(60);
    crowd.character_count = up_to(300);
    crowd.limbs.resize(up_to(4));
    if (*rc::gen::arbitrary<bool>()) crowd.limbs.back().setup.features = SWIVEL_WITH_MOST_SWIVEL;
    crowd.chunk = {up_to(20), 16 * up_to(6)};
    return crowd;
}

// Where a chunk is, as a number that orders work.
std::pair<std::uint32_t, std::uint32_t> in_order(ChunkAt at) { return {at.column, at.time}; }

// A replay goes through the characters in another order.
std::multiset<std::string> sorted_lines(const fs::path& path)
{
    std::istringstream text(slurp(path));
    std::multiset<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.insert(line);
    return lines;
}

}  // namespace

TEST_CASE("Chunks hold whole blocks, cover the crowd and depend on nothing else")
{
    rc::prop("chunk_shape", [] {
        const std::uint32_t frames = up_to(100'000), characters = up_to(10'000'000), limbs = up_to(4);
        const ChunkShape shape = chunk_shape(frames, characters, limbs);
        RC_ASSERT(shape.frames >= 1 && shape.frames <= frames);
        RC_ASSERT(shape.characters % SWIVEL_LANES == 0);
        RC_ASSERT(std::uint64_t{shape.frames} * shape.characters * limbs <= 65'536u);
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
            const std::vector<ChunkAt> mine = chunks_of(crowd, {index, count, ""});
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

TEST_CASE("Chunks are read back, and cut or packed wrongly they are known")
{
    const TempFolder folder;
    rc::prop("ZarrStore", [&] {
        const bool is_packed = *rc::gen::arbitrary<bool>();
        const ZarrStore store(PlainFolder(folder.path, "is gone"), is_packed);
        const std::uint64_t count = up_to(2000);
        const ZarrArray array{"numbers", "<u4", {"n"}, {count}, {count}, "any"};
        store.write_array(array);
        store.require(array);
        const auto numbers =
            *rc::gen::container<std::vector<std::uint32_t>>(count, rc::gen::arbitrary<std::uint32_t>());
        std::vector<std::uint32_t> found(count);
        const auto read = [&] { return store.read_chunk(array, {0}, std::as_writable_bytes(std::span(found))); };
        fs::remove(store.chunk_path(array, {0}));
        RC_ASSERT(read() == ChunkRead::missing);
        const std::size_t size = store.write_chunk(array, {0}, bytes_in(numbers));
        RC_ASSERT(fs::file_size(store.chunk_path(array, {0})) == size);
        RC_ASSERT(read() == ChunkRead::whole);
        RC_ASSERT(found == numbers);
        fs::resize_file(store.chunk_path(array, {0}), *rc::gen::inRange<std::size_t>(0, size));
        RC_ASSERT(read() == ChunkRead::damaged);
    });
}

TEST_CASE("A crowd goes through store, fill, check and replay with the bits of solve")
{
    const CacheStage stage;
    require_done(stage.run({"fill", "cache", "--shard", "2/2"}));
    const Outcome early = stage.run({"check", "cache"});
    CHECK(early.exit_code == 1);
    CHECK_THAT(early.err, Contains("chunks are not done, the first is 0.0; run swivel fill --resume"));
    require_done(stage.run({"fill", "cache", "--resume"}));
    const auto filled = stage.files();
    require_done(stage.run({"fill", "cache", "--verify"}));
    CHECK(stage.files() == filled);
    require_done(stage.run({"check", "cache"}));
    require_done(stage.run({"replay", "cache", "--out", "replayed.csv"}));
    require_done(stage.run(stage.with_crowd({"solve", "clip.bvh", "--out", "solved.csv"})));
    CHECK(sorted_lines(stage.folder / "replayed.csv") == sorted_lines(stage.folder / "solved.csv"));
}

TEST_CASE("A fill goes on in the middle of a crowd that carries state")
{
    const CacheStage stage;
    require_done(stage.run({"fill", "cache"}));
    const auto filled = stage.files();
    fs::remove(stage.folder / "cache/digest/1.1");
    fs::remove(stage.folder / "cache/elbow/1.0.1.0");
    require_done(stage.run({"fill", "cache", "--resume"}));
    CHECK(stage.files() == filled);
    require_done(stage.run({"replay", "cache", "--frames", "1:2", "--quiet"}));
}

TEST_CASE("A bit that turns over is named, in poses mended, in goals reported")
{
    const CacheStage stage;
    require_done(stage.run({"fill", "cache"}));
    const auto filled = stage.files();
    for (const char* name : {"shoulder/1.0.2.0", "flags/1.0.2", "state/normal/1.0.2.0", "digest/1.2"}) {
        stage.flip(name);
        const Outcome mended = stage.run({"check", "cache"});
        CHECK(mended.exit_code == 1);
        CHECK_THAT(mended.err, Contains("1 of 6 chunks were damaged and are written again, the first is 1.2: "));
        CHECK(stage.files() == filled);
    }
    for (const char* name : {"clip/wrist/0.0.0", "character/start/2", "chosen/1.0.2"}) {
        stage.flip(name);
        for (const char* command : {"check", "replay"}) {
            const Outcome reported = stage.run({command, "cache"});
            CHECK(reported.exit_code == 1);
            CHECK_THAT(reported.err, Contains(std::string(name) + ": is damaged; goals cannot be computed again"));
        }
        stage.flip(name);
    }
    CHECK(stage.files() == filled);
}

TEST_CASE("Limbs with different numbers of twist bones go on, are replayed and are proved by their digests")
{
    const std::string toml =
        "[limb.left_arm]\ntwist_bones = 1\n[limb.right_arm]\ntwist_bones = 2\n"
        "[limb.arms.swivel]\nmost_deg_per_frame = 3\n";
    const CacheStage stage(toml), poses(toml, "poses");
    require_done(stage.run({"fill", "cache"}));
    const auto filled = stage.files();
    fs::remove(stage.folder / "cache/digest/1.1");
    require_done(stage.run({"fill", "cache", "--resume"}));
    CHECK(stage.files() == filled);
    require_done(stage.run({"replay", "cache", "--frames", "1:2"}));
    require_done(poses.run({"fill", "cache"}));
    require_done(poses.run({"check", "cache"}));
    CHECK_THAT(poses.run({"check", "cache"}).out, Contains("6 chunks: their poses have their digests"));
}

TEST_CASE("State that is damaged is taken up by nobody")
{
    const CacheStage stage;
    require_done(stage.run({"fill", "cache"}));
    const auto filled = stage.files();
    stage.flip("state/normal/0.0.1.0");
    const std::string what = "the state after chunk 0.1 is missing or damaged; run swivel fill --verify";
    stage.require_refused({"replay", "cache", "--frames", "1:2"}, what);
    fs::remove(stage.folder / "cache/digest/1.1");
    stage.require_refused({"fill", "cache", "--resume"}, what);
    require_done(stage.run({"fill", "cache", "--verify"}));
    CHECK(stage.files() == filled);
}

TEST_CASE("Goals that are gone are never taken for zeros")
{
    const CacheStage stage;
    require_done(stage.run({"fill", "cache"}));
    fs::remove(stage.folder / "cache/clip/wrist/0.0.0");
    spill(stage.folder / "cache/goal_digest/clip/wrist/0.0.0", std::string(8, '\0'));
    for (const char* command : {"check", "replay"})
        stage.require_refused({command, "cache"}, "goal_digest: was changed: its digest is another");
    fs::remove(stage.folder / "cache/goal_digest/clip/wrist/0.0.0");
    stage.require_refused({"check", "cache"}, "goal_digest/clip/wrist/0.0.0: is missing or damaged");
}

TEST_CASE("A cache of poses keeps poses and characters, and what an interrupted end left is removed")
{
    const CacheStage stage(kLimited, "poses");
    require_done(stage.run({"fill", "cache"}));
    fs::copy(stage.folder / "cache", stage.folder / "goals", fs::copy_options::recursive);
    require_done(stage.run({"check", "cache"}));
    const auto closed = stage.files();
    CHECK(std::ranges::none_of(closed, [](const auto& file) {
        return file.first.starts_with("clip/") || file.first.starts_with("state/") || file.first.starts_with("chosen/");
    }));
    CHECK(closed.contains("character/size/2"));
    fs::copy(stage.folder / "goals/clip", stage.folder / "cache/clip", fs::copy_options::recursive);
    spill(stage.folder / "cache/shoulder/.swivel-1-0", "a writer was killed");
    require_done(stage.run({"check", "cache"}));
    CHECK(stage.files() == closed);
    stage.flip("character/size/2");
    stage.require_refused({"check", "cache"}, "character/size/2: is damaged");
}

TEST_CASE("A store that another left unfinished is not taken up")
{
    const CacheStage stage;
    fs::create_directory(stage.folder / fmt::format(".swivel-{}-0", ::getpid()));
    spill(stage.folder / fmt::format(".swivel-{}-0/junk", ::getpid()), "of another process");
    require_done(stage.run(stage.with_crowd({"store", "clip.bvh", "second", "--chunk", "1,16"})));
    CHECK(contents(stage.folder / "second") == stage.files());
    CHECK(fs::exists(stage.folder / fmt::format(".swivel-{}-0/junk", ::getpid())));
    const std::string longest(255, 'n');
    require_done(stage.run(stage.with_crowd({"store", "clip.bvh", longest})));
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
        {"clip_frames is 3", [](CachedCrowd& crowd) { crowd.clip_frames = 3; }},
        {"a joint comes before its parent", [](CachedCrowd& crowd) { crowd.joints[1].parent = 77; }},
        {"a limb's joints are not three",
         [](CachedCrowd& crowd) {
             crowd.limbs[1].joints = {99, 1, 2};
         }},
        {"a limb's joints are not three", [](CachedCrowd& crowd) { crowd.limbs[1].joints.clear(); }},
        {"unknown features: bits 0x8000000000000000",
         [](CachedCrowd& crowd) { crowd.limbs[0].setup.features |= std::uint64_t{1} << 63; }},
        {"SWIVEL_WITH_CLAVICLE needs SWIVEL_WORLD",
         [](CachedCrowd& crowd) {
             crowd.limbs[0].setup.features = SWIVEL_WITH_CLAVICLE | (crowd.limbs[0].setup.features & ~SWIVEL_WORLD);
         }},
        {"shoulder_order is 6, not a number from 0 to 5",
         [](CachedCrowd& crowd) { crowd.limbs[0].setup.shoulder_order = static_cast<swivel_euler_order>(6); }},
        {"field is 264, not a number from 0 to 263",
         [](CachedCrowd& crowd) { crowd.limbs[0].setup.fields[0].field = SWIVEL_RESULT_END; }},
        {"shoulder is a result", [](CachedCrowd& crowd) { crowd.limbs[0].setup.fields[0].field = SWIVEL_SHOULDER; }},
        {"twist_bone_count is 8", [](CachedCrowd& crowd) { crowd.limbs[0].setup.binding.twist_bone_count = 8; }},
        {"pole is 3", [](CachedCrowd& crowd) { crowd.limbs[0].setup.goals.pole = 3; }},
        {"is_mirrored is 2", [](CachedCrowd& crowd) { crowd.limbs[0].setup.goals.is_mirrored = 2; }},
        {"holds a quaternion not of unit length",
         [](CachedCrowd& crowd) { crowd.limbs[1].setup.binding.elbow_rest[0] = 7; }}};
    CHECK_NOTHROW(crowd_of_attributes(attributes_of(whole), path));
    for (const auto& [what, change] : changes) {
        CachedCrowd changed = whole;
        change(changed);
        CHECK_THROWS_WITH(crowd_of_attributes(attributes_of(changed), path), Contains(what));
    }
}
