// SPDX-License-Identifier: MIT
//
// The promise: equal inputs give equal bits. It holds for every instruction set, thread count, block range and number
// of limbs, and in any floating-point environment. Padding lanes and blocks that are not solved may hold anything. This
// checks the instruction set in use; CTest's label `isa` runs it once for each.
#include <sys/mman.h>

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "tests/solve_jobs.h"
#include "tests/test_crowd.h"
#include "tests/test_isa_scope.h"
#include "tools/corpus/corpus.h"
#include "tools/corpus/golden.h"

#ifdef SWIVEL_WITH_TBB
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#endif
#ifdef __x86_64__
#include <xmmintrin.h>
#endif

namespace {

using namespace swivel;
using namespace swivel::test;
using swivel::corpus::digest_of;
using swivel::corpus::Part;
using swivel::corpus::Recipe;
using swivel::corpus::recipe_of;
using swivel::corpus::recipes_of;

constexpr std::uint32_t kPoison = 0x7fa5a5a5u;  // a signalling NaN

void solve(Crowd& crowd) { crowd.solve(); }

void solve_in_ranges(Crowd& crowd, std::uint32_t size)
{
    const std::uint32_t blocks = swivel_block_count(crowd.get());
    for (std::uint32_t first = 0; first < blocks; first += size)
        crowd.solve({.blocks = swivel_blocks{first, std::min(size, blocks - first)}, .on_this_thread = true});
}

std::size_t word_count(const swivel_rows& rows)
{
    return std::size_t{rows.block_count} * rows.row_count * SWIVEL_LANES;
}

std::vector<std::uint32_t> words_of(std::span<const float> rows)
{
    std::vector<std::uint32_t> words(rows.size());
    std::memcpy(words.data(), rows.data(), words.size() * sizeof(std::uint32_t));
    return words;
}
std::vector<std::uint32_t> words_of(const swivel_rows& rows)
{
    return words_of(std::span<const float>(rows.base, word_count(rows)));
}

void poison(float* at) { std::memcpy(at, &kPoison, sizeof kPoison); }
void poison(std::span<float> rows)
{
    for (float& at : rows) poison(&at);
}
void poison(const swivel_rows& rows) { poison(std::span(rows.base, word_count(rows))); }

// Calls act(lane) for each lane of a group's rows that belongs to no limb.
template <class Act>
void for_each_padding_lane(const Crowd& crowd, std::uint32_t group, const swivel_rows& rows, Act act)
{
    for (std::size_t limb = swivel_group_limb_count(crowd.get(), group); limb < rows.block_count * SWIVEL_LANES; ++limb)
        for (std::uint32_t row = 0; row < rows.row_count; ++row)
            act(rows.base + ((limb / SWIVEL_LANES) * rows.row_count + row) * SWIVEL_LANES + limb % SWIVEL_LANES);
}

// Crowds for the promises that batching keeps and no kernel does: threads, chunks, choices. They are plain arms with
// and without every feature, and whole limbs, some of which keep their swivel from frame to frame.
std::vector<const Recipe*> few_crowds()
{
    return {&recipe_of(Part::ordinary, "world-joints-hand"), &recipe_of(Part::hard, "arms"),
            &recipe_of(Part::hard, "world-joints-hand-direction"),
            &recipe_of(Part::limbs, "set-world-joints-normal-angle-step"), &recipe_of(Part::limbs, "set-all-limits")};
}
// Limbs enough for several chunks of any of them.
std::uint32_t large(const Recipe& recipe) { return recipe.part == Part::limbs ? 1000 : 8000; }

// What the scalar build gives for crowds of these sizes.
template <class Solve>
std::uint64_t scalar_digest(const IsaScope& scope, const Recipe& recipe, std::uint32_t limb_count, Solve act)
{
    REQUIRE(swivel_use_isa("scalar") == SWIVEL_OK);
    const std::uint64_t digest = digest_of(recipe, act, limb_count);
    REQUIRE(swivel_use_isa(scope.before.c_str()) == SWIVEL_OK);
    return digest;
}

}  // namespace

TEST_CASE("the instruction set that was forced is the one in use")
{
    const char* forced = std::getenv("SWIVEL_FORCE_ISA");
    if (forced && *forced)
        REQUIRE(std::string(swivel_isa_name()) == forced);
    else
        REQUIRE(swivel_isa_name() == runnable_isas().front());
}

TEST_CASE("the instruction set in use gives the golden digests")
{
    for (const Part part : corpus::kParts) {
        const std::vector<std::uint64_t> digests = corpus::digests_of(part, solve);
        CHECK(corpus::wrong_crowds(part, digests) == std::vector<std::string>{});
        CHECK(corpus::fold(digests) == corpus::kGoldenDigests[static_cast<std::size_t>(part)]);
    }
}

TEST_CASE("every block range gives the golden digests")
{
    std::vector<const Recipe*> crowds = few_crowds();
    for (const Recipe& recipe : recipes_of(Part::hard)) crowds.push_back(&recipe);
    for (const Recipe* recipe : crowds)
        for (const std::uint32_t size : {1u, 2u, 3u, 5u, 7u, ~0u}) {
            INFO(full_name(*recipe) << ", ranges of " << size);
            CHECK(digest_of(*recipe, [&](Crowd& crowd) { solve_in_ranges(crowd, size); }) == golden_of(*recipe));
        }
}

TEST_CASE("every number of limbs gives the scalar build's digest")
{
    const IsaScope scope;
    for (const Part part : corpus::kParts)
        for (const Recipe& recipe : recipes_of(part))
            for (const std::uint32_t limb_count : {1u, 15u, 16u, 17u, 33u}) {
                INFO(full_name(recipe) << ", " << limb_count << " limbs");
                CHECK(digest_of(recipe, solve, limb_count) == scalar_digest(scope, recipe, limb_count, solve));
            }
}

TEST_CASE("a limb has the same bits wherever it stands in the crowd")
{
    const std::uint32_t count = 70;
    for (const Recipe* recipe :
         {&recipe_of(Part::hard, "arms"), &recipe_of(Part::hard, "world-hand"),
          &recipe_of(Part::limbs, "set-both-boxes"), &recipe_of(Part::limbs, "set-world-hand-twists")}) {
        Crowd crowd = make_crowd(*recipe, count);
        crowd.solve();
        const swivel_rows in = swivel_input_rows(crowd.get(), 0), out = swivel_result_rows(crowd.get(), 0);
        const std::vector<std::uint32_t> inputs = words_of(in), results = words_of(out);
        for (std::uint32_t shift = 1; shift < 64; shift += 5) {  // limb n goes to lane n + shift, round the first group
            const auto place = [](const swivel_rows& rows, std::uint32_t limb, std::uint32_t row) {
                return (std::size_t{limb / SWIVEL_LANES} * rows.row_count + row) * SWIVEL_LANES + limb % SWIVEL_LANES;
            };
            for (std::uint32_t n = 0; n < count; ++n)
                for (std::uint32_t row = 0; row < in.row_count; ++row)
                    std::memcpy(in.base + place(in, (n + shift) % count, row), &inputs[place(in, n, row)],
                                sizeof(float));
            crowd.solve();
            const std::vector<std::uint32_t> moved = words_of(out);
            std::size_t wrong = 0;
            for (std::uint32_t n = 0; n < count; ++n)
                for (std::uint32_t row = 0; row < out.row_count; ++row)
                    wrong += moved[place(out, (n + shift) % count, row)] != results[place(out, n, row)];
            INFO(full_name(*recipe) << ", shift " << shift);
            CHECK(wrong == 0);
        }
    }
}

#ifdef SWIVEL_WITH_TBB
TEST_CASE("every number of threads gives the scalar build's bits")
{
    const IsaScope scope;
    for (const Recipe* recipe : few_crowds()) {
        const std::uint64_t expected =
            scalar_digest(scope, *recipe, large(*recipe), [](Crowd& crowd) { solve_in_ranges(crowd, ~0u); });
        for (const int threads : {1, 2}) {
            INFO(full_name(*recipe) << ", " << threads << " threads");
            using oneapi::tbb::global_control;
            const global_control control(global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
            oneapi::tbb::task_arena arena(threads);
            const auto solve_there = [&](Crowd& crowd) { arena.execute([&] { crowd.solve(); }); };
            CHECK(digest_of(*recipe, solve_there, large(*recipe)) == expected);
        }
    }
}
#endif

TEST_CASE("blocks outside the range are not written, and what lies in them does not matter")
{
    for (const Recipe& recipe : recipes_of(Part::hard)) {
        if (recipe.features & corpus::kCompact) continue;  // only what is digested differs
        Crowd whole = make_crowd(recipe, 200);
        whole.solve();
        const std::vector<std::span<float>> expected = block_rows(whole, swivel_result_rows);
        REQUIRE(expected.size() == 21);
        for (const auto& [first, count] :
             {std::pair{0u, 1u}, {1u, 4u}, {3u, 9u}, {12u, 2u}, {13u, 8u}, {5u, 0u}, {0u, 21u}}) {
            Crowd crowd = make_crowd(recipe, 200);
            const auto in = block_rows(crowd, swivel_input_rows), out = block_rows(crowd, swivel_result_rows);
            std::vector<std::vector<std::uint32_t>> before;
            for (std::size_t block = 0; block < 21; ++block) {
                poison(out[block]);
                if (block < first || block >= first + count) poison(in[block]);
                before.push_back(words_of(in[block]));
            }
            crowd.solve({.blocks = swivel_blocks{first, count}, .on_this_thread = true});
            INFO(full_name(recipe) << ", blocks " << first << " + " << count);
            for (std::size_t block = 0; block < 21; ++block) {
                const bool inside = block >= first && block < first + count;
                const std::vector<std::uint32_t> results = words_of(out[block]);
                CHECK(results ==
                      (inside ? words_of(expected[block]) : std::vector<std::uint32_t>(results.size(), kPoison)));
                CHECK(words_of(in[block]) == before[block]);
            }
        }
    }
}

TEST_CASE("blocks outside the range are not even read")
{
    // Rows of 512 and 448 bytes a block: 64 blocks of either are whole pages, and all but the middle 64 are locked
    // away.
    constexpr std::size_t page = 4096;
    constexpr std::uint32_t blocks = 192, first = 64, count = 64;
    const swivel_group_def group = swivel::group(blocks * SWIVEL_LANES);
    swivel_crowd_def def = swivel_default_crowd_def();
    def.group_count = 1;
    def.groups = &group;
    const std::size_t bytes = swivel_crowd_bytes(&def), room = (bytes / page + 3) * page;
    char* const pages =
        static_cast<char*>(mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    REQUIRE(pages != MAP_FAILED);

    const std::size_t rows_bytes = blocks * (8 + 7) * SWIVEL_LANES * sizeof(float);
    def.memory = pages + 2 * page - (bytes - rows_bytes);  // so that the input rows start a page
    def.memory_bytes = bytes;
    swivel_crowd* crowd = nullptr;
    REQUIRE(swivel_crowd_create(&def, &crowd) == SWIVEL_OK);
    const swivel_rows in = swivel_input_rows(crowd, 0), out = swivel_result_rows(crowd, 0);
    REQUIRE(in.row_count == 8);
    REQUIRE(out.row_count == 7);
    REQUIRE(reinterpret_cast<char*>(in.base) == pages + 2 * page);
    REQUIRE(reinterpret_cast<char*>(out.base) == pages + 2 * page + word_count(in) * sizeof(float));

    const float target[] = {0, 1, 1}, lengths[] = {1, 1};
    REQUIRE(swivel_write(crowd, SWIVEL_TARGET, 0, 0, blocks * SWIVEL_LANES, {target, 0}) == SWIVEL_OK);
    REQUIRE(swivel_write(crowd, SWIVEL_LENGTHS, 0, 0, blocks * SWIVEL_LANES, {lengths, 0}) == SWIVEL_OK);
    const auto lock_outside = [&](const swivel_rows& rows, int rights) {
        const std::size_t part = word_count(rows) * sizeof(float) / 3;
        REQUIRE(part % page == 0);
        char* const base = reinterpret_cast<char*>(rows.base);
        REQUIRE(mprotect(base, part, rights) == 0);
        REQUIRE(mprotect(base + 2 * part, part, rights) == 0);
    };
    poison(out);
    lock_outside(in, PROT_NONE);
    lock_outside(out, PROT_NONE);
    CHECK(solve_blocks(crowd, first, count) == SWIVEL_OK);
    lock_outside(in, PROT_READ | PROT_WRITE);
    lock_outside(out, PROT_READ | PROT_WRITE);
    const std::vector<std::uint32_t> results = words_of(out);
    CHECK(static_cast<std::size_t>(std::count(results.begin(), results.end(), kPoison)) == results.size() * 2 / 3);
    swivel_crowd_destroy(crowd);
    munmap(pages, room);
}

TEST_CASE("padding lanes may hold anything, stay as they are and change nothing")
{
    for (const Recipe* recipe : few_crowds())
        for (const std::uint32_t word : {0x7fc00000u, kPoison, 0xffffffffu, 0x7f800000u, 0x00000001u, 0x00000000u}) {
            INFO(full_name(*recipe) << ", padding of " << word);
            const auto fill_and_solve = [&](Crowd& crowd) {
                std::vector<std::vector<std::uint32_t>> before;
                for (std::uint32_t group = 0; group < 3; ++group) {
                    const swivel_rows rows = swivel_input_rows(crowd.get(), group);
                    for_each_padding_lane(crowd, group, rows,
                                          [&](float* lane) { std::memcpy(lane, &word, sizeof word); });
                    before.push_back(words_of(rows));
                }
                crowd.solve();
                for (std::uint32_t group = 0; group < 3; ++group)
                    CHECK(words_of(swivel_input_rows(crowd.get(), group)) == before[group]);
            };
            CHECK(digest_of(*recipe, fill_and_solve) == golden_of(*recipe));
        }
}

TEST_CASE("solving twice, and over poisoned results, gives the same bits")
{
    for (const Recipe& recipe : recipes_of(Part::hard)) {
        INFO(full_name(recipe));
        const std::uint64_t digest = digest_of(recipe, [](Crowd& crowd) {
            for (const std::span<float> block : block_rows(crowd, swivel_result_rows)) poison(block);
            crowd.solve();
            crowd.solve();
        });
        CHECK(digest == golden_of(recipe));
    }
}

#ifdef __x86_64__
TEST_CASE("the caller's floating-point environment changes no bit and is put back, sticky flags included")
{
    constexpr unsigned normal = 0x1f80, ftz = 0x8000, daz = 0x0040, up = 0x4000, down = 0x2000, to_zero = 0x6000,
                       masks = 0x1f80, sticky = 0x003f;
    const std::pair<const char*, unsigned> environments[] = {
        {"as usual", normal},
        {"flush to zero", normal | ftz},
        {"denormals are zero", normal | daz},
        {"both", normal | ftz | daz},
        {"round up", normal | up},
        {"round down", normal | down},
        {"round to zero", normal | to_zero},
        {"exceptions unmasked", normal & ~masks},
        {"sticky flags set", normal | sticky},
        {"one sticky flag set", normal | 0x0004},
        {"round up, one sticky flag set", normal | up | 0x0004},
        {"everything", ftz | daz | up | sticky},
    };
    for (const Recipe* recipe : few_crowds()) {
        const std::uint64_t expected = digest_of(*recipe, solve, 200);
        for (const auto& [name, flags] : environments)
            for (const bool whole : {true, false}) {
                const unsigned environment = flags;  // clang 14 captures no structured binding
                INFO(full_name(*recipe) << ", " << name << (whole ? ", swivel_solve" : ", blocks on this thread"));
                unsigned found = environment;
                const auto solve_there = [&](Crowd& crowd) {
                    swivel_crowd* const handle = crowd.get();
                    const std::uint32_t blocks = swivel_block_count(handle);
                    const unsigned before = _mm_getcsr();
                    _mm_setcsr(environment);
                    if (whole)
                        swivel_solve(handle, nullptr);
                    else
                        solve_blocks(handle, 0, blocks);
                    const unsigned after = _mm_getcsr();
                    _mm_setcsr(before);
                    if (after != environment) found = after;
                };
                CHECK(digest_of(*recipe, solve_there, 200) == expected);
                CHECK(found == environment);
            }
    }
}
#endif

#if defined(__x86_64__) && defined(SWIVEL_WITH_TBB)
TEST_CASE("worker threads that took over the caller's environment give the same bits")
{
    const unsigned before = _mm_getcsr();
    _mm_setcsr(0x1f80 | 0x8000 | 0x0040 | 0x4000);  // flush to zero, denormals are zero, round up
    oneapi::tbb::task_arena arena(2);
    arena.initialize();
    _mm_setcsr(before);
    for (const Recipe* recipe : few_crowds()) {
        INFO(full_name(*recipe));
        const auto solve_there = [&](Crowd& crowd) {
            arena.execute([&] {
                _mm_setcsr(0x1f80 | 0x8000 | 0x0040 | 0x4000);
                swivel_solve(crowd.get(), nullptr);
                _mm_setcsr(before);
            });
        };
        CHECK(digest_of(*recipe, solve_there, large(*recipe)) == digest_of(*recipe, solve, large(*recipe)));
    }
}
#endif
