// SPDX-License-Identifier: MIT
//
// The promise: a cache is cut in the same way whoever fills it; shards share nothing and leave nothing out; no damage
// of a file goes unnoticed; poses of other goals stay; and a crowd goes through store, fill, check, replay and solve
// with the same bits.
#include <rapidcheck/catch.h>
#include <catch2/catch.hpp>

#include <set>

#include "tests/cache_stage.h"
#include "tools/cache/cache_attributes.h"
#include "tools/cache/digest.h"
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

// From xxHash's own tests, release 0.8: its stream of bytes, and XXH3 of their first so many, without a seed.
TEST_CASE("Digests are XXH3")
{
    std::vector<std::byte> bytes(2367);
    std::uint64_t generator = 2654435761u;
    for (std::byte& each : bytes) {
        each = static_cast<std::byte>(generator >> 56);
        generator *= 11400714785074694797u;
    }
    const std::pair<std::size_t, std::uint64_t> published[] = {
        {0, 0x2d06800538d394c2},   {1, 0xc44bdff4074eecdb},   {6, 0x27b56a84cd2d7325},    {12, 0xa713daf0dfbb77e7},
        {24, 0xa3fe70bf9d3510eb},  {48, 0x397da259ecba1f11},  {80, 0xbcdefbbb2c47c90a},   {195, 0xcd94217ee362ec3a},
        {403, 0xcdeb804d65c6dea4}, {512, 0x617e49599013cb6b}, {2048, 0xdd59e2c3a5f038e0}, {2367, 0xcb37aeb9e5d361ed}};
    for (const auto& [size, digest] : published) CHECK(digest_of(std::span(bytes).first(size)) == digest);
}

TEST_CASE("A crowd goes through store, fill, check and replay with the bits of solve")
{
    const CacheStage stage;
    require_done(stage.run({"fill", "cache", "--shard", "2/2"}));
    stage.require_refused({"replay", "cache"}, "chunk 0.0 is not done, so nothing proves it; run swivel fill");
    require_done(stage.run({"fill", "cache"}));
    const auto filled = stage.files();
    require_done(stage.run({"check", "cache"}));
    CHECK(stage.files() == filled);
    require_done(stage.run({"replay", "cache", "--out", "replayed.csv"}));
    require_done(stage.run(stage.with_crowd({"solve", "clip.bvh", "--out", "solved.csv"})));
    CHECK(sorted_lines(stage.folder / "replayed.csv") == sorted_lines(stage.folder / "solved.csv"));
}

TEST_CASE("A fill goes on in the middle of a crowd that carries state, with different numbers of twist bones, too")
{
    const std::string twisted =
        "[limb.left_arm]\ntwist_bones = 1\n[limb.right_arm]\ntwist_bones = 2\n"
        "[limb.arms.swivel]\nmost_deg_per_frame = 3\n";
    for (const std::string& toml : {kLimited, twisted}) {
        const CacheStage stage(toml);
        require_done(stage.run({"fill", "cache"}));
        const auto filled = stage.files();
        for (const char* column : {"0", "1", "2"}) {
            fs::remove(stage.folder / ("cache/digest/1." + std::string(column)));
            fs::remove(stage.folder / ("cache/elbow/1.0." + std::string(column) + ".0"));
        }
        require_done(stage.run({"fill", "cache"}));
        CHECK(stage.files() == filled);
        require_done(stage.run({"replay", "cache", "--frames", "1:2"}));
    }
}

TEST_CASE("A limb with bad input has the same bits whichever frames were solved before")
{
    const CacheStage stage("[limb.arms.reach]\nmost_stretch = 1.2\n");
    spill(stage.folder / "t.csv", "frame,character,limb,x,y,z\n0,3,left_arm,90,0,0\n1,3,left_arm,1e300,0,0\n");
    require_done(stage.run(stage.with_crowd({"store", "clip.bvh", "bad", "--chunk", "1,16", "--targets", "t.csv"})));
    require_done(stage.run({"fill", "bad", "--threads", "1"}));
    require_done(stage.run({"replay", "bad", "--frames", "1:2"}));
}

TEST_CASE("What is changed, cut or gone is named, in poses mended, in goals reported")
{
    const CacheStage stage;
    require_done(stage.run({"fill", "cache"}));
    const auto filled = stage.files();
    const auto damage = [&](int kind, const std::string& name) {
        const fs::path path = stage.folder / ("cache/" + name);
        if (kind == 0) stage.flip(name);
        if (kind == 1) fs::resize_file(path, 3);
        if (kind == 2) fs::remove(path);
    };
    const std::tuple<const char*, const char*, const char*> poses[] = {
        {"shoulder/1.0.2.0", "shoulder differs", "a file of its poses is missing"},
        {"flags/1.0.2", "flags differs", "a file of its poses is missing"},
        {"state/normal/1.0.2.0", "a file of its state is missing", "a file of its state is missing"},
        {"digest/1.2", "digest differs", "is not done"}};
    for (const auto& [name, changed, gone] : poses)
        for (int kind = 0; kind < 3; ++kind) {
            damage(kind, name);
            stage.require_refused({"check", "cache"},
                                  std::string("1 of 6 chunks were not right and are written again, ") +
                                      "the first is 1.2: " + (kind == 0 ? changed : gone));
            CHECK(stage.files() == filled);
        }
    for (const char* name : {"clip/wrist/0.0.0", "clip/position/0.0.0", "character/start/2", "character/place/1.0"})
        for (int kind = 0; kind < 3; ++kind) {
            damage(kind, name);
            const auto damaged = stage.files();
            for (const char* command : {"check", "replay"})
                stage.require_refused({command, "cache"}, std::string(name) +
                                                              (kind == 2 ? ": is missing" : ": is damaged") +
                                                              "; goals cannot be computed again");
            CHECK(stage.files() == damaged);
            spill(stage.folder / ("cache/" + std::string(name)), filled.at(name));
        }
}

TEST_CASE("State that is damaged is taken up by nobody, and check makes it again")
{
    const CacheStage stage;
    require_done(stage.run({"fill", "cache"}));
    const auto filled = stage.files();
    stage.flip("state/normal/0.0.1.0");
    const std::string what = "the state after chunk 0.1 is missing or damaged; run swivel check";
    stage.require_refused({"replay", "cache", "--frames", "1:2"}, what);
    fs::remove(stage.folder / "cache/digest/1.1");
    stage.require_refused({"fill", "cache"}, what);
    stage.require_refused({"check", "cache"}, "2 of 6 chunks were not right and are written again");
    CHECK(stage.files() == filled);
}

TEST_CASE("Goals of another crowd, whole in themselves, do not overwrite poses")
{
    const CacheStage stage;
    require_done(stage.run({"fill", "cache"}));
    require_done(stage.run(stage.with_crowd({"store", "clip.bvh", "other", "--chunk", "1,16", "--seed", "7"})));
    for (const char* name : {"character", "goal_digest", ".zattrs"}) {
        fs::remove_all(stage.folder / "cache" / name);
        fs::copy(stage.folder / "other" / name, stage.folder / "cache" / name, fs::copy_options::recursive);
    }
    const auto mixed = stage.files();
    stage.require_refused({"check", "cache", "--quiet"}, "the goals may be another crowd's");
    CHECK(stage.files() == mixed);
}

TEST_CASE("A cache without poses is filled, checked and replayed, and a digest that differs stays")
{
    const CacheStage both;
    require_done(both.run({"fill", "cache"}));
    require_done(both.run({"replay", "cache", "--out", "both.csv"}));
    require_done(both.run(both.with_crowd({"store", "clip.bvh", "goals", "--chunk", "1,16", "--no-poses"})));
    require_done(both.run({"fill", "goals"}));
    require_done(both.run({"check", "goals"}));
    require_done(both.run({"replay", "goals", "--out", "goals.csv"}));
    CHECK(slurp(both.folder / "goals.csv") == slurp(both.folder / "both.csv"));
    CHECK_FALSE(fs::exists(both.folder / "goals/shoulder"));
    fs::copy_file(both.folder / "goals/digest/0.0", both.folder / "goals/digest/1.2",
                  fs::copy_options::overwrite_existing);
    both.require_refused({"check", "goals"},
                         "1 of 6 chunks are not what the goals give, the first is 1.2: digest differs");
    fs::remove(both.folder / "goals/digest/1.2");
    require_done(both.run({"fill", "goals"}));
    require_done(both.run({"check", "goals"}));
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
             crowd.look.emplace().setup.look = swivel_default_look();
             crowd.look->setup.look->joint_count = 1;
             crowd.look->setup.goals.holds = 1;
         }},
        {"quaternion", [](CachedCrowd& crowd) { std::ranges::fill(crowd.limbs[1].setup.chain.elbow_rotation, 0.0f); }}};
    CHECK_NOTHROW(crowd_of_attributes(attributes_of(whole), path));
    for (const auto& [what, change] : changes) {
        CachedCrowd changed = whole;
        change(changed);
        CHECK_THROWS_WITH(crowd_of_attributes(attributes_of(changed), path), Contains(what));
    }
}
