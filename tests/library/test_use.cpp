// SPDX-License-Identifier: MIT
//
// The promise of builds with SWIVEL_CHECK_USE: crowds that are destroyed, crowds that two threads use, and results that
// overlap inputs of other limbs are refused in one line; poses read and written in place are not. Other builds look for
// none of it, so the tests are empty there: the preset asan has the option on.
#include <rapidcheck/catch.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "tests/test_arm.h"
#include "tests/test_crowd.h"

using namespace swivel;
using namespace swivel::test;

#ifdef SWIVEL_CHECK_USE
TEST_CASE("a destroyed crowd is refused")
{
    const swivel_group_def group = group_of(20);
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
    constexpr std::uint32_t limbs = 64000;
    Crowd crowd({group(limbs)});
    const std::uint32_t blocks = swivel_block_count(crowd.get());
    std::atomic<bool> is_over = false;
    std::atomic<int> refused = 0;
    const auto use_until_over = [&](const auto& call) {
        while (!is_over)
            if (call() != SWIVEL_OK) ++refused;
    };
    const Float3 target{0.1f, 0.2f, 0.3f};
    std::thread writer([&] {
        use_until_over([&] { return swivel_write(crowd.get(), SWIVEL_TARGET, 0, 0, limbs, {&target, 0}); });
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
    constexpr std::uint32_t limbs = 5;
    Crowd crowd({group(limbs)});
    rc::prop("targets and flags anywhere in one array", [&] {
        const auto step = *rc::gen::inRange<std::size_t>(3, 8) * 4;  // bytes from limb to limb, in words
        const auto input = *rc::gen::inRange<std::size_t>(0, 60) * 4,
                   output = *rc::gen::inRange<std::size_t>(0, 60) * 4;
        const bool is_shared = *rc::gen::arbitrary<bool>();
        std::vector<float> room(256, 0.25f);
        char* const base = reinterpret_cast<char*>(room.data());
        const std::size_t input_stride = is_shared ? 0 : step;
        bool overlaps = false;
        for (std::size_t i = 0; i < limbs; ++i)
            for (std::size_t j = 0; j < limbs; ++j) {
                if (i == j && !is_shared) continue;
                const std::size_t in = input + i * input_stride, out = output + j * step;
                overlaps = overlaps || (out < in + 12 && in < out + 4);
            }
        const swivel_frame_field fields[] = {{SWIVEL_TARGET, base + input, input_stride},
                                             {SWIVEL_FLAGS, base + output, step}};
        swivel_frame frame = swivel_default_frame();
        frame.fields = fields;
        frame.field_count = 2;
        swivel_job job = swivel_default_job();
        job.frames = &frame;
        RC_ASSERT((swivel_solve(crowd.get(), &job) != SWIVEL_OK) == overlaps);
        RC_ASSERT(!overlaps || is_one_line(swivel_last_error()));
    });
}
#endif
