// SPDX-License-Identifier: MIT
//
// The promise: no damage of a cache's files goes unnoticed, flips of the same bit in several words included. And where
// most chunks are not what the goals give, check writes nothing.
#include <rapidcheck/catch.h>
#include <catch2/catch.hpp>

#include <cstdlib>
#include <random>

#include "tests/cache_stage.h"
#include "tools/cache/digest.h"
#include "tools/cache/fill.h"
#include "tools/formats/error.h"

using namespace swivel;
using namespace swivel::test;
using namespace swivel::tools;
using Catch::Matchers::Contains;

namespace {

std::uint64_t digest_of_words(const std::vector<std::uint64_t>& words) { return digest_of(bytes_in(words)); }

// Flips bits of two or three words of a chunk, the same bit or others, and counts those that leave the digest.
std::size_t unnoticed_among(std::size_t count, std::uint32_t seed)
{
    std::mt19937_64 random(seed);
    std::size_t unnoticed = 0;
    for (const std::size_t size : {2u, 30u, 31u, 48u, 130u, 384u}) {  // words; XXH3 has other formulas for each length
        std::vector<std::uint64_t> words(size);
        for (std::uint64_t& word : words) word = random();
        const std::uint64_t before = digest_of_words(words);
        for (std::size_t n = 0; n < count / 6 + 1; ++n) {
            const std::vector<std::uint64_t> whole = words;
            const std::uint64_t bit = random() % 64;
            const bool is_same_bit = random() % 4 != 0;
            for (std::size_t flips = 2 + random() % 2; flips > 0; --flips)
                words[random() % size] ^= std::uint64_t{1} << (is_same_bit ? bit : random() % 64);
            unnoticed += words != whole && digest_of_words(words) == before;
            words = whole;
        }
    }
    return unnoticed;
}

// Whether reading all of a cache, or comparing its chunks with what the goals give, finds something wrong.
bool is_noticed(const fs::path& folder)
{
    try {
        const Cache cache(folder);
        for (const ChunkAt at : chunks_of(cache.crowd(), {})) {
            cache.characters(at.column);
            cache.goals(at);
            if (!cache.state(at) || cache.digest(at) == 0) return true;
        }
        FillOptions how;
        how.verifies = true;
        return !fill(cache, how).differences.empty();
    } catch (const formats::InputError&) {
        return true;
    }
}

}  // namespace

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

TEST_CASE("A digest sees every bit")
{
    rc::prop("digest_of", [] {
        auto bytes = *rc::gen::nonEmpty(rc::gen::arbitrary<std::vector<std::uint8_t>>());
        const auto digest = [&] { return digest_of(std::as_bytes(std::span(bytes))); };
        const std::uint64_t before = digest();
        bytes[*rc::gen::inRange<std::size_t>(0, bytes.size())] ^=
            static_cast<std::uint8_t>(1 << *rc::gen::inRange(0, 8));
        RC_ASSERT(digest() != before);
    });
}

TEST_CASE("A chunk's digest sees pairs of flips in the words of its frames")
{
    const auto digest = [](std::uint64_t first, std::uint64_t second) {
        ChunkDigest of_chunk;
        of_chunk.add({1, first});
        of_chunk.add({2, second});
        return of_chunk.value();
    };
    for (int bit = 0; bit < 64; ++bit) {
        const std::uint64_t flip = std::uint64_t{1} << bit;
        CHECK(digest(3 ^ flip, 4 ^ flip) != digest(3, 4));
    }
    CHECK(digest(3, 4) != digest(4, 3));
}

// SWIVEL_FLIPS: how many; tools/test --full cache tries ten million.
TEST_CASE("No pair or triple of flips in a chunk is unnoticed")
{
    const char* const given = std::getenv("SWIVEL_FLIPS");
    const std::size_t count = given ? std::stoul(given) : 300'000;
    CHECK(count >= 300'000);
    CHECK(unnoticed_among(count, 1) == 0);
}

TEST_CASE("Two flips of any bit in a file are noticed: of goals, poses, state and attributes")
{
    const CacheStage stage;
    require_done(stage.run({"fill", "cache"}));
    REQUIRE_FALSE(is_noticed(stage.folder / "cache"));
    for (const char* name :
         {"clip/wrist/0.0.0", "clip/parent/0.0.0", "character/place/1", "goal_digest/clip/hand/0.0.0",
          "goal_digest/chosen/0.0.0", "shoulder/1.0.2.0", "flags/1.0.1", "state/normal/0.0.1.0", ".zattrs"}) {
        const fs::path path = stage.folder / ("cache/" + std::string(name));
        const std::string whole = slurp(path);
        for (std::size_t bit = 0; bit < 64; ++bit) {
            std::string damaged = whole;
            const std::size_t last = std::max<std::size_t>(whole.size() / 8, 1) - 1;  // word
            for (const std::size_t word : {std::size_t{0}, last})
                damaged[8 * word + bit / 8] = static_cast<char>(damaged[8 * word + bit / 8] ^ 1 << bit % 8);
            spill(path, damaged);
            const bool is_same = damaged == whole;  // a file of one word has both flips in it
            CAPTURE(name, bit);
            CHECK(is_noticed(stage.folder / "cache") != is_same);
            spill(path, whole);
        }
    }
}

TEST_CASE("Where more than half of the chunks differ, check writes nothing and suspects the goals")
{
    const CacheStage stage;
    require_done(stage.run({"fill", "cache"}));
    const auto filled = stage.files();
    const auto damage = [&](std::initializer_list<const char*> chunks) {
        for (const char* chunk : chunks) stage.flip(std::string("shoulder/") + chunk + ".0");
    };
    damage({"0.0.0", "1.0.0", "0.0.1"});
    stage.require_refused({"check", "cache"}, "3 of 6 chunks were damaged and are written again, the first is 0.0: ");
    CHECK(stage.files() == filled);
    damage({"0.0.0", "1.0.0", "0.0.1", "1.0.2"});
    const auto damaged = stage.files();
    stage.require_refused(
        {"check", "cache", "--quiet"},
        "4 of 6 chunks differ from what the goals give, the first is 0.0: shoulder differs; the goals "
        "are suspected, or another swivel filled the cache, so nothing was written");
    CHECK(stage.files() == damaged);
    require_done(stage.run({"fill", "cache", "--verify"}));
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
    const Outcome outcome = stage.run({"check", "cache", "--json"});
    CHECK(outcome.exit_code == 1);
    CHECK_THAT(outcome.err, Contains("the goals are suspected"));
    CHECK_THAT(outcome.out, Contains("\"suspects_goals\": true"));
    CHECK_THAT(outcome.out, Contains("\"written_again\": []"));
    CHECK(stage.files() == mixed);
}
