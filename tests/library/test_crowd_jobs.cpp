// SPDX-License-Identifier: MIT
//
// The promise: a job names groups of a crowd, and its frames are for those alone. A frame reads a limb before it writes
// it, so a limb with bad input keeps its pose in place. Within a budget the most urgent blocks are solved, as a plain
// list sorted by urgency says. No block waits for ever. The choice depends on priorities and history alone.
//
// What is refused is in test_refused_calls.cpp. That each limb of a job has the bits that it has alone and no other
// limb changes, for every field, stride and alignment, is the test `interface`'s; ways and threads are test_bits.cpp's.
#include "swivel/swivel_explain.hpp"
#include "tests/test_arm.h"
#include "tests/test_crowd.h"
#include "tests/test_whole_limb.h"

#include <rapidcheck/catch.h>
#include <algorithm>
#include <cmath>

using namespace swivel;
using namespace swivel::test;

namespace {

std::uint32_t mask_words(const Crowd& crowd) { return (swivel_block_count(crowd.get()) + 1) / 2; }
std::uint32_t lane_count(const Crowd& crowd) { return swivel_block_count(crowd.get()) * SWIVEL_LANES; }
bool is_set(const std::vector<std::uint32_t>& words, std::uint32_t limb) { return words[limb / 32] >> limb % 32 & 1; }
void set(std::vector<std::uint32_t>& words, std::uint32_t limb) { words[limb / 32] |= 1u << limb % 32; }

// One in eight out of reach or of bad input.
void write_arms(Crowd& crowd, swivel_features features, std::uint32_t group_count, Random& random)
{
    for (std::uint32_t group = 0; group < group_count; ++group)
        for (std::uint32_t n = 0; n < swivel_group_limb_count(crowd.get(), group); ++n) {
            const auto bone = [&] { return static_cast<float>(random.spread(0.2, 5)); };
            Limb limb = random_limb(random, features, {bone(), bone()});
            const std::uint32_t kind = random.below(16);
            if (kind == 0) limb.target[random.below(3)] *= 100;
            if (kind == 1) limb.pole[random.below(3)] = kNan;
            write_limb(crowd, group, n, limb);
        }
}

// The lanes that are limbs.
std::vector<std::uint32_t> all_limbs(const Crowd& crowd, std::uint32_t group_count)
{
    std::vector<std::uint32_t> limbs;
    for (std::uint32_t group = 0; group < group_count; ++group)
        for (std::uint32_t n = 0; n < swivel_group_limb_count(crowd.get(), group); ++n)
            limbs.push_back(swivel_group_first_limb(crowd.get(), group) + n);
    return limbs;
}

// The contract, with a sort.
struct Model {
    std::vector<std::vector<std::uint32_t>> blocks;  // the limbs of each
    std::vector<float> urgency;

    Model(const Crowd& crowd, std::uint32_t group_count)
        : blocks(swivel_block_count(crowd.get())), urgency(blocks.size())
    {
        for (const std::uint32_t limb : all_limbs(crowd, group_count)) blocks[limb / 16].push_back(limb);
    }
    // priority: of each lane.
    std::vector<std::uint32_t> choose(const std::vector<float>& priority, std::uint32_t max_blocks)
    {
        std::vector<std::uint32_t> order;
        for (std::uint32_t block = 0; block < blocks.size(); ++block) {
            float max = 0;
            for (const std::uint32_t limb : blocks[block])
                if (!std::isnan(priority[limb])) max = std::max(max, std::min(priority[limb], 1e15f));
            if (max > 0) order.push_back(block);
            urgency[block] += max;
        }
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return urgency[a] > urgency[b]; });
        order.resize(std::min<std::size_t>(order.size(), max_blocks));
        std::vector<std::uint32_t> words((blocks.size() + 1) / 2);
        for (const std::uint32_t block : order) {
            urgency[block] = 0;
            for (const std::uint32_t limb : blocks[block]) set(words, limb);
        }
        return words;
    }
};

// A priority for each lane, and the streams of the groups into them; the second has one for all.
struct Priorities {
    std::vector<float> lanes;
    std::vector<swivel_in> streams;

    Priorities(const Crowd& crowd, std::uint32_t group_count, Random& random) : lanes(lane_count(crowd))
    {
        for (float& lane : lanes) {
            const float hard[] = {0, 0, 0, -1, kNan, kInf, -kInf, 1e-42f, 3e38f, -0.0f};
            lane = random.below(30) ? static_cast<float>(random.below(4)) * 0.25f : hard[random.below(10)];
            if (random.below(4) == 0) lane = static_cast<float>(random.spread(1e-3, 1e3));
        }
        for (std::uint32_t group = 0; group < group_count; ++group) {
            float* const first = &lanes[swivel_group_first_limb(crowd.get(), group)];
            if (group == 1) std::fill_n(first, swivel_group_limb_count(crowd.get(), group), *first);
            streams.push_back({first, group == 1 ? 0 : sizeof(float)});
        }
    }
};

std::uint32_t bit_count(const std::vector<std::uint32_t>& words)
{
    std::uint32_t count = 0;
    for (std::uint32_t limb = 0; limb < words.size() * 32; ++limb) count += is_set(words, limb);
    return count;
}
std::vector<float> no_urgency(const Crowd& crowd) { return std::vector<float>(swivel_block_count(crowd.get())); }

}  // namespace

TEST_CASE("the most urgent blocks are picked, of equals the lower")
{
    rc::prop("random groups, priorities and budgets", [](std::uint64_t seed) {
        Random random{seed};
        std::vector<swivel_limb_def> groups;
        for (std::uint32_t n = 1 + random.below(3); n > 0; --n) groups.push_back(group_of(1 + random.below(700)));
        const auto group_count = static_cast<std::uint32_t>(groups.size());
        Crowd crowd = crowd_with(0, groups);
        Model model(crowd, group_count);
        std::vector<float> urgency = no_urgency(crowd);
        std::vector<std::uint32_t> words(mask_words(crowd), 0xdeadbeef);
        for (int call = 0; call < 30; ++call) {
            const Priorities priorities(crowd, group_count, random);
            const std::uint32_t max = random.below(4) ? random.below(swivel_block_count(crowd.get()) + 2) : 0;
            const std::vector<std::uint32_t> expected = model.choose(priorities.lanes, max);
            const std::uint32_t count = crowd.choose(priorities.streams, urgency, max, words);
            RC_ASSERT(words == expected);
            RC_ASSERT(count == bit_count(words));
        }
    });
}

TEST_CASE("what is chosen within a budget is solved on threads as in ranges")
{
    const swivel_limb_def groups[] = {group_of(6000), group_of(100), group_of(3333)};
    for (const swivel_features features : {swivel_features{0}, kEverything}) {
        Crowd whole = crowd_with(features, groups), parts = crowd_with(features, groups);
        std::vector<float> urgency = no_urgency(whole);
        for (Crowd* crowd : {&whole, &parts}) {
            Random random{7};
            write_arms(*crowd, features, 3, random);
        }
        Random random{8};
        for (int call = 0; call < 6; ++call) {
            const Priorities priorities(whole, 3, random);
            const std::uint32_t max = random.below(500), step = 1 + random.below(40);
            std::vector<std::uint32_t> words(mask_words(parts));
            const std::uint32_t chosen = whole.choose(priorities.streams, urgency, max, words);
            REQUIRE(whole.solve({.mask = words}) == chosen);
            const std::uint32_t block_count = swivel_block_count(parts.get());
            for (std::uint32_t first = 0; first < block_count; first += step)
                parts.solve({.blocks = swivel_blocks{first, std::min(step, block_count - first)},
                             .mask = words,
                             .on_this_thread = true});
            REQUIRE(whole.digest() == parts.digest());
        }
    }
}

TEST_CASE("nobody starves, and over time blocks are solved as often as their priority says")
{
    const std::uint32_t block_count = 40, calls = 40000;
    Crowd crowd = crowd_with(0, {group_of(16 * block_count)});
    std::vector<float> priority(16 * block_count);
    double sum = 0;
    for (std::uint32_t block = 0; block < block_count; ++block) {
        const float each = block == 39 ? 0.01f : static_cast<float>(1 + block % 4);
        priority[block * 16 + block % 16] = each;  // the largest of a block's limbs counts
        sum += static_cast<double>(each);
    }
    const swivel_in priorities{priority.data(), sizeof(float)};
    std::vector<float> urgency = no_urgency(crowd);
    std::vector<std::uint32_t> words(mask_words(crowd)), times(block_count);
    for (std::uint32_t call = 0; call < calls; ++call) {
        REQUIRE(crowd.choose({&priorities, 1}, urgency, 4, words) == 4 * 16);
        for (std::uint32_t block = 0; block < block_count; ++block) times[block] += is_set(words, block * 16);
    }
    for (std::uint32_t block = 0; block < block_count; ++block) {
        INFO("block " << block);
        const double fair = 4.0 * calls / sum * static_cast<double>(priority[block * 16 + block % 16]);
        CHECK(times[block] >= 0.8 * fair - 1);
        CHECK(times[block] <= 1.25 * fair + 1);
    }
}

TEST_CASE("without urgency each call starts anew; what is no number counts as none")
{
    Crowd crowd = crowd_with(0, {group_of(16 * 4)});
    const float priority = 1;
    const swivel_in priorities{&priority, 0};
    std::vector<std::uint32_t> words(2);
    for (int call = 0; call < 3; ++call) {
        CHECK(crowd.choose({&priorities, 1}, {}, 1, words) == 16);
        CHECK(words[0] == 0xffff);  // the first block, as often as it is asked
    }
    std::vector<float> urgency = {kNan, -5, 3, kInf};
    CHECK(crowd.choose({&priorities, 1}, urgency, 1, words) == 16);
    CHECK(words[0] == 0xffff0000);  // the size of -5 counts
    CHECK(urgency == std::vector<float>{1, 0, 4, 1});
}

TEST_CASE("C++: budgets that cannot be are refused and change nothing")
{
    Crowd crowd = crowd_with(0, {group_of(100)});
    const float priority = 1;
    const swivel_in good{&priority, 0};
    std::vector<float> urgency = no_urgency(crowd);
    std::vector<std::uint32_t> words(mask_words(crowd));
    CHECK_THROWS_WITH(crowd.choose({}, urgency, 1, words), "0 priorities for 1 groups; give one for each");
    CHECK_THROWS_WITH(crowd.choose({&good, 1}, std::span(urgency).first(3), 1, words),
                      "3 urgencies for 7 blocks; give one for each");
    CHECK_THROWS_AS(crowd.choose({&good, 1}, urgency, 1, std::span(words).first(3)), Error);
    CHECK(urgency == no_urgency(crowd));
    CHECK(bit_count(words) == 0);
    CHECK(crowd.choose({&good, 1}, urgency, 100, words) == 100);
}

// ---- groups and frames

TEST_CASE("jobs name groups; frames are given for those alone")
{
    Crowd crowd({limbs(20), limbs(5), limbs(40)});
    const Float3 target{0.3f, 0.2f, 1};
    for (std::uint32_t g = 0; g < 3; ++g) crowd.write_all(SWIVEL_LENGTHS, g, Float2{1, 1});
    Streams frame;
    frame.in(SWIVEL_TARGET, {&target, 0});
    CHECK(crowd.solve({.groups = std::array{0u, 2u}, .streams = {frame, frame}}) == 60);
    CHECK(read<std::uint32_t>(crowd, SWIVEL_FLAGS, 0)[19] == SWIVEL_REACHED);
    CHECK(read<std::uint32_t>(crowd, SWIVEL_FLAGS, 1)[4] == 0);  // never solved
    CHECK(read<std::uint32_t>(crowd, SWIVEL_FLAGS, 2)[39] == SWIVEL_REACHED);
    // Limb 32 is group 1's first.
    CHECK(crowd.solve({.groups = std::array{1u}, .mask = std::array{1u << 3, 1u, 0u}}) == 1);
    CHECK(crowd.solve({.groups = std::vector<std::uint32_t>()}) == 0);
    CHECK_THROWS_WITH(crowd.solve({.groups = std::array{1u}, .streams = {frame, frame}}),
                      "2 streams for 1 groups; give one for each");
    CHECK_THROWS_WITH(crowd.solve({.groups = std::array{3u}}), "group 3 does not exist; this crowd has 3");
}

TEST_CASE("a job whose groups lie outside its blocks solves nothing, on threads, too")
{
    Crowd crowd({limbs(16 * 2000), limbs(16)});
    const Float3 target{0.3f, 0.2f, 1};
    for (std::uint32_t g = 0; g < 2; ++g) crowd.write_all(SWIVEL_LENGTHS, g, Float2{1, 1});
    Streams frame;
    frame.in(SWIVEL_TARGET, {&target, 0});
    CHECK(crowd.solve({.blocks = swivel_blocks{0, 2000}, .groups = std::array{1u}, .streams = {frame}}) == 0);
    CHECK(crowd.solve({.groups = std::array{1u}, .streams = {frame}}) == 16);
    CHECK(crowd.solve({.groups = std::array{0u}, .streams = {frame}}) == 32000);
    CHECK_THROWS_WITH(frame.in(SWIVEL_FLAGS, {&target, 4}), "streams take in no result; give it by out()");
}

TEST_CASE("bad input keeps the pose in a frame that is read and written in place")
{
    struct Pose {
        Float4 shoulder, elbow;
        Float3 target;
        std::uint32_t flags;
    };
    for (const bool on_this_thread : {false, true})
        for (const bool masked : {false, true}) {
            const std::uint32_t count = 100;
            swivel_limb_def def = group_of(count);
            def.features = SWIVEL_JOINTS | SWIVEL_WITH_INCOMING | SWIVEL_WITH_WEIGHTS;
            def.on_bad_input = SWIVEL_KEEP_POSE;
            Crowd crowd(def);
            crowd.write_all(SWIVEL_WEIGHTS, 0, Float3{0.5f, 1, 1});
            Random random{3};
            std::vector<Pose> poses(count);
            for (Pose& pose : poses) {
                pose = {floats(random.rotation()), floats(random.rotation()), floats(random.direction()), 7};
                if (random.below(2)) pose.target[1] = kNan;
            }
            const std::vector<Pose> before = poses;
            crowd.write_all(SWIVEL_TARGET, 0, Float3{1, 1, 1});
            crowd.write_all(SWIVEL_LENGTHS, 0, Float2{1, 1});
            crowd.solve();
            const auto had = read<Float4>(crowd, SWIVEL_SHOULDER);
            Streams frame;
            frame.in(SWIVEL_TARGET, stream(poses, &Pose::target))
                .in(SWIVEL_INCOMING_SHOULDER, stream(poses, &Pose::shoulder))
                .in(SWIVEL_INCOMING_ELBOW, stream(poses, &Pose::elbow))
                .out(SWIVEL_SHOULDER, stream(poses, &Pose::shoulder))
                .out(SWIVEL_ELBOW, stream(poses, &Pose::elbow))
                .out(SWIVEL_FLAGS, stream(poses, &Pose::flags));
            const std::vector<std::uint32_t> mask(4, 0xffffbfffu);
            Job job{.streams = {frame}, .on_this_thread = on_this_thread};
            if (masked) job.mask = mask;
            if (on_this_thread) job.blocks = swivel_blocks{0, swivel_block_count(crowd.get())};
            crowd.solve(job);
            for (std::uint32_t n = 0; n < count; ++n) {
                const bool is_bad = std::isnan(before[n].target[1]), is_chosen = !masked || n % 32 != 14;
                INFO("limb " << n);
                CHECK((poses[n].flags == SWIVEL_BAD_INPUT) == (is_bad && is_chosen));
                CHECK((poses[n].flags == 7) == !is_chosen);
                CHECK((poses[n].shoulder == before[n].shoulder) == (is_bad || !is_chosen));
                CHECK((poses[n].elbow == before[n].elbow) == (is_bad || !is_chosen));
                CHECK((read<Float4>(crowd, SWIVEL_SHOULDER)[n] == had[n]) == (is_bad || !is_chosen));
            }
            const std::string says = explain(crowd, 0, 0);
            CHECK(says.find(std::isnan(before[0].target[1]) ? "keeps the pose it had" : "reached") !=
                  std::string::npos);
        }
}
