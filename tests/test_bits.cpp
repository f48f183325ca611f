// SPDX-License-Identifier: MIT
//
// The promise: equal inputs give equal bits. It holds for every instruction set, thread count and number of limbs, and
// in any floating-point environment of threads. This checks the instruction set in use; CTest's label `isa` runs it
// once for each. Block ranges, masks, lists and frames are the test `interface`'s, the caller's environment is
// test_float_environment.cpp's.
#include <sys/mman.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <string>
#include <vector>

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

void solve(Crowd& crowd, const Job& job) { crowd.solve(job); }

// Crowds for the promises that batching keeps and no kernel does: threads and chunks. They are plain arms with
// and without every feature, whole limbs, some of which keep their swivel from frame to frame, and bodies, some of
// which stand.
std::vector<const Recipe*> few_crowds()
{
    return {&recipe_of(Part::ordinary, "world-joints-hand"),
            &recipe_of(Part::hard, "arms"),
            &recipe_of(Part::hard, "world-joints-hand-direction"),
            &recipe_of(Part::limbs, "set-world-joints-normal-angle-step"),
            &recipe_of(Part::limbs, "set-all-limits"),
            &recipe_of(Part::bodies, "set-all-limits"),
            &recipe_of(Part::standing, "palms-by-motion")};
}
// Limbs enough for several chunks of any of them.
std::uint32_t large(const Recipe& recipe)
{
    return corpus::is_of_bodies(recipe.part) ? 300 : recipe.part == Part::limbs ? 1000 : 8000;
}

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
    CHECK(corpus::digest_of_start(solve) == corpus::kGoldenStart);
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

#ifdef SWIVEL_WITH_TBB
TEST_CASE("every number of threads gives the scalar build's bits")
{
    const IsaScope scope;
    for (const Recipe* recipe : few_crowds()) {
        const std::uint64_t expected = scalar_digest(scope, *recipe, large(*recipe), [](Crowd& crowd, Job job) {
            job.on_this_thread = true;
            crowd.solve(job);
        });
        for (const int threads : {1, 2}) {
            INFO(full_name(*recipe) << ", " << threads << " threads");
            using oneapi::tbb::global_control;
            const global_control control(global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
            oneapi::tbb::task_arena arena(threads);
            const auto solve_there = [&](Crowd& crowd, const Job& job) { arena.execute([&] { crowd.solve(job); }); };
            CHECK(digest_of(*recipe, solve_there, large(*recipe)) == expected);
        }
    }
}
#endif

TEST_CASE("blocks of which no limb is chosen are not even read, whatever chooses")
{
    // Rows of 512 and 448 bytes a block: 64 blocks of either are whole pages, and all but the middle 64 are locked
    // away.
    constexpr std::size_t page = 4096;
    constexpr std::uint32_t blocks = 192, first = 64, count = 64;
    const swivel_group_def group = swivel::group(blocks * SWIVEL_LANES);
    swivel_crowd_def def = def_of(group);
    const std::size_t bytes = swivel_crowd_bytes(&def), room = (bytes / page + 3) * page;
    char* const pages =
        static_cast<char*>(mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    REQUIRE(pages != MAP_FAILED);
    const std::size_t rows_bytes = blocks * (8 + 7) * SWIVEL_LANES * sizeof(float);
    def.memory = pages + 2 * page - (bytes - rows_bytes);  // so that the input rows start a page
    def.memory_bytes = bytes;
    {
        Crowd crowd(def);
        crowd.write_all(SWIVEL_TARGET, 0, std::array{0.0f, 1.0f, 1.0f});
        crowd.write_all(SWIVEL_LENGTHS, 0, std::array{1.0f, 1.0f});
        const auto lock_outside = [&](int rights) {
            for (const swivel_rows& rows : {swivel_input_rows(crowd.get(), 0), swivel_result_rows(crowd.get(), 0)}) {
                const std::size_t part = float_count(rows) * sizeof(float) / 3;
                char* const base = reinterpret_cast<char*>(rows.base);
                REQUIRE(part % page == 0);
                REQUIRE(mprotect(base, part, rights) == 0);
                REQUIRE(mprotect(base + 2 * part, part, rights) == 0);
            }
        };
        std::vector<std::uint32_t> mask(blocks / 2), list;
        for (std::uint32_t block = first; block < first + count; ++block)
            for (const std::uint32_t lane : {3u, 7u, 15u}) list.push_back(block * SWIVEL_LANES + lane);
        for (const std::uint32_t limb : list) mask[limb / 32] |= 1u << limb % 32;
        lock_outside(PROT_NONE);
        CHECK(crowd.solve({.blocks = swivel_blocks{first, count}, .on_this_thread = true}) == count * SWIVEL_LANES);
        CHECK(crowd.solve({.mask = mask}) == list.size());
        CHECK(crowd.solve({.limbs = list}) == list.size());
        lock_outside(PROT_READ | PROT_WRITE);
    }
    munmap(pages, room);
}

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
        const auto solve_there = [&](Crowd& crowd, const Job& job) {
            arena.execute([&] {
                _mm_setcsr(0x1f80 | 0x8000 | 0x0040 | 0x4000);
                crowd.solve(job);
                _mm_setcsr(before);
            });
        };
        CHECK(digest_of(*recipe, solve_there, large(*recipe)) == digest_of(*recipe, solve, large(*recipe)));
    }
}
#endif
