// SPDX-License-Identifier: MIT
//
// The promise: a cache stays in its folder. Links and pipes in it are refused or replaced, never followed. Numbers in
// it ask for no more memory than is given. Nothing is removed but what a cache writes.
#include <catch2/catch.hpp>

#include <sys/stat.h>

#include "tests/cache_stage.h"
#include "tools/cache/cache_attributes.h"
#include "tools/cache/digest.h"

using namespace swivel;
using namespace swivel::test;
using namespace swivel::tools;
using Catch::Matchers::Contains;

namespace {

const std::string kPlain = "[limb.arms]\nhand = false\n";

// A cache, and a folder outside it that must stay as it is.
struct Outside : CacheStage {
    Outside() : CacheStage(kPlain)
    {
        fs::create_directories(folder / "elsewhere/wrist");
        spill(folder / "elsewhere/wrist/0.0.0", "not swivel's");
        spill(folder / "elsewhere/.zgroup", slurp(folder / "cache/.zgroup"));
        spill(folder / "elsewhere/file", "not swivel's");
        before_ = contents(folder / "elsewhere");
    }
    fs::path at(const std::string& name) const { return folder / ("cache/" + name); }
    // Puts a link to something outside in the place of a file or folder of the cache.
    void link(const std::string& name, const std::string& to) const
    {
        fs::remove_all(at(name));
        fs::create_symlink(folder / ("elsewhere/" + to), at(name));
    }
    bool is_unchanged() const { return contents(folder / "elsewhere") == before_; }

private:
    std::map<std::string, std::string> before_;
};

}  // namespace

TEST_CASE("Fill writes through no link")
{
    const Outside stage;
    fs::remove_all(stage.at("shoulder/0.0.0.0"));
    fs::create_symlink(stage.folder / "elsewhere/file", stage.at("shoulder/0.0.0.0"));
    require_done(stage.run({"fill", "cache"}));
    CHECK(stage.is_unchanged());
    CHECK(fs::is_regular_file(fs::symlink_status(stage.at("shoulder/0.0.0.0"))));
    require_done(stage.run({"check", "cache"}));
    stage.link("elbow", "wrist");
    stage.require_refused({"check", "cache"}, "cache/elbow: is a link, a pipe or a device");
    CHECK(stage.is_unchanged());
}

TEST_CASE("Check goes through no link")
{
    for (const char* name : {"clip", "goal_digest", "elbow"}) {
        const Outside stage;
        require_done(stage.run({"fill", "cache"}));
        stage.link(name, ".");
        stage.require_refused({"check", "cache"}, std::string("cache/") + name + ": is a link, a pipe or a device");
        CHECK(stage.is_unchanged());
    }
}

TEST_CASE("Check removes what writers left, and files of their names alone")
{
    const Outside stage;
    require_done(stage.run({"fill", "cache"}));
    const char* const kept[] = {"elbow/notes.txt", "elbow/.swivel-1", "elbow/.swivel-a-0", ".swivel-notes",
                                "clip/.swivel-1-2"};
    for (const char* name : kept) spill(stage.at(name), "mine");
    const auto before = stage.files();
    for (const char* name : {"elbow/.swivel-17-0", "digest/.swivel-17-12"}) spill(stage.at(name), "left");
    require_done(stage.run({"check", "cache"}));
    CHECK(stage.files() == before);
}

TEST_CASE("A pipe keeps nobody waiting")
{
    const Outside stage;
    require_done(stage.run({"fill", "cache"}));
    for (const char* name : {".zattrs", "clip/wrist/0.0.0", "digest/0.0", "elbow/.zarray", "character/size/1"}) {
        const std::string whole = slurp(stage.at(name));
        fs::remove(stage.at(name));
        REQUIRE(::mkfifo(stage.at(name).c_str(), 0600) == 0);
        Surroundings surroundings;
        surroundings.max_seconds = 20;
        const Outcome outcome = spawn_command(stage.folder.path, {"check", "cache", "--quiet"}, surroundings);
        CHECK(outcome.exit_code == 1);
        CHECK_THAT(outcome.err, Contains(std::string("cache/") + name + ": is a link, a pipe or a device"));
        fs::remove(stage.at(name));
        spill(stage.at(name), whole);
    }
}

TEST_CASE("Numbers of a crowd take no more memory than is given")
{
    const Outside stage;
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

TEST_CASE("Attributes that are long or deep are refused")
{
    const Outside stage;
    const std::string deep(1'000'000, '[');
    spill(stage.at(".zattrs"), "{\"swivel_cache\": 3, \"a\": " + deep + std::string(1'000'000, ']') + "}");
    stage.require_refused({"check", "cache"}, ".zattrs: has too many lists within lists");
    spill(stage.at(".zattrs"), std::string(5 << 20, ' '));
    stage.require_refused({"check", "cache"}, ".zattrs: is longer than 4194304 bytes");
    spill(stage.at(".zattrs"), "{\"swivel_cache\": 1}");
    stage.require_refused({"check", "cache"},
                          "the cache has format 1, this swivel reads format 9; make it anew by swivel store");
}
