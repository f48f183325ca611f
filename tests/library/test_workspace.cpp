// SPDX-License-Identifier: MIT
//
// The promise: a solve works in the workspace that it is given, or in one of the crowd's that is free, and is refused
// without one. Plain arms need none. That no bit depends on what it holds before is test_bits.cpp's.
//
// Builds with SWIVEL_CHECK_USE also refuse, in one line, crowds that are destroyed, crowds that two threads use, and
// results that overlap each other or inputs of other limbs; poses read and written in place are not refused. Other
// builds look for none of it, so those tests are left out there: the preset asan has the option on.
#include <atomic>
#include <chrono>
#include <cstring>
#include <thread>

#include <rapidcheck/catch.h>

#include "tests/refused_definitions.h"
#include "tests/test_arm.h"
#include "tests/test_crowd.h"
#include "tests/test_random.h"

using namespace swivel;
using namespace swivel::test;

namespace {

constexpr swivel_features kSome = SWIVEL_WITH_SHOULDER_CONE | SWIVEL_WITH_SHOULDER_BOX | SWIVEL_WITH_REACH;

Crowd crowd_of_limbs(std::uint32_t workspace_count, std::uint32_t limb_count = 1000)
{
    const swivel_limb_def limb = limbs(limb_count, kSome);
    const swivel_group_def group = c_group(limb);
    swivel_crowd_def def = def_of(group);
    def.workspace_count = workspace_count;
    Crowd crowd(def);
    Random random{6};
    for (std::uint32_t n = 0; n < limb_count; ++n) {
        const Float3 target = floats(random.vector(0.2, 2));
        const Float4 narrow = cone({1, 0, 0}, random.between(0.2, 2));
        crowd.write(SWIVEL_TARGET, 0, std::span(&target, 1), n);
        crowd.write(SWIVEL_SHOULDER_CONE, 0, std::span(&narrow, 1), n);
    }
    crowd.write_all(SWIVEL_LENGTHS, 0, Float2{1, 1});
    const Float4 sides = range(-1, 1);
    std::array<float, 12> box;
    for (std::size_t k = 0; k < 3; ++k) std::ranges::copy(sides, box.begin() + 4 * k);
    crowd.write_all(SWIVEL_SHOULDER_BOX, 0, box);
    return crowd;
}

}  // namespace

TEST_CASE("a workspace is as large as the crowd needs it, and part of its memory")
{
    CHECK(swivel_workspace_bytes(nullptr) == 0);
    CHECK(swivel_workspace_bytes(Crowd(limbs(1000)).get()) == 0);
    const std::size_t small = swivel_workspace_bytes(crowd_of_limbs(1, 10).get()),
                      large = swivel_workspace_bytes(crowd_of_limbs(1, 100000).get());
    CHECK((small > 0 && small < large && large <= 65536 && large % 64 == 0));
    const swivel_limb_def limb = limbs(100000, kSome);
    const swivel_group_def group = c_group(limb);
    swivel_crowd_def def = def_of(group);
    const std::size_t one = swivel_crowd_bytes(&def);
    def.workspace_count = 5;
    CHECK(swivel_crowd_bytes(&def) == one + 4 * large);
}

TEST_CASE("a solve without a free workspace is refused and changes nothing")
{
    Crowd bare = crowd_of_limbs(0);
    const auto before = all_words(bare);
    CHECK_THROWS_WITH(bare.solve(), Catch::Contains("this crowd has no workspace"));
    CHECK((all_words(bare) == before));
    alignas(64) std::array<char, 68> workspace;
    CHECK_THROWS_WITH(bare.solve({.workspace = workspace.data() + 4}),
                      Catch::Contains("job.workspace is not aligned to 64"));
    Crowd arms(limbs(100, SWIVEL_WORLD | SWIVEL_WITH_HAND | SWIVEL_POLE_DIRECTION));
    CHECK(arms.solve() == 100);
}

TEST_CASE("as many jobs run together as the crowd has workspaces, and each other one is refused whole")
{
    constexpr std::uint32_t limb_count = 4096, thread_count = 4, blocks = limb_count / SWIVEL_LANES / thread_count;
    Crowd wanted = crowd_of_limbs(1, limb_count);
    wanted.solve();
    for (const std::uint32_t workspaces : {thread_count, 1u}) {
        Crowd crowd = crowd_of_limbs(workspaces, limb_count);
        std::atomic<int> refused = 0;
        std::vector<std::thread> threads;
        for (std::uint32_t n = 0; n < thread_count; ++n)
            threads.emplace_back([&, n] {
                const swivel_blocks part{n * blocks, blocks};
                swivel_job job = swivel_default_job();
                job.blocks = &part;
                job.on_this_thread = 1;
                for (int k = 0; k < 50; ++k)
                    while (swivel_solve(crowd.get(), &job) != SWIVEL_OK) ++refused;
            });
        for (std::thread& thread : threads) thread.join();
        INFO(workspaces << " workspaces, refused " << refused);
        CHECK((all_words(crowd) == all_words(wanted)));
        if (workspaces == thread_count) CHECK(refused == 0);
    }
}

#ifdef SWIVEL_CHECK_USE
TEST_CASE("a destroyed crowd is refused")
{
    const swivel_limb_def limb = group_of(20);
    const swivel_group_def group = c_group(limb);
    swivel_crowd_def def = def_of(group);
    std::vector<std::byte> room(swivel_crowd_bytes(&def) + 64);
    def.memory = room.data() + (64 - reinterpret_cast<std::uintptr_t>(room.data()) % 64);
    def.memory_bytes = swivel_crowd_bytes(&def);
    swivel_crowd* crowd = nullptr;
    REQUIRE(swivel_crowd_create(&def, &crowd) == SWIVEL_OK);
    CHECK(swivel_solve(crowd, nullptr) == SWIVEL_OK);
    swivel_crowd_destroy(crowd);
    Float3 value{};
    CHECK_REFUSED(swivel_solve(crowd, nullptr), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(swivel_write(crowd, SWIVEL_TARGET, 0, 0, 1, {&value, 12}), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(swivel_read(crowd, SWIVEL_TARGET, 0, 0, 1, {&value, 12}), SWIVEL_INVALID_ARGUMENT);
    CHECK(std::string(swivel_last_error()).find("destroyed") != std::string::npos);
    swivel_crowd_destroy(crowd);  // nothing happens
}

TEST_CASE("a crowd that two threads use is refused to one of them, jobs on their own threads are not")
{
    constexpr std::uint32_t limb_count = 64000;
    Crowd crowd(limbs(limb_count));
    const std::uint32_t blocks = swivel_block_count(crowd.get());
    std::atomic<bool> is_over = false;
    std::atomic<int> refused = 0;
    const auto use_until_over = [&](const auto& call) {
        while (!is_over)
            if (call() != SWIVEL_OK) ++refused;
    };
    const Float3 target{0.1f, 0.2f, 0.3f};
    std::thread writer([&] {
        use_until_over([&] { return swivel_write(crowd.get(), SWIVEL_TARGET, 0, 0, limb_count, {&target, 0}); });
    });
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (refused == 0 && std::chrono::steady_clock::now() < end)
        if (swivel_solve(crowd.get(), nullptr) != SWIVEL_OK) ++refused;
    is_over = true;
    writer.join();
    CHECK(refused > 0);

    std::vector<std::thread> jobs;
    std::atomic<int> failed = 0;
    for (std::uint32_t part = 0; part < 2; ++part)
        jobs.emplace_back([&, part] {
            const swivel_blocks half{part * blocks / 2, blocks / 2};
            swivel_job job = swivel_default_job();
            job.blocks = &half;
            job.on_this_thread = 1;
            for (int n = 0; n < 20; ++n) failed += swivel_solve(crowd.get(), &job) != SWIVEL_OK;
        });
    for (std::thread& job : jobs) job.join();
    CHECK(failed == 0);
}

TEST_CASE("frames are refused exactly where a result overlaps another limb's input")
{
    constexpr std::uint32_t limb_count = 5;
    Crowd crowd(limbs(limb_count));
    rc::prop("targets and flags anywhere in one array", [&] {
        const auto step = *rc::gen::inRange<std::size_t>(3, 8) * 4;  // bytes from limb to limb, in words
        const auto input = *rc::gen::inRange<std::size_t>(0, 60) * 4,
                   output = *rc::gen::inRange<std::size_t>(0, 60) * 4;
        const bool is_shared = *rc::gen::arbitrary<bool>();
        std::vector<float> room(256, 0.25f);
        char* const base = reinterpret_cast<char*>(room.data());
        const std::size_t input_stride = is_shared ? 0 : step;
        bool overlaps = false;
        for (std::size_t i = 0; i < limb_count; ++i)
            for (std::size_t j = 0; j < limb_count; ++j) {
                if (i == j && !is_shared) continue;
                const std::size_t in = input + i * input_stride, out = output + j * step;
                overlaps = overlaps || (out < in + 12 && in < out + 4);
            }
        const swivel_stream fields[] = {{SWIVEL_TARGET, base + input, input_stride},
                                        {SWIVEL_FLAGS, base + output, step}};
        swivel_streams frame = swivel_default_streams();
        frame.fields = fields;
        frame.field_count = 2;
        swivel_job job = swivel_default_job();
        job.streams = &frame;
        RC_ASSERT((swivel_solve(crowd.get(), &job) != SWIVEL_OK) == overlaps);
        RC_ASSERT(!overlaps || is_one_line(swivel_last_error()));
    });
}

TEST_CASE("streams are refused exactly where results overlap, if one stride is a multiple of the other")
{
    constexpr std::size_t limb_count = 5, size = 16;
    Crowd crowd(limbs(limb_count));
    rc::prop("rotations and flags anywhere in one array", [&] {
        const auto step = *rc::gen::inRange<std::size_t>(4, 9) * 4, times = *rc::gen::inRange<std::size_t>(1, 4);
        const auto first = *rc::gen::inRange<std::size_t>(0, 100) * 4,
                   flags = *rc::gen::inRange<std::size_t>(0, 100) * 4;
        const bool is_sparse = *rc::gen::arbitrary<bool>();
        const std::size_t stride = is_sparse ? step * times : step, flags_stride = is_sparse ? step : step * times;
        std::vector<float> room(400);
        char* const base = reinterpret_cast<char*>(room.data());
        bool overlaps = false;
        for (std::size_t i = 0; i < limb_count; ++i)
            for (std::size_t j = 0; j < limb_count; ++j) {
                const std::size_t one = first + i * stride, other = flags + j * flags_stride;
                overlaps = overlaps || (one < other + 4 && other < one + size);
            }
        const swivel_stream fields[] = {{SWIVEL_SHOULDER, base + first, stride},
                                        {SWIVEL_FLAGS, base + flags, flags_stride}};
        swivel_streams streams = swivel_default_streams();
        streams.fields = fields, streams.field_count = 2;
        swivel_job job = swivel_default_job();
        job.streams = &streams;
        RC_ASSERT((swivel_solve(crowd.get(), &job) != SWIVEL_OK) == overlaps);
        RC_ASSERT(!overlaps || is_one_line(swivel_last_error()));
    });
}

TEST_CASE("poses are refused exactly where a result overlaps another one, or what another joint is read from")
{
    constexpr std::size_t size = 16;
    rc::prop("rotations and results anywhere in one array", [&] {
        ArmDef arm;
        arm.joints[0].elbow = 3, arm.joints[0].wrist = 6;
        arm.limbs[0].features = SWIVEL_WITH_HAND | SWIVEL_POLE_INCOMING;
        const auto body_count = *rc::gen::inRange<std::uint32_t>(1, 4);
        arm.def.body_count = body_count;
        Crowd crowd(arm.def);
        const auto step = *rc::gen::inRange<std::size_t>(4, 60) * 4, times = *rc::gen::inRange<std::size_t>(0, 3);
        const auto from = *rc::gen::inRange<std::size_t>(0, 200) * 4;
        std::array<std::size_t, 7> offsets;
        for (std::size_t& offset : offsets) offset = *rc::gen::inRange<std::size_t>(0, 200) * 4;
        std::vector<float> room(1000);
        char* const base = reinterpret_cast<char*>(room.data());
        swivel_pose pose = swivel_default_pose();
        pose.rotations = {base + from, step * times, size, nullptr};
        pose.results = {base, step, 0, offsets.data()};
        bool overlaps = false;
        const auto meets = [&](std::size_t a, std::size_t b) { overlaps = overlaps || (a < b + size && b < a + size); };
        for (std::size_t i = 0; i < body_count; ++i)
            for (std::size_t k = 0; k < body_count; ++k)
                for (const std::size_t a : {1u, 3u, 6u}) {  // those that a limb turns
                    const std::size_t result = i * step + offsets[a];
                    for (const std::size_t b : {1u, 3u, 6u})
                        if (i != k || a != b) meets(result, k * step + offsets[b]);
                    for (std::size_t b = 0; b < 7; ++b)  // a joint may be written where it alone is read
                        if (i != k || a != b) meets(result, from + k * step * times + b * size);
                }
        swivel_job job = swivel_default_job();
        job.pose = &pose;
        RC_ASSERT((swivel_solve(crowd.get(), &job) != SWIVEL_OK) == overlaps);
        RC_ASSERT(!overlaps || is_one_line(swivel_last_error()));
    });
}
#endif
