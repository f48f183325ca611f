// SPDX-License-Identifier: MIT
//
// The promise: memory is taken once, from whom it was told to, and nothing allocates afterwards.
#include "tests/allocation_count.h"
#include "tests/test_arm.h"
#include "tests/test_crowd.h"

#include <cstdlib>

#ifdef SWIVEL_WITH_TBB
#include <oneapi/tbb/task_arena.h>
#endif

using namespace swivel;
using namespace swivel::test;

namespace {

struct Ledger {
    std::size_t taken = 0, given_back = 0, bytes = 0, alignment = 0;
    void* memory = nullptr;
    bool empty = false;
};

}  // namespace

TEST_CASE("a crowd takes swivel_crowd_bytes() once, from whom it was told to")
{
    swivel_group_def groups[] = {group_of(100), group_of(3), group_of(50)};
    for (swivel_features features = 0; features < 16; ++features) {
        if ((features & SWIVEL_POLE_DIRECTION) && !(features & SWIVEL_WORLD)) continue;
        INFO("features " << features);
        swivel_crowd_def def = def_of(groups[0]);
        def.groups = groups;
        def.group_count = 3;
        for (swivel_group_def& group : groups) group.features = features;
        const std::size_t bytes = swivel_crowd_bytes(&def);
        REQUIRE(bytes % 64 == 0);

        Ledger ledger;
        def.user = &ledger;
        def.allocate = [](std::size_t size, std::size_t alignment, void* user) {
            Ledger& l = *static_cast<Ledger*>(user);
            ++l.taken;
            l.bytes = size;
            l.alignment = alignment;
            return l.memory = l.empty ? nullptr : std::aligned_alloc(alignment, size);
        };
        def.release = [](void* memory, std::size_t size, void* user) {
            Ledger& l = *static_cast<Ledger*>(user);
            l.given_back += memory == l.memory && size == l.bytes;
            std::free(memory);
        };
        {
            Crowd crowd(def);
            crowd.solve();
            CHECK(ledger.given_back == 0);
        }
        CHECK(ledger.taken == 1);
        CHECK(ledger.bytes == bytes);
        CHECK(ledger.alignment == 64);
        CHECK(ledger.given_back == 1);

        ledger.empty = true;
        swivel_crowd* crowd = reinterpret_cast<swivel_crowd*>(8);
        CHECK_REFUSED(swivel_crowd_create(&def, &crowd), SWIVEL_OUT_OF_MEMORY);
        CHECK(crowd == nullptr);

        // The caller's memory comes before the callbacks, and not a byte outside it is touched.
        std::vector<unsigned char> room(bytes + 192, 0xa5);
        const std::size_t start = 128 - reinterpret_cast<std::uintptr_t>(room.data()) % 64;
        def.memory = room.data() + start;
        def.memory_bytes = bytes;
        {
            Crowd in_place(def);
            CHECK(reinterpret_cast<void*>(in_place.get()) == def.memory);
            CHECK(ledger.taken == 2);
            for (std::uint32_t group = 0; group < 3; ++group) in_place.write_all(SWIVEL_TARGET, group, Float3{0, 1, 1});
            in_place.solve();
            const swivel_rows out = swivel_result_rows(in_place.get(), 2);
            const auto* end =
                reinterpret_cast<unsigned char*>(out.base + std::size_t{out.block_count} * out.row_count * 16);
            CHECK(end == room.data() + start + bytes);
        }
        CHECK(ledger.given_back == 1);
        for (std::size_t n = 0; n < room.size(); ++n)
            if (n < start || n >= start + bytes) REQUIRE(room[n] == 0xa5);

        def.memory_bytes = bytes - 1;
        CHECK_REFUSED(swivel_crowd_create(&def, &crowd), SWIVEL_OUT_OF_MEMORY);
        def.memory_bytes = bytes;
        def.memory = room.data() + start + 32;
        CHECK_REFUSED(swivel_crowd_create(&def, &crowd), SWIVEL_INVALID_ARGUMENT);
    }
}

TEST_CASE("nothing allocates after creation")
{
    // Every call once before counting: oneTBB starts its threads, the instruction set is chosen.
    const auto use = [](Crowd& crowd) {
        static std::vector<Float3> targets(5000, Float3{0, 1, 1});
        static std::vector<Float4> shoulders(5000);
        static std::vector<std::array<double, 3>> wrists(5000);
        static std::vector<double> residuals(5000);
        static const std::vector<std::uint32_t> mask(157, 0x80018001u);
        static const Frame own = Frame()
                                     .in(SWIVEL_TARGET, {targets.data(), sizeof targets[0]})
                                     .out(SWIVEL_SHOULDER, {shoulders.data(), sizeof shoulders[0]});
        static const swivel_frame frame = own;
        const std::span frames(&frame, 1);
        crowd.write(SWIVEL_TARGET, 0, targets);
        crowd.write_all(SWIVEL_POLE, 0, Float3{0, -1, 0});
        crowd.solve({.blocks = swivel_blocks{0, 200}, .on_this_thread = true});
        crowd.solve({.blocks = swivel_blocks{3, 200}, .mask = mask, .frames = frames, .on_this_thread = true});
        crowd.read(SWIVEL_SHOULDER, 0, shoulders);
        crowd.wrists(0, wrists);
        crowd.residuals(0, residuals);
        (void)swivel_solve(nullptr, nullptr);
    };
    for (const swivel_features features : {swivel_features{0}, swivel_features{SWIVEL_WORLD | SWIVEL_WITH_HAND}}) {
        Crowd crowd = crowd_of(features, 5000);
        if (features & SWIVEL_WORLD) crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, Float3{0, 0, 0});
        use(crowd);
        const std::size_t before = allocation_count();
        for (int n = 0; n < 20; ++n) use(crowd);
        CHECK(allocation_count() == before);

        const std::vector<std::uint32_t> mask(157, 0x80018001u), list{3, 4999, 17, 16, 800};
        const auto solve_in_every_way = [&] {
            crowd.solve();
            crowd.solve({.mask = mask});
            crowd.solve({.limbs = list});
        };
        const auto solve_alone = [&] {
#ifdef SWIVEL_WITH_TBB
            static oneapi::tbb::task_arena arena(1);
            arena.execute(solve_in_every_way);
#else
            solve_in_every_way();
#endif
        };
        for (int n = 0; n < 5; ++n) solve_alone();
        const std::size_t before_solve = allocation_count();
        for (int n = 0; n < 20; ++n) solve_alone();
        CHECK(allocation_count() == before_solve);
    }
    const std::size_t before = allocation_count();
    void* volatile by_new = ::operator new(1);  // a new expression may be left out
    void* volatile by_malloc = std::malloc(1);
    ::operator delete(by_new);
    std::free(by_malloc);
    CHECK(allocation_count() == before + 2);  // the counter counts
    const swivel_group_def group = group_of(100);
    swivel_crowd_def def = def_of(group);
    swivel_crowd* crowd = nullptr;
    const std::size_t before_create = allocation_count();
    swivel_crowd_create(&def, &crowd);
    CHECK(allocation_count() == before_create + 1);
    swivel_crowd_destroy(crowd);
}
