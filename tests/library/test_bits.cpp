// SPDX-License-Identifier: MIT
//
// The promise: equal inputs give equal bits. It holds for every instruction set, thread count and number of limbs, in
// any floating-point environment of threads, and whatever the way: order, memory, job and space. This checks the
// instruction set in use; CTest's label `isa` runs it once for each. The test `interface` has jobs of random bytes,
// the caller's environment in all functions is test_float_environment.cpp's.
#include <sys/mman.h>

#include <rapidcheck/catch.h>
#include <array>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/looking_bodies.h"
#include "tests/posed_bodies.h"
#include "tests/test_crowd.h"
#include "tests/test_scopes.h"
#include "tests/ways.h"
#include "tools/corpus/bodies.h"
#include "tools/corpus/corpus.h"
#include "tools/corpus/golden.h"

#ifdef SWIVEL_WITH_TBB
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#endif

namespace {

using namespace swivel;
using namespace swivel::test;
using swivel::corpus::digest_of;
using swivel::corpus::Part;
using swivel::corpus::Recipe;
using swivel::corpus::recipe_of;
using swivel::corpus::recipes_of;

void solve_whole(Crowd& crowd, const Job& job) { crowd.solve(job); }

// Crowds for the promises that batching keeps and no kernel does: threads and chunks. They are plain arms with
// and without every feature, whole limbs, some of which keep their swivel from frame to frame, and bodies, some of
// which stand.
std::vector<const Recipe*> few_crowds()
{
    return {&recipe_of(Part::ordinary, "world-joints-hand"),
            &recipe_of(Part::hard, "arms"),
            &recipe_of(Part::hard, "world-joints-hand-direction"),
            &recipe_of(Part::limbs, "set-pole-normal"),
            &recipe_of(Part::limbs, "set-all-limits"),
            &recipe_of(Part::bodies, "set-all-limits"),
            &recipe_of(Part::standing, "palms-by-motion"),
            &recipe_of(Part::standing, "looks-in-body")};
}
// Limbs enough for several chunks of any of them.
std::uint32_t large(const Recipe& recipe)
{
    return corpus::is_of_bodies(recipe.part) ? 300 : recipe.part == Part::limbs ? 1000 : 8000;
}

// What the ways leave of a crowd is what the job leaves, which it then does.
void check_ways(Scene& scene, Crowd& crowd, const Job& job, std::span<const Way> ways)
{
    std::vector<Bits> all;
    for (const Way& way : ways) all.push_back(bits_of_way(scene, crowd, job, way));
    crowd.solve(job);
    for (std::size_t n = 0; n < all.size(); ++n) {
        INFO(scene.name << ", " << ways[n].name);
        REQUIRE((all[n] == bits_after(scene, crowd, job, !ways[n].is_far)));
    }
}

constexpr std::uint32_t kLimbs = 37, kFrames = 20;  // three blocks, the last not full

// Calls take(scene, crowd, job) before each solve of a crowd of the corpus. Bodies that stand start anew, stand on
// other things and are left out now and then.
template <class Take>
void play(const Recipe& recipe, const Take& take, std::uint32_t limb_count = kLimbs,
          std::uint32_t frame_count = kFrames)
{
    Scene scene{full_name(recipe), corpus::is_of_bodies(recipe.part) ? skeleton_of(recipe).joint_count() : 0,
                [&](const std::vector<std::uint32_t>& counts) {
                    return corpus::create_crowd(recipe, {counts[0], counts[1], counts[2]});
                }};
    const auto solve_there = [&](Crowd& crowd, const Job& job) { take(scene, crowd, job); };
    if (recipe.part == Part::standing)
        corpus::standing_digest(recipe, solve_there, limb_count, frame_count);
    else
        digest_of(recipe, solve_there, limb_count);
}

// The same of bodies, that are solved twice.
template <class Take>
void play(const PosedBodies& bodies, const Take& take)
{
    Scene scene{"bodies", bodies.skeleton.size(), [&](const std::vector<std::uint32_t>& counts) {
                    return Crowd(bodies.skeleton.view(), counts[0], bodies.groups);
                }};
    PoseBuffer poses(bodies.layout, bodies.bodies);
    swivel_pose pose = bodies.view(poses);
    const std::array<float, 4> weights = {1, 0.25f, 0, 1};
    std::vector<float> weight_of(bodies.body_count());
    for (std::size_t n = 0; n < weight_of.size(); ++n) weight_of[n] = weights[n / 2 % 4];
    pose.weight = stream(weight_of);
    Crowd crowd = bodies.crowd();
    for (int n = 0; n < 2; ++n) take(scene, crowd, Job{.pose = &pose});
}

PosedBodies any_bodies(Random& random)
{
    PoseLayout layout;
    layout.form = static_cast<swivel_pose_form>(random.below(SWIVEL_MATRIX_COLUMNS3 + 1));
    layout.translates = layout.scales = layout.roots = true;
    const std::uint32_t count = 1 + random.below(60);
    if (random.below(2)) return HoldingBodies(random, count, layout);
    LookingBodies looking(random, count, layout);
    for (const std::uint32_t group : looking.looks) looking.look_def(group).rate = static_cast<float>(random.below(2));
    return looking;
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
        const std::vector<std::uint64_t> digests = corpus::digests_of(part, solve_whole);
        CHECK(corpus::wrong_crowds(part, digests) == std::vector<std::string>{});
        CHECK(corpus::fold(digests) == corpus::kGoldenDigests[static_cast<std::size_t>(part)]);
    }
    CHECK(corpus::digest_of_start(solve_whole) == corpus::kGoldenStart);
}

constexpr Way kWays[] = {
    {.name = "in any order, alone and together", .memory = Way::Memory::gaps, .is_shuffled = true},
    {.name = "block by block, in a workspace of any bytes", .jobs = Way::Jobs::blocks},
    {.name = "by masks, poses joint by joint", .jobs = Way::Jobs::masks, .memory = Way::Memory::joints},
    {.name = "from frames", .memory = Way::Memory::gaps, .has_frames = true},
    {.name = "from frames, by masks", .jobs = Way::Jobs::masks, .has_frames = true},
    {.name = "to other memory", .memory = Way::Memory::joints, .is_apart = true},
    {.name = "where denormals are flushed and sums rounded up", .is_in_other_environment = true},
};

TEST_CASE("every crowd of the corpus has the same bits whatever the way, in every frame")
{
    for (const Part part : corpus::kParts)
        for (const Recipe& recipe : recipes_of(part))
            play(recipe, [&](Scene& scene, Crowd& crowd, const Job& job) { check_ways(scene, crowd, job, kWays); });
}

TEST_CASE("memory of limbs that a job does not choose is not even read")
{
    constexpr Way kLocked{
        .name = "by masks", .jobs = Way::Jobs::masks, .memory = Way::Memory::pages, .has_frames = true};
    const auto check_locked = [&](Scene& scene, Crowd& crowd, const Job& job) {
        check_ways(scene, crowd, job, {&kLocked, 1});
    };
    for (const Recipe* recipe : few_crowds()) play(*recipe, check_locked, kLimbs, 2);
    for (const Recipe& recipe : recipes_of(Part::bodies)) play(recipe, check_locked, kLimbs, 2);
}

TEST_CASE("hands that hold each other and props, and heads that look, have the same bits whatever the way")
{
    rc::prop("whatever they hold or see", [](std::uint64_t seed) {
        Random random{seed};
        play(any_bodies(random),
             [](Scene& scene, Crowd& crowd, const Job& job) { check_ways(scene, crowd, job, kWays); });
    });
}

TEST_CASE("doubles far from the origin give the bits of floats near it")
{
    constexpr Way kFarWays[] = {{.name = "far away", .memory = Way::Memory::gaps, .is_far = true},
                                {.name = "far away, by masks", .jobs = Way::Jobs::masks, .is_far = true}};
    const auto check_far = [&](Scene& scene, Crowd& crowd, const Job& job) {
        shorten_positions(crowd, job);
        check_ways(scene, crowd, job, kFarWays);
    };
    int count = 0;
    for (const Part part : corpus::kParts)
        for (const Recipe& recipe : recipes_of(part)) {
            // Some are far away already. A prop at a joint has its place from there.
            const bool is_body = corpus::is_of_bodies(part);
            if (recipe.pose & corpus::kFar || recipe.holds == corpus::Holds::prop_at_joint) continue;
            if (is_body && !(recipe.pose & corpus::kRoots)) continue;
            play(recipe, check_far);
            ++count;
        }
    CHECK(count > 80);
    rc::prop("of hands that hold", [&](std::uint64_t seed) {
        Random random{seed};
        PoseLayout layout;
        layout.roots = true;
        play(HoldingBodies(random, 1 + random.below(40), layout), check_far);
    });
}

TEST_CASE("large crowds have the same bits on threads, ours and the caller's, from rows and from frames")
{
    constexpr Way kLargeWays[] = {
        {.name = "on threads of the caller's", .jobs = Way::Jobs::threads},
        {.name = "from frames, on threads of the caller's", .jobs = Way::Jobs::threads, .has_frames = true},
        {.name = "from frames", .has_frames = true},
        {.name = "from frames, by masks", .jobs = Way::Jobs::masks, .has_frames = true},
    };
    for (const Recipe* recipe : few_crowds())
        play(
            *recipe, [&](Scene& scene, Crowd& crowd, const Job& job) { check_ways(scene, crowd, job, kLargeWays); },
            large(*recipe), 4);
}

TEST_CASE("blocks of which no limb is chosen are not even read, by blocks as by masks")
{
    // Rows of 512 and 448 bytes a block: 64 blocks of either are whole pages, and all but the middle 64 are locked
    // away.
    constexpr std::size_t page = 4096;
    constexpr std::uint32_t blocks = 192, first = 64, count = 64;
    const swivel_limb_def limb = limbs(blocks * SWIVEL_LANES);
    const swivel_group_def group = c_group(limb);
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
        std::vector<std::uint32_t> mask(blocks / 2);
        std::fill_n(mask.begin() + first / 2, count / 2, 0x80888088u);  // lanes 3, 7 and 15 of each block
        lock_outside(PROT_NONE);
        CHECK(crowd.solve({.blocks = swivel_blocks{first, count}, .on_this_thread = true}) == count * SWIVEL_LANES);
        CHECK(crowd.solve({.mask = mask}) == 3 * count);
        lock_outside(PROT_READ | PROT_WRITE);
    }
    munmap(pages, room);
}

#ifdef SWIVEL_WITH_TBB
TEST_CASE("every number of threads gives the bits of this one, also threads that took over the caller's environment")
{
    using oneapi::tbb::global_control;
    const auto solve_here = [](Crowd& crowd, Job job) {
        job.on_this_thread = true;
        crowd.solve(job);
    };
    for (const Recipe* recipe : few_crowds()) {
        const std::uint64_t expected = digest_of(*recipe, solve_here, large(*recipe));
        for (const bool is_other : {false, true})
            for (const int threads : {1, 2}) {
                INFO(full_name(*recipe) << ", " << threads << " threads, other environment " << is_other);
                const global_control control(global_control::max_allowed_parallelism, std::size_t(threads));
                oneapi::tbb::task_arena arena(threads);
                const auto in_environment = [&](const auto& call) {
                    if (!is_other) return call();
                    const OtherEnvironment other;
                    call();
                };
                in_environment([&] { arena.initialize(); });
                const auto solve_there = [&](Crowd& crowd, const Job& job) {
                    arena.execute([&] { in_environment([&] { crowd.solve(job); }); });
                };
                CHECK(digest_of(*recipe, solve_there, large(*recipe)) == expected);
            }
    }
}
#endif
