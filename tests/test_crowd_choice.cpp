// SPDX-License-Identifier: MIT
//
// The promise: limbs that are chosen, by a mask or by a list, get the bits that solving all limbs would give them. All
// others keep theirs. Blocks without a chosen limb are not touched. Nothing allocates, and wrong choices change
// nothing.
#include "tests/allocation_count.h"
#include "tests/solve_jobs.h"
#include "tests/test_choice.h"
#include "tests/test_isa_scope.h"

#include <rapidcheck/catch.h>
#include <sys/mman.h>
#include <unistd.h>
#include <algorithm>
#include <thread>

#ifdef SWIVEL_WITH_TBB
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#endif

using namespace swivel;
using namespace swivel::test;

namespace {

struct Scene {
    swivel_features features = 0;
    std::vector<swivel_group_def> groups;
    Crowd crowd;
    std::vector<std::uint32_t> limbs;
    std::vector<Results> states;  // before, poisoned, and after solving all

    Scene(swivel_features of, const std::vector<std::uint32_t>& sizes, std::uint64_t seed)
        : features(of), groups(groups_of(sizes)), crowd(crowd_with(of, groups))
    {
        Random random{seed};
        const auto group_count = static_cast<std::uint32_t>(groups.size());
        write_arms(crowd, features, group_count, random);
        limbs = all_limbs(crowd, group_count);
        poison_results(crowd);
        states.emplace_back(crowd);
        crowd.solve();
        states.emplace_back(crowd);
        poison_results(crowd);
    }
    static std::vector<swivel_group_def> groups_of(const std::vector<std::uint32_t>& sizes)
    {
        std::vector<swivel_group_def> groups;
        for (const std::uint32_t size : sizes) groups.push_back(group_of(size));
        return groups;
    }

    // Chosen limbs as if all were solved, others and untouched blocks as they were.
    bool is_right(const std::vector<std::uint32_t>& mask) const
    {
        const Results now(crowd);
        std::vector<bool> is_limb(lane_count(crowd)), touched(swivel_block_count(crowd.get()));
        bool right = true;
        for (const std::uint32_t limb : limbs) {
            is_limb[limb] = true;
            if (is_set(mask, limb)) touched[limb / 16] = true;
            right = right && now.same(states[is_set(mask, limb)], limb);
        }
        for (std::uint32_t lane = 0; lane < lane_count(crowd); ++lane)
            right = right && (is_limb[lane] || touched[lane / 16] || now.same(states[0], lane));
        return right;
    }
};

Scene random_scene(std::uint64_t seed)
{
    Random random{seed};
    swivel_features features = random.below(16);
    if (!(features & SWIVEL_WORLD)) features &= ~SWIVEL_POLE_DIRECTION;
    std::vector<std::uint32_t> sizes(1 + random.below(4));
    for (std::uint32_t& size : sizes) size = 1 + random.below(random.below(2) ? 20 : 300);
    return Scene(features, sizes, seed);
}

}  // namespace

TEST_CASE("limbs chosen by bits or by a list get the bits of a full solve, others keep theirs")
{
    rc::prop("random groups, features, masks, ranges and lists", [](std::uint64_t seed) {
        Scene scene = random_scene(seed);
        Random random{seed + 1};
        for (int round = 0; round < 3; ++round) {
            const std::vector<std::uint32_t> mask = random_mask(scene.crowd, random);
            poison_results(scene.crowd);
            scene.crowd.solve({.mask = mask});
            RC_ASSERT(scene.is_right(mask));

            poison_results(scene.crowd);
            const std::uint32_t block_count = swivel_block_count(scene.crowd.get()), step = 1 + random.below(12);
            for (std::uint32_t first = 0; first < block_count; first += step)
                scene.crowd.solve({.blocks = swivel_blocks{first, std::min(step, block_count - first)},
                                   .mask = mask,
                                   .on_this_thread = true});
            RC_ASSERT(scene.is_right(mask));

            std::vector<std::uint32_t> list;
            for (const std::uint32_t limb : scene.limbs)
                for (std::uint32_t n = random.below(3); is_set(mask, limb) && n < 3; ++n) list.push_back(limb);
            for (std::size_t n = list.size(); n > 1; --n)
                std::swap(list[n - 1], list[random.below(static_cast<std::uint32_t>(n))]);
            poison_results(scene.crowd);
            scene.crowd.solve({.limbs = list});
            RC_ASSERT(scene.is_right(mask));
        }
    });
}

TEST_CASE("every share of a block, for each single lane and on every instruction set")
{
    const IsaScope scope;
    for (const std::string& isa : runnable_isas()) {
        INFO(isa);
        REQUIRE(swivel_use_isa(isa.c_str()) == SWIVEL_OK);
        for (const swivel_features features : {swivel_features{0}, kEverything}) {
            Scene scene(features, {16 * 40, 16 * 3 - 5}, features);
            for (std::uint32_t share = 0; share <= 16; ++share) {
                std::vector<std::uint32_t> mask(mask_words(scene.crowd));
                for (std::uint32_t limb = 0; limb < lane_count(scene.crowd); ++limb)
                    if ((limb * 7 + limb / 16) % 16 < share) set(mask, limb);
                poison_results(scene.crowd);
                scene.crowd.solve({.mask = mask});
                CHECK(scene.is_right(mask));
            }
            for (const std::uint32_t limb : scene.limbs) {
                std::vector<std::uint32_t> mask(mask_words(scene.crowd));
                set(mask, limb);
                poison_results(scene.crowd);
                scene.crowd.solve({.limbs = std::span(&limb, 1)});
                REQUIRE(scene.is_right(mask));
            }
        }
    }
}

TEST_CASE("crowds of many chunks, on any number of threads and in any ranges")
{
#ifdef SWIVEL_WITH_TBB
    using oneapi::tbb::global_control;
    const global_control threads_of_process(global_control::max_allowed_parallelism, 4);
#endif
    for (const swivel_features features : {swivel_features{0}, kEverything}) {
        Scene scene(features, {7000, 33, 5000}, 9);
        Random random{features + 1};
        for (int round = 0; round < 6; ++round) {
            const std::vector<std::uint32_t> mask =
                round ? random_mask(scene.crowd, random) : std::vector<std::uint32_t>(mask_words(scene.crowd), ~0u);
            poison_results(scene.crowd);
#ifdef SWIVEL_WITH_TBB
            oneapi::tbb::task_arena arena(1 + round % 4);
            arena.execute([&] { scene.crowd.solve({.mask = mask}); });
#else
            scene.crowd.solve({.mask = mask});
#endif
            CHECK(scene.is_right(mask));

            poison_results(scene.crowd);
            const std::uint32_t block_count = swivel_block_count(scene.crowd.get()), parts = 3;
            std::vector<std::thread> threads;  // ranges between the words' blocks, too
            for (std::uint32_t part = 0; part < parts; ++part)
                threads.emplace_back([&, part] {
                    for (std::uint32_t first = part * 7; first < block_count; first += parts * 7)
                        solve_active_blocks(scene.crowd.get(), mask.data(), mask_words(scene.crowd), first,
                                            std::min(7u, block_count - first));
                });
            for (std::thread& thread : threads) thread.join();
            CHECK(scene.is_right(mask));
        }
    }
}

TEST_CASE("blocks without a chosen limb are neither read nor written")
{
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const auto blocks = static_cast<std::uint32_t>(3 * page / 64);  // so that each third of the rows is whole pages
    const swivel_group_def group = group_of(blocks * SWIVEL_LANES);
    swivel_crowd_def def = def_of(group);
    const std::size_t bytes = swivel_crowd_bytes(&def), room = (bytes / page + 3) * page;
    char* const pages =
        static_cast<char*>(mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    REQUIRE(pages != MAP_FAILED);
    const std::size_t rows_bytes = std::size_t{blocks} * (8 + 7) * 64;
    def.memory = pages + 2 * page - (bytes - rows_bytes);  // so that the input rows start a page
    def.memory_bytes = bytes;
    Crowd crowd(def);
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0, 0, 2});
    crowd.write_all(SWIVEL_LENGTHS, 0, Float2{1, 1});
    const swivel_rows in = swivel_input_rows(crowd.get(), 0), out = swivel_result_rows(crowd.get(), 0);
    const auto lock_outside = [&](const swivel_rows& rows, int rights) {
        char* const base = reinterpret_cast<char*>(rows.base);
        const std::size_t part = std::size_t{blocks} / 3 * rows.row_count * 64;
        REQUIRE(reinterpret_cast<std::uintptr_t>(base) % page == 0);
        REQUIRE(part % page == 0);
        REQUIRE(mprotect(base, part, rights) == 0);
        REQUIRE(mprotect(base + 2 * part, part, rights) == 0);
    };
    for (const std::uint32_t limbs_of_block : {1u, 9u, 16u}) {
        std::vector<std::uint32_t> mask(mask_words(crowd)), list;
        for (std::uint32_t block = blocks / 3; block < blocks / 3 * 2; ++block)
            for (std::uint32_t n = 0; n < limbs_of_block; ++n) list.push_back(block * 16 + n);
        for (const std::uint32_t limb : list) set(mask, limb);
        lock_outside(in, PROT_NONE);
        lock_outside(out, PROT_NONE);
        crowd.solve({.mask = mask});
        crowd.solve({.limbs = list});
        lock_outside(in, PROT_READ | PROT_WRITE);
        lock_outside(out, PROT_READ | PROT_WRITE);
        for (const std::uint32_t limb : list) REQUIRE(result_words(crowd, limb).back() == SWIVEL_REACHED);
        CHECK(result_words(crowd, blocks / 3 * 16 - 1).back() == 0);
        CHECK(result_words(crowd, blocks / 3 * 32).back() == 0);
    }
}

TEST_CASE("choosing allocates nothing")
{
    const swivel_group_def group = group_of(9000);
    {
        Crowd crowd({group});
        Random random{3};
        const std::vector<std::uint32_t> mask = random_mask(crowd, random);
        std::vector<std::uint32_t> list, words(mask_words(crowd));
        std::vector<float> urgency(swivel_block_count(crowd.get()));
        for (int n = 0; n < 4000; ++n) list.push_back(random.below(9000));
        const float priority = 1;
        const swivel_in priorities{&priority, 0};
        const auto use = [&] {
            const auto all = [&] {
                crowd.solve({.mask = mask});
                crowd.solve({.limbs = list});
                crowd.solve({.priorities = {&priorities, 1}, .most_blocks = 300});
            };
            crowd.solve({.blocks = swivel_blocks{3, 200}, .mask = mask, .on_this_thread = true});
            crowd.choose({&priorities, 1}, urgency, 300, words);
#ifdef SWIVEL_WITH_TBB
            static oneapi::tbb::task_arena arena(1);
            arena.execute(all);
#else
            all();
#endif
        };
        for (int n = 0; n < 5; ++n) use();
        const std::size_t before = allocation_count();
        for (int n = 0; n < 20; ++n) use();
        CHECK(allocation_count() == before);
    }
}

TEST_CASE("wrong choices are refused with one line and change nothing")
{
    Scene scene(0, {20, 5, 40}, 4);
    swivel_crowd* const c = scene.crowd.get();
    REQUIRE(swivel_block_count(c) == 6);
    const std::uint32_t words[4] = {~0u, ~0u, ~0u, ~0u};
    const auto bad = SWIVEL_INVALID_ARGUMENT;
    const std::vector<std::uint32_t> none(3);

    CHECK_REFUSED(solve_active(nullptr, words, 3), bad);
    CHECK_REFUSED(solve_active(c, nullptr, 3), bad);
    for (const std::uint32_t count : {0u, 2u, 4u, ~0u}) CHECK_REFUSED(solve_active(c, words, count), bad);
    CHECK_REFUSED(solve_active_blocks(nullptr, words, 3, 0, 1), bad);
    CHECK_REFUSED(solve_active_blocks(c, nullptr, 3, 0, 1), bad);
    CHECK_REFUSED(solve_active_blocks(c, words, 2, 0, 1), bad);
    CHECK_REFUSED(solve_active_blocks(c, words, 3, 0, 7), bad);
    CHECK_REFUSED(solve_active_blocks(c, words, 3, 6, 1), bad);
    CHECK_REFUSED(solve_active_blocks(c, words, 3, 1, ~0u), bad);
    CHECK_REFUSED(solve_list(nullptr, words, 0), bad);
    CHECK_REFUSED(solve_list(c, nullptr, 1), bad);
    // Padding lies at 20 to 31, 37 to 47 and 88 to 95; the crowd ends at 96.
    for (const std::uint32_t wrong : {20u, 31u, 37u, 47u, 88u, 95u, 96u, 97u, 1u << 31, ~0u}) {
        const std::uint32_t list[] = {3, 40 + 8, 87, 36, 32, 19, wrong, 0};
        CHECK_REFUSED(solve_list(c, list, 8), bad);
    }
    const std::uint32_t padding[] = {2, 20}, past[] = {96};
    solve_list(c, padding, 2);
    CHECK(std::string(swivel_last_error()) == "entry 1 of the list: 20 is no limb of this crowd, but padding");
    solve_list(c, past, 1);
    CHECK(std::string(swivel_last_error()) == "entry 0 of the list: 96 is no limb of this crowd, but past its end");
    solve_active(c, words, 2);
    CHECK(std::string(swivel_last_error()) == "a mask of 2 words; this crowd of 6 blocks has 3, a bit for each lane");
    CHECK(Results(scene.crowd).words == scene.states[0].words);

    CHECK(solve_list(c, nullptr, 0) == SWIVEL_OK);
    CHECK(solve_active_blocks(c, words, 3, 6, 0) == SWIVEL_OK);
    CHECK(solve_active(c, none.data(), 3) == SWIVEL_OK);
    CHECK(Results(scene.crowd).words == scene.states[0].words);
    const std::uint32_t all_of_them[] = {19, 36, 87};  // and nothing is left of the lists refused
    CHECK(solve_list(c, all_of_them, 3) == SWIVEL_OK);
    std::vector<std::uint32_t> mask(3);
    for (const std::uint32_t limb : all_of_them) set(mask, limb);
    CHECK(scene.is_right(mask));
    CHECK_THROWS_AS(scene.crowd.solve({.mask = std::vector<std::uint32_t>(2)}), Error);
    CHECK_THROWS_AS(scene.crowd.solve({.limbs = std::vector<std::uint32_t>{20}}), Error);
}

TEST_CASE("a job chooses in one way, and lists and priorities are for the whole crowd")
{
    const swivel_group_def group = group_of(40);
    Crowd crowd = crowd_with(0, {&group, 1});
    const std::uint32_t mask[] = {~0u, ~0u}, limb = 3;
    const swivel_limbs list{&limb, 1};
    const float priority = 1;
    const swivel_in priorities{&priority, 0};
    const swivel_blocks all{0, 3};
    const auto before = all_words(crowd);
    const auto refuse = [&](const auto& edit, const std::string& line) {
        swivel_job job = swivel_default_job();
        edit(job);
        CHECK_REFUSED(swivel_solve(crowd.get(), &job), SWIVEL_INVALID_ARGUMENT);
        CHECK(std::string(swivel_last_error()).find(line) != std::string::npos);
        CHECK((all_words(crowd) == before));
    };
    const auto give_mask = [&](swivel_job& job) { job.mask = mask, job.mask_word_count = 2; };
    const auto give_list = [&](swivel_job& job) { job.limbs = &list; };
    const auto give_priorities = [&](swivel_job& job) { job.priorities = &priorities, job.most_blocks = 1; };
    refuse([&](swivel_job& job) { give_mask(job), give_list(job); }, "give one of them");
    refuse([&](swivel_job& job) { give_list(job), give_priorities(job); }, "give one of them");
    refuse([&](swivel_job& job) { give_mask(job), give_priorities(job); }, "give one of them");
    refuse([&](swivel_job& job) { give_list(job), job.blocks = &all; },
           "a job with a list of limbs is for the whole crowd");
    refuse([&](swivel_job& job) { give_list(job), job.on_this_thread = 1; }, "leave on_this_thread out");
    refuse([&](swivel_job& job) { give_priorities(job), job.blocks = &all; }, "leave blocks out");
    refuse([&](swivel_job& job) { give_priorities(job), job.on_this_thread = 1; },
           "a job with priorities is for the whole");
    refuse([&](swivel_job& job) { job.mask_word_count = 2; }, "the mask is null");
    refuse([&](swivel_job& job) { job.most_blocks = 2; }, "most_blocks goes with priorities");
    refuse([&](swivel_job& job) { give_mask(job), job.most_blocks = 2; }, "most_blocks goes with priorities");
    refuse([](swivel_job& job) { job.size = 0; }, "job has size 0");
    refuse([](swivel_job& job) { job.size += 8; }, "build with the header");
    refuse([](swivel_job& job) { job.size -= 4; }, "start from its default");  // half a member

    // One of an older header is read as far as it goes: there, to the blocks alone.
    swivel_job job = swivel_default_job();
    const swivel_blocks none{3, 0};
    job.blocks = &none;
    job.size = offsetof(swivel_job, mask);
    give_list(job);
    CHECK(swivel_solve(crowd.get(), &job) == SWIVEL_OK);
    CHECK((all_words(crowd) == before));
}

TEST_CASE("a solve says how many limbs it solved")
{
    const swivel_group_def groups[] = {group_of(20), group_of(5), group_of(40)};
    Crowd crowd = crowd_with(0, groups);
    CHECK(crowd.solve() == 65);
    CHECK(crowd.solve({.blocks = swivel_blocks{1, 2}}) == 9);
    CHECK(crowd.solve({.blocks = swivel_blocks{1, 2}, .mask = std::vector<std::uint32_t>(3, ~0u)}) == 9);
    CHECK(crowd.solve({.mask = std::vector<std::uint32_t>{0xf0000003u, 0, 1u << 24}}) == 2);  // others are padding
    CHECK(crowd.solve({.limbs = std::vector<std::uint32_t>{3, 48, 3}}) == 2);
    CHECK(crowd.solve({.limbs = std::vector<std::uint32_t>()}) == 0);
    const float priority = 1;
    const std::vector<swivel_in> priorities(3, {&priority, 0});
    CHECK(crowd.solve({.priorities = priorities, .most_blocks = 2}) == 20);
}
