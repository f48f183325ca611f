// SPDX-License-Identifier: MIT
//
// The promise: swivel.h's contract. Wrong arguments are refused and change nothing; data goes in and out whole; memory
// is taken once; threads do not meet; and what a crowd says in the world, through hands and through skeletons is what
// forward kinematics by Eigen, in double and on its own, makes of it.
#include "tests/count_allocations.h"
#include "tests/test_arm.h"
#include "tests/test_random.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#ifdef SWIVEL_WITH_TBB
#include <oneapi/tbb/task_arena.h>
#endif

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr std::uint32_t kEverything = SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND | SWIVEL_POLE_DIRECTION;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();

bool is_one_line(const std::string& text)
{
    return !text.empty() && text.find('\n') == std::string::npos && text.size() < 256;
}

// A failed call leaves one line of its own.
#define CHECK_REFUSED(call, expected)                        \
    do {                                                     \
        swivel_use_isa("no such thing"); /* another line */  \
        const std::string line_before = swivel_last_error(); \
        CHECK((call) == (expected));                         \
        CHECK(is_one_line(swivel_last_error()));             \
        CHECK(swivel_last_error() != line_before);           \
    } while (false)

swivel_group_def group_of(std::uint32_t limb_count)
{
    return {limb_count, {{0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}}};
}

swivel_crowd_def def_of(const swivel_group_def& group)
{
    swivel_crowd_def def = swivel_default_crowd_def();
    def.group_count = 1;
    def.groups = &group;
    return def;
}

// The whole of a crowd's rows.
std::vector<std::uint32_t> all_words(const Crowd& crowd)
{
    std::vector<std::uint32_t> words;
    for (const swivel_rows rows : {swivel_input_rows(crowd.get()), swivel_result_rows(crowd.get())}) {
        const std::size_t count = std::size_t{rows.block_count} * rows.row_count * SWIVEL_LANES, at = words.size();
        words.resize(at + count);
        std::memcpy(words.data() + at, rows.base, count * sizeof(float));
    }
    return words;
}

}  // namespace

// ---- arguments

TEST_CASE("a def that breaks its contract makes no crowd")
{
    const auto refuse = [](const swivel_crowd_def* def, swivel_status status = SWIVEL_INVALID_ARGUMENT) {
        swivel_crowd* crowd = reinterpret_cast<swivel_crowd*>(8);
        CHECK_REFUSED(swivel_crowd_create(def, &crowd), status);
        CHECK(crowd == nullptr);
        if (status == SWIVEL_INVALID_ARGUMENT) CHECK_REFUSED(swivel_crowd_bytes(def), 0u);
    };
    swivel_group_def groups[2] = {group_of(3), group_of(4)};
    const swivel_crowd_def good = def_of(groups[0]);
    swivel_crowd* crowd = nullptr;
    REQUIRE(swivel_crowd_create(&good, &crowd) == SWIVEL_OK);
    swivel_crowd_destroy(crowd);
    swivel_crowd_destroy(nullptr);

    CHECK_REFUSED(swivel_crowd_create(&good, nullptr), SWIVEL_INVALID_ARGUMENT);
    refuse(nullptr);
    swivel_crowd_def def = good;
    def.size = 0;
    refuse(&def);
    def.size = sizeof def - 1;
    refuse(&def);
    for (std::uint32_t bit = 4; bit < 32; ++bit) {
        def = good;
        def.features = 1u << bit;
        refuse(&def);
    }
    for (const std::uint32_t features :
         {0u, std::uint32_t{SWIVEL_JOINTS}, std::uint32_t{SWIVEL_JOINTS | SWIVEL_WITH_HAND}}) {
        def = good;
        def.features = features | SWIVEL_POLE_DIRECTION;
        refuse(&def);
    }
    def = good;
    def.group_count = 0;
    refuse(&def);
    def = good;
    def.groups = nullptr;
    refuse(&def);
    def = good;
    def.groups = groups;
    def.group_count = 2;
    groups[1].limb_count = 0;
    refuse(&def);
    groups[0].limb_count = groups[1].limb_count = 0x80000000u;  // together 2^32: counts must not wrap
    refuse(&def);
    groups[0].limb_count = 0xffffffffu;
    groups[1].limb_count = 1;
    refuse(&def);
    groups[0].limb_count = groups[1].limb_count = 3;
    def = good;
    def.allocate = [](std::size_t, std::size_t, void*) -> void* { return nullptr; };
    refuse(&def);
    def.allocate = nullptr;
    def.release = [](void*, std::size_t, void*) {};
    refuse(&def);
}

TEST_CASE("wrong arguments are refused and change nothing")
{
    const swivel_group_def groups[] = {group_of(20), group_of(5)};
    Crowd crowd(0, groups);
    crowd.solve();
    float in[3] = {1, 2, 3}, out[4] = {7, 7, 7, 7};
    double out3[3] = {7, 7, 7};
    const auto before = all_words(crowd);
    swivel_crowd* const c = crowd.get();
    const auto bad = SWIVEL_INVALID_ARGUMENT;

    CHECK_REFUSED(swivel_write(nullptr, SWIVEL_TARGET, 0, 0, 1, {in, 12}), bad);
    CHECK_REFUSED(swivel_write(c, SWIVEL_TARGET, 2, 0, 1, {in, 12}), bad);
    CHECK_REFUSED(swivel_write(c, SWIVEL_TARGET, ~0u, 0, 1, {in, 12}), bad);
    CHECK_REFUSED(swivel_write(c, SWIVEL_TARGET, 0, 21, 0, {in, 12}), bad);
    CHECK_REFUSED(swivel_write(c, SWIVEL_TARGET, 0, 20, 1, {in, 0}), bad);
    CHECK_REFUSED(swivel_write(c, SWIVEL_TARGET, 0, 0, 21, {in, 0}), bad);
    CHECK_REFUSED(swivel_write(c, SWIVEL_TARGET, 1, 4, 2, {in, 0}), bad);
    CHECK_REFUSED(swivel_write(c, SWIVEL_TARGET, 0, 1, ~0u, {in, 0}), bad);  // 1 + 2^32 - 1 must not wrap to 0
    CHECK_REFUSED(swivel_write(c, SWIVEL_TARGET, 0, ~0u, 1, {in, 0}), bad);
    CHECK_REFUSED(swivel_write(c, SWIVEL_TARGET, 0, 0, 1, {nullptr, 12}), bad);
    CHECK_REFUSED(swivel_write(c, SWIVEL_TARGET, 0, 0, 1, {in, 11}), bad);
    CHECK_REFUSED(swivel_write(c, SWIVEL_TARGET, 0, 0, 1, {in, 4}), bad);
    for (const swivel_field field : {SWIVEL_SHOULDER, SWIVEL_ELBOW, SWIVEL_WRIST, SWIVEL_FLAGS, SWIVEL_FIELD_COUNT,
                                     SWIVEL_PARENT_POSITION, SWIVEL_PARENT_ROTATION, SWIVEL_PARENT_SCALE, SWIVEL_HAND})
        CHECK_REFUSED(swivel_write(c, field, 0, 0, 1, {in, 0}), bad);

    CHECK_REFUSED(swivel_read(nullptr, SWIVEL_SHOULDER, 0, 0, 1, {out, 16}), bad);
    CHECK_REFUSED(swivel_read(c, SWIVEL_SHOULDER, 2, 0, 1, {out, 16}), bad);
    CHECK_REFUSED(swivel_read(c, SWIVEL_SHOULDER, 0, 20, 1, {out, 16}), bad);
    CHECK_REFUSED(swivel_read(c, SWIVEL_SHOULDER, 0, 0, 1, {nullptr, 16}), bad);
    CHECK_REFUSED(swivel_read(c, SWIVEL_SHOULDER, 0, 0, 1, {out, 15}), bad);
    CHECK_REFUSED(swivel_read(c, SWIVEL_SHOULDER, 0, 0, 1, {out, 0}), bad);
    for (const swivel_field field : {SWIVEL_WRIST, SWIVEL_HAND, SWIVEL_PARENT_SCALE, SWIVEL_FIELD_COUNT})
        CHECK_REFUSED(swivel_read(c, field, 0, 0, 1, {out, 16}), bad);

    CHECK_REFUSED(swivel_solve(nullptr), bad);
    CHECK_REFUSED(swivel_solve_blocks(nullptr, 0, 1), bad);
    REQUIRE(swivel_block_count(c) == 3);
    CHECK_REFUSED(swivel_solve_blocks(c, 0, 4), bad);
    CHECK_REFUSED(swivel_solve_blocks(c, 3, 1), bad);
    CHECK_REFUSED(swivel_solve_blocks(c, 4, 0), bad);
    CHECK_REFUSED(swivel_solve_blocks(c, 1, ~0u), bad);
    CHECK(swivel_solve_blocks(c, 3, 0) == SWIVEL_OK);

    const swivel_out none{}, three{out3, 24};
    CHECK_REFUSED(swivel_forward(nullptr, 0, 0, 1, three, none, none), bad);
    CHECK_REFUSED(swivel_forward(c, 2, 0, 1, three, none, none), bad);
    CHECK_REFUSED(swivel_forward(c, 0, 20, 1, three, none, none), bad);
    CHECK_REFUSED(swivel_forward(c, 0, 0, 1, {out3, 23}, none, none), bad);
    CHECK_REFUSED(swivel_forward(c, 0, 0, 1, none, {out3, 0}, none), bad);
    CHECK_REFUSED(swivel_forward(c, 0, 0, 1, none, none, three), bad);  // no hands here
    CHECK(swivel_forward(c, 0, 0, 1, none, none, none) == SWIVEL_OK);
    CHECK_REFUSED(swivel_residuals(nullptr, 0, 0, 1, {out3, 8}), bad);
    CHECK_REFUSED(swivel_residuals(c, 0, 0, 21, {out3, 8}), bad);
    CHECK_REFUSED(swivel_residuals(c, 0, 0, 1, {out3, 7}), bad);
    CHECK_REFUSED(swivel_residuals(c, 0, 0, 1, none), bad);

    CHECK(all_words(crowd) == before);
    for (const float x : out) CHECK(x == 7);
    for (const double x : out3) CHECK(x == 7);

    int passed = 5;
    CHECK_REFUSED(swivel_verify(1, 1, nullptr, nullptr, nullptr), bad);
    CHECK_REFUSED(swivel_verify(0, 1, nullptr, nullptr, &passed), bad);
    CHECK(passed == 5);
}

TEST_CASE("ranges of no limbs are allowed")
{
    Crowd crowd = crowd_of(0, 20);
    float value[4] = {7, 7, 7, 7};
    CHECK(swivel_write(crowd.get(), SWIVEL_TARGET, 0, 20, 0, {value, 12}) == SWIVEL_OK);
    CHECK(swivel_read(crowd.get(), SWIVEL_SHOULDER, 0, 0, 0, {value, 16}) == SWIVEL_OK);
    CHECK(value[0] == 7);
}

TEST_CASE("statuses and errors have their texts, errors belong to their thread")
{
    for (const int status : {0, 1, 2, 3, 4, 77}) {
        const std::string text = swivel_status_text(static_cast<swivel_status>(status));
        CHECK(is_one_line(text));
        CHECK((text == "unknown status") == (status == 77));
    }
    CHECK(swivel_version() == SWIVEL_VERSION);
    swivel_solve(nullptr);
    const std::string here = swivel_last_error();
    std::string before, after;
    std::thread([&] {
        before = swivel_last_error();
        swivel_use_isa("no such thing");
        after = swivel_last_error();
    }).join();
    CHECK(before.empty());
    CHECK(is_one_line(after));
    CHECK(swivel_last_error() == here);
}

TEST_CASE("the C++ wrapper throws the line and frees what it owns")
{
    try {
        Crowd crowd = crowd_of(0, 0);
        FAIL("a crowd without limbs");
    } catch (const Error& error) {
        CHECK(error.status == SWIVEL_INVALID_ARGUMENT);
        CHECK(std::string(error.what()) == swivel_last_error());
    }
    Crowd one = crowd_of(0, 3), two = crowd_of(0, 40);
    swivel_crowd* const first = one.get();
    two = std::move(one);
    CHECK(two.get() == first);
    const Crowd three(std::move(two));
    CHECK(three.get() == first);
    CHECK(two.get() == nullptr);
    CHECK_THROWS_AS(Crowd(swivel_default_crowd_def()), Error);
}

TEST_CASE("results as joints need bindings of unit rotations")
{
    swivel_group_def group = group_of(3);
    CHECK_NOTHROW(Crowd(SWIVEL_JOINTS, {&group, 1}));
    for (float* const q : {group.binding.parent_from_arm, group.binding.upper_from_arm, group.binding.fore_from_arm,
                           group.binding.shoulder_rest, group.binding.elbow_rest, group.binding.wrist_rest}) {
        for (const float w : {0.0f, 1.001f, std::numeric_limits<float>::quiet_NaN()}) {
            q[3] = w;
            CHECK_THROWS_WITH(Crowd(SWIVEL_JOINTS, {&group, 1}), Catch::Contains("group 0") && Catch::Contains("unit"));
            CHECK_NOTHROW(Crowd(0, {&group, 1}));
        }
        q[3] = 1;
    }
}

TEST_CASE("write_all checks the group and the value's size")
{
    const swivel_group_def group = group_of(3);
    Crowd crowd(0, {&group, 1});
    CHECK_THROWS_AS(crowd.write_all(SWIVEL_POLE, 7, Float3{0, 1, 0}), Error);
    CHECK_THROWS_AS(crowd.write_all(SWIVEL_POLE, 0, 1.0f), Error);
    CHECK(swivel_group_limb_count(crowd.get(), 7) == 0);
}

// ---- shape

TEST_CASE("groups start blocks, fields are rows in the order of the table")
{
    const swivel_group_def groups[] = {group_of(1), group_of(16), group_of(17), group_of(40)};
    const std::uint32_t first_limbs[] = {0, 16, 32, 64};
    for (std::uint32_t features = 0; features < 16; ++features) {
        if ((features & SWIVEL_POLE_DIRECTION) && !(features & SWIVEL_WORLD)) continue;
        const Crowd crowd(features, groups);
        INFO("features " << features);
        CHECK(swivel_block_count(crowd.get()) == 7);
        for (std::uint32_t g = 0; g < 4; ++g) {
            CHECK(swivel_group_first_limb(crowd.get(), g) == first_limbs[g]);
            CHECK(swivel_group_limb_count(crowd.get(), g) == groups[g].limb_count);
        }
        const bool world = features & SWIVEL_WORLD, joints = features & SWIVEL_JOINTS,
                   hand = features & SWIVEL_WITH_HAND;
        const std::uint32_t sizes[SWIVEL_FIELD_COUNT] = {3,
                                                         3,
                                                         2,
                                                         world ? 3u : 0u,
                                                         world ? 4u : 0u,
                                                         world ? 1u : 0u,
                                                         hand ? 4u : 0u,
                                                         4,
                                                         joints ? 4u : 2u,
                                                         hand ? 4u : 0u,
                                                         1};
        std::uint32_t row = 0;
        for (int f = 0; f < SWIVEL_FIELD_COUNT; ++f) {
            const auto field = static_cast<swivel_field>(f);
            if (field == SWIVEL_SHOULDER) {
                CHECK(swivel_input_rows(crowd.get()).row_count == row);
                row = 0;
            }
            CHECK(swivel_field_row_count(crowd.get(), field) == sizes[f]);
            if (sizes[f]) CHECK(swivel_field_first_row(crowd.get(), field) == row);
            row += sizes[f];
        }
        CHECK(swivel_result_rows(crowd.get()).row_count == row);
        CHECK(swivel_result_rows(crowd.get()).block_count == 7);
        for (const swivel_rows rows : {swivel_input_rows(crowd.get()), swivel_result_rows(crowd.get())})
            CHECK(reinterpret_cast<std::uintptr_t>(rows.base) % 64 == 0);
    }
}

TEST_CASE("a new crowd is at rest, its results are zeros")
{
    Crowd crowd = crowd_of(SWIVEL_WORLD | SWIVEL_WITH_HAND, 20);
    const swivel_rows out = swivel_result_rows(crowd.get());
    for (std::size_t n = 0; n < std::size_t{out.block_count} * out.row_count * SWIVEL_LANES; ++n)
        REQUIRE(out.base[n] == 0);
    CHECK(read<Float2>(crowd, SWIVEL_LENGTHS)[19] == Float2{1, 1});
    CHECK(read<Float4>(crowd, SWIVEL_PARENT_ROTATION)[19] == Float4{0, 0, 0, 1});
    CHECK(read<Float3>(crowd, SWIVEL_PARENT_POSITION)[19] == Float3{0, 0, 0});
    CHECK(read<Float1>(crowd, SWIVEL_PARENT_SCALE)[19] == Float1{1});
    CHECK(read<Float4>(crowd, SWIVEL_HAND)[19] == Float4{0, 0, 0, 1});
    crowd.solve();
    for (std::uint32_t limb = 0; limb < 32; ++limb) {  // padding, too
        const std::vector<std::uint32_t> words = result_words(crowd, limb);
        CHECK(words == result_words(crowd, 0));
        CHECK(words.back() == SWIVEL_REACHED);
    }
    CHECK(read<Float4>(crowd, SWIVEL_SHOULDER)[7] == Float4{0, 0, 0, 1});
    CHECK(read<Float2>(crowd, SWIVEL_ELBOW)[7] == Float2{1, 0});
    CHECK(read<Float4>(crowd, SWIVEL_WRIST)[7] == Float4{0, 0, 0, 1});
}

TEST_CASE("streams of any stride and alignment land in the documented place, bit for bit")
{
    const swivel_group_def groups[] = {group_of(5), group_of(37)};
    Crowd crowd(kEverything, groups);
    Random random{1};
    for (int f = 0; f < SWIVEL_FIELD_COUNT; ++f) {
        const auto field = static_cast<swivel_field>(f);
        const std::uint32_t rows_of_field = swivel_field_row_count(crowd.get(), field), count = 30, first = 3;
        const bool input = field < SWIVEL_SHOULDER;
        const std::size_t bytes = rows_of_field * sizeof(float);
        for (const std::size_t stride : {bytes, bytes + 1, bytes + 3, bytes + 4, std::size_t{97}}) {
            for (const std::size_t misaligned : {0u, 1u, 2u, 3u}) {
                INFO("field " << f << ", stride " << stride << ", from byte " << misaligned);
                const swivel_rows rows = input ? swivel_input_rows(crowd.get()) : swivel_result_rows(crowd.get());
                const std::uint32_t row0 = swivel_field_first_row(crowd.get(), field);
                const auto place = [&](std::uint32_t n, std::uint32_t c) {
                    const std::uint32_t limb = swivel_group_first_limb(crowd.get(), 1) + first + n;
                    return rows.base + (std::size_t{limb / 16} * rows.row_count + row0 + c) * 16 + limb % 16;
                };
                std::vector<unsigned char> data(misaligned + stride * count), got(data.size(), 0xee);
                for (unsigned char& byte : data) byte = static_cast<unsigned char>(random.word());
                if (input) {
                    const auto before = all_words(crowd);
                    REQUIRE(swivel_write(crowd.get(), field, 1, first, count, {data.data() + misaligned, stride}) ==
                            SWIVEL_OK);
                    for (std::uint32_t n = 0; n < count; ++n)
                        for (std::uint32_t c = 0; c < rows_of_field; ++c)
                            CHECK(std::memcmp(place(n, c), data.data() + misaligned + n * stride + c * 4, 4) == 0);
                    const auto after = all_words(crowd);
                    std::size_t changed = 0;
                    for (std::size_t n = 0; n < after.size(); ++n) changed += after[n] != before[n];
                    CHECK(changed <= std::size_t{count} * rows_of_field);
                } else {
                    for (std::uint32_t n = 0; n < count; ++n)
                        for (std::uint32_t c = 0; c < rows_of_field; ++c)
                            std::memcpy(place(n, c), data.data() + misaligned + n * stride + c * 4, 4);
                }
                REQUIRE(swivel_read(crowd.get(), field, 1, first, count, {got.data() + misaligned, stride}) ==
                        SWIVEL_OK);
                for (std::size_t n = 0; n < got.size(); ++n) {
                    const bool value = n >= misaligned && (n - misaligned) % stride < bytes;
                    REQUIRE(got[n] == (value ? data[n] : 0xee));
                }
            }
        }
        if (!input) continue;
        const float one[4] = {1.5f, -0.0f, kNan, 4};
        REQUIRE(swivel_write(crowd.get(), field, 1, first, count, {one, 0}) == SWIVEL_OK);
        std::vector<float> all(count * rows_of_field);
        REQUIRE(swivel_read(crowd.get(), field, 1, first, count, {all.data(), bytes}) == SWIVEL_OK);
        for (std::uint32_t n = 0; n < count; ++n) CHECK(std::memcmp(all.data() + n * rows_of_field, one, bytes) == 0);
    }
}

// ---- memory

namespace {

struct Ledger {
    std::size_t taken = 0, given_back = 0, bytes = 0, alignment = 0;
    void* memory = nullptr;
    bool empty = false;
};

}  // namespace

TEST_CASE("a crowd takes swivel_crowd_bytes() once, from whom it was told to")
{
    const swivel_group_def groups[] = {group_of(100), group_of(3), group_of(50)};
    for (std::uint32_t features = 0; features < 16; ++features) {
        if ((features & SWIVEL_POLE_DIRECTION) && !(features & SWIVEL_WORLD)) continue;
        INFO("features " << features);
        swivel_crowd_def def = def_of(groups[0]);
        def.groups = groups;
        def.group_count = 3;
        def.features = features;
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
            const swivel_rows out = swivel_result_rows(in_place.get());
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
        crowd.write(SWIVEL_TARGET, 0, targets);
        crowd.write_all(SWIVEL_POLE, 0, Float3{0, -1, 0});
        crowd.solve_blocks(0, 200);
        crowd.read(SWIVEL_SHOULDER, 0, shoulders);
        crowd.wrists(0, wrists);
        crowd.residuals(0, residuals);
        (void)swivel_solve(nullptr);
    };
    for (const std::uint32_t features : {0u, std::uint32_t{SWIVEL_WORLD | SWIVEL_WITH_HAND}}) {
        Crowd crowd = crowd_of(features, 5000);
        use(crowd);
        const std::size_t before = allocation_count();
        for (int n = 0; n < 20; ++n) use(crowd);
        CHECK(allocation_count() == before);

        const auto solve_alone = [&] {
#ifdef SWIVEL_WITH_TBB
            static oneapi::tbb::task_arena arena(1);
            arena.execute([&] { crowd.solve(); });
#else
            crowd.solve();
#endif
        };
        for (int n = 0; n < 5; ++n) solve_alone();
        const std::size_t before_solve = allocation_count();
        for (int n = 0; n < 20; ++n) solve_alone();
        CHECK(allocation_count() == before_solve);
    }
    const std::size_t before = allocation_count();
    int* volatile by_new = new int;
    void* volatile by_malloc = std::malloc(1);
    delete by_new;
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

// ---- threads

namespace {

void write_random(Crowd& crowd, std::uint64_t seed)
{
    Random random{seed};
    const std::uint32_t count = swivel_group_limb_count(crowd.get(), 0);
    std::vector<Float3> targets(count), poles(count);
    for (std::uint32_t n = 0; n < count; ++n) {
        targets[n] = floats(random.between(0, 2.2) * random.direction());
        poles[n] = floats(random.direction());
    }
    crowd.write(SWIVEL_TARGET, 0, targets);
    crowd.write(SWIVEL_POLE, 0, poles);
}

}  // namespace

TEST_CASE("two crowds on two threads do not meet")
{
    Crowd one = crowd_of(0, 3000), two = crowd_of(0, 3001);
    write_random(one, 1);
    write_random(two, 2);
    one.solve();
    two.solve();
    const auto one_alone = all_words(one), two_alone = all_words(two);
    bool same[2] = {true, true};
    const auto run = [](Crowd& crowd, const std::vector<std::uint32_t>& expected, bool& ok) {
        for (int n = 0; n < 40; ++n) {
            const swivel_rows out = swivel_result_rows(crowd.get());
            std::memset(out.base, 0, sizeof(float) * out.block_count * out.row_count * SWIVEL_LANES);
            ok = swivel_solve(crowd.get()) == SWIVEL_OK && all_words(crowd) == expected && ok;
        }
    };
    std::thread other([&] { run(two, two_alone, same[1]); });
    run(one, one_alone, same[0]);
    other.join();
    CHECK(same[0]);
    CHECK(same[1]);
}

TEST_CASE("several threads solve ranges of one crowd that do not overlap")
{
    Crowd crowd = crowd_of(0, 16 * 90);
    write_random(crowd, 3);
    crowd.solve();
    const auto expected = all_words(crowd);
    for (int round = 0; round < 20; ++round) {
        const swivel_rows out = swivel_result_rows(crowd.get());
        std::memset(out.base, 0xff, sizeof(float) * out.block_count * out.row_count * SWIVEL_LANES);
        std::vector<std::thread> threads;
        for (std::uint32_t t = 0; t < 3; ++t)
            threads.emplace_back([&crowd, t] {
                for (std::uint32_t block = t; block < 90; block += 3) swivel_solve_blocks(crowd.get(), block, 1);
            });
        for (std::thread& thread : threads) thread.join();
        REQUIRE(all_words(crowd) == expected);
    }
}

// ---- the world

namespace {

struct Parent {
    Vector3d position;
    Quaterniond rotation;  // unit
    double scale;
};

// What goes into the rows of one limb, as it was rounded to floats.
struct Limb {
    Float3 target, pole;
    Float2 lengths;
    Float3 position;
    Float4 rotation;
    Float1 scale;
    Float4 hand;

    Parent parent() const { return {vec(position), quat(rotation).normalized(), scale[0]}; }
};

// A limb in reach, bent, its pole well off the line; parent and hand quaternions of any length.
Limb random_limb(Random& random, std::uint32_t features, const Float2& lengths)
{
    Limb limb;
    limb.lengths = lengths;
    const bool world = features & SWIVEL_WORLD;
    limb.position = world ? floats(random.between(0, 5) * random.direction()) : Float3{0, 0, 0};
    limb.rotation =
        world ? floats(Quaterniond(random.spread(0.01, 100) * random.rotation().coeffs())) : Float4{0, 0, 0, 1};
    limb.scale = {world ? static_cast<float>(random.spread(0.1, 10)) : 1.0f};
    limb.hand = floats(Quaterniond(random.spread(0.01, 100) * random.rotation().coeffs()));
    const Parent parent = limb.parent();
    const double far = parent.scale * (double{lengths[0]} + lengths[1]),
                 near = parent.scale * std::fabs(double{lengths[0]} - lengths[1]);
    const Vector3d line = random.direction();
    limb.target = floats(Vector3d(parent.position + (near + (far - near) * random.between(0.05, 0.95)) * line));
    const Vector3d pole = random.between(-1, 1) * line + random.between(0.3, 2) * random.across(line);
    limb.pole = floats(Vector3d(features & SWIVEL_POLE_DIRECTION ? pole : parent.position + parent.scale * pole));
    return limb;
}

Vector3d pole_direction(const Limb& limb, std::uint32_t features)
{
    return features & SWIVEL_POLE_DIRECTION ? vec(limb.pole) : vec(limb.pole) - vec(limb.position);
}

void write_limb(Crowd& crowd, std::uint32_t group, std::uint32_t n, const Limb& limb)
{
    const auto put = [&](swivel_field field, const auto& value) {
        if (swivel_field_row_count(crowd.get(), field)) crowd.write(field, group, std::span(&value, 1), n);
    };
    put(SWIVEL_TARGET, limb.target);
    put(SWIVEL_POLE, limb.pole);
    put(SWIVEL_LENGTHS, limb.lengths);
    put(SWIVEL_PARENT_POSITION, limb.position);
    put(SWIVEL_PARENT_ROTATION, limb.rotation);
    put(SWIVEL_PARENT_SCALE, limb.scale);
    put(SWIVEL_HAND, limb.hand);
}

struct Places {
    Vector3d elbow, wrist;
    Quaterniond hand;
};

// An arm in its own frame carried along by its parent.
Places places_of(const Limb& limb, const Float4& shoulder, const Float2& elbow, const Float4& wrist)
{
    const Parent parent = limb.parent();
    const Quaterniond q_s = parent.rotation * quat(shoulder).normalized();
    const Quaterniond q_e = Quaterniond(elbow[0], -double{elbow[1]}, 0, 0).normalized();
    const Vector3d elbow_w = parent.position + parent.scale * (q_s * Vector3d(0, 0, limb.lengths[0]));
    return {elbow_w, elbow_w + parent.scale * (q_s * q_e * Vector3d(0, 0, limb.lengths[1])),
            q_s * q_e * quat(wrist).normalized()};
}

// 1.5e-6 arm lengths: the wrist's own 1e-6 and the rounding of the frame's rotor.
constexpr double kWristError = 1.5e-6;

void check_places(const Limb& limb, std::uint32_t features, const Places& got, std::uint32_t flags)
{
    const double length = double{limb.scale[0]} * (double{limb.lengths[0]} + limb.lengths[1]);
    CHECK((got.wrist - vec(limb.target)).norm() <= kWristError * length);
    const Vector3d line = (vec(limb.target) - vec(limb.position)).normalized();
    const Vector3d pole = pole_direction(limb, features), across = (pole - pole.dot(line) * line).normalized();
    const Vector3d elbow = got.elbow - vec(limb.position);
    CHECK(elbow.dot(across) > 0);
    CHECK(std::fabs(elbow.dot(line.cross(across))) <= 3e-6 * length);  // in the plane of shoulder, target and pole
    if (features & SWIVEL_WITH_HAND) CHECK(distance(got.hand, quat(limb.hand).normalized()) <= 1e-6);
    CHECK(flags == SWIVEL_REACHED);
}

// tolerance: with skeletons the library goes by the binding's floats, the places here by the skeleton itself.
void check_forward(const Crowd& crowd, std::uint32_t group, const std::vector<Limb>& limbs,
                   const std::vector<Places>& places, double tolerance)
{
    const std::size_t count = limbs.size();
    std::vector<std::array<double, 3>> elbows(count), wrists(count);
    std::vector<std::array<double, 4>> hands(count);
    std::vector<double> residuals(count);
    crowd.elbows(group, elbows);
    crowd.wrists(group, wrists);
    crowd.residuals(group, residuals);
    const bool with_hand = swivel_field_row_count(crowd.get(), SWIVEL_HAND);
    if (with_hand) crowd.hands(group, hands);
    for (std::size_t n = 0; n < count; ++n) {
        const double length = double{limbs[n].scale[0]} * (double{limbs[n].lengths[0]} + limbs[n].lengths[1]);
        const double size = length + vec(limbs[n].position).norm();
        CHECK((Vector3d(elbows[n].data()) - places[n].elbow).norm() <= tolerance * size);
        CHECK((Vector3d(wrists[n].data()) - places[n].wrist).norm() <= tolerance * size);
        const double residual = (places[n].wrist - vec(limbs[n].target)).norm() / length;
        CHECK(std::fabs(residuals[n] - residual) <= tolerance * size / length);
        if (with_hand) CHECK(distance(Quaterniond(hands[n].data()), places[n].hand) <= tolerance);
    }
}

}  // namespace

TEST_CASE("arms in the arm frame and in the world: wrist on the target, elbow on the pole's side, hand as wanted")
{
    const std::uint32_t w = SWIVEL_WORLD, h = SWIVEL_WITH_HAND, d = SWIVEL_POLE_DIRECTION;
    for (const std::uint32_t features : {0u, h, w, w | h, w | d, w | h | d}) {
        constexpr std::uint32_t count = 400;
        Crowd crowd = crowd_of(features, count);
        Random random{features + 11};
        std::vector<Limb> limbs;
        for (std::uint32_t n = 0; n < count; ++n) {
            const Float2 lengths = {static_cast<float>(random.spread(0.2, 5)),
                                    static_cast<float>(random.spread(0.2, 5))};
            limbs.push_back(random_limb(random, features, lengths));
            write_limb(crowd, 0, n, limbs.back());
        }
        crowd.solve();
        const auto shoulders = read<Float4>(crowd, SWIVEL_SHOULDER);
        const auto elbows = read<Float2>(crowd, SWIVEL_ELBOW);
        const auto wrists =
            features & h ? read<Float4>(crowd, SWIVEL_WRIST) : std::vector<Float4>(count, Float4{0, 0, 0, 1});
        const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
        std::vector<Places> places;
        for (std::uint32_t n = 0; n < count; ++n) {
            INFO("features " << features << ", limb " << n);
            places.push_back(places_of(limbs[n], shoulders[n], elbows[n], wrists[n]));
            check_places(limbs[n], features, places.back(), flags[n]);
            CHECK(is_unit(shoulders[n]));
            CHECK(is_unit(wrists[n]));
            CHECK(is_in_hemisphere(shoulders[n]));
            CHECK(is_in_hemisphere(wrists[n]));
        }
        check_forward(crowd, 0, limbs, places, 1e-12);
    }
}

TEST_CASE("a world frame of identity gives the arm frame's bits")
{
    constexpr std::uint32_t count = 100;
    for (const std::uint32_t features : {0u, std::uint32_t{SWIVEL_WITH_HAND}}) {
        Crowd arm = crowd_of(features, count), world = crowd_of(features | SWIVEL_WORLD, count);
        Random random{5};
        for (std::uint32_t n = 0; n < count; ++n) {
            const Limb limb = random_limb(random, features, {1, 1.25f});
            write_limb(arm, 0, n, limb);
            write_limb(world, 0, n, limb);
        }
        arm.solve();
        world.solve();
        for (std::uint32_t n = 0; n < count; ++n) CHECK(result_words(arm, n) == result_words(world, n));
    }
}

TEST_CASE("a frame's power-of-two scale changes no bit")
{
    constexpr std::uint32_t count = 100;
    Crowd one = crowd_of(SWIVEL_WORLD, count), scaled = crowd_of(SWIVEL_WORLD, count);
    Random random{6};
    for (std::uint32_t n = 0; n < count; ++n) {
        Limb limb = random_limb(random, SWIVEL_WORLD, {1, 1.25f});
        write_limb(one, 0, n, limb);
        for (Float3* v : {&limb.target, &limb.pole, &limb.position})
            for (float& x : *v) x *= 4;
        limb.scale[0] *= 4;
        write_limb(scaled, 0, n, limb);
    }
    one.solve();
    scaled.solve();
    for (std::uint32_t n = 0; n < count; ++n) CHECK(result_words(one, n) == result_words(scaled, n));
}

TEST_CASE("residuals of what cannot be reached, of no arm and of bad input")
{
    Crowd crowd = crowd_of(0, 4);
    crowd.write(SWIVEL_TARGET, 0, std::vector<Float3>{{0, 6, 0}, {0, 0.25f, 0}, {0, 1, 0}, {kNan, 1, 0}});
    crowd.write(SWIVEL_LENGTHS, 0, std::vector<Float2>{{1, 1}, {3, 1}, {0, 0}, {1, 1}});
    crowd.solve();
    std::vector<double> residuals(4);
    crowd.residuals(0, residuals);
    CHECK(std::fabs(residuals[0] - 2) <= 1e-6);
    CHECK(std::fabs(residuals[1] - 1.75 / 4) <= 1e-6);
    CHECK(residuals[2] == 0);
    CHECK(residuals[3] == 0);
}

// ---- skeletons

namespace {

enum class Rest { straight, bent, bent_by_itself };  // the last: no hinge given, the rest pose shows it

// A shoulder, elbow and wrist with random rest rotations and bone axes.
swivel_chain random_chain(Random& random, Rest rest)
{
    swivel_chain chain{};
    const auto put3 = [](float(&to)[3], const Vector3d& v) { std::ranges::copy(floats(v), to); };
    const auto put4 = [&random](float(&to)[4], const Quaterniond& q) {
        std::ranges::copy(floats(Quaterniond(random.spread(0.1, 10) * q.coeffs())), to);
    };
    put4(chain.shoulder_rotation, random.rotation());
    put4(chain.elbow_rotation, random.rotation());
    put4(chain.wrist_rotation, random.rotation());
    const Vector3d upper = random.direction(), hinge = random.across(upper);
    const double flexion = rest == Rest::straight ? 0 : random.between(0.1, 2.5);
    const Vector3d fore = Eigen::AngleAxisd(-flexion, hinge) * upper;  // flexion turns about -hinge
    put3(chain.elbow_offset, random.spread(0.5, 5) * upper);
    put3(chain.wrist_offset, random.spread(0.5, 5) * (quat(chain.elbow_rotation).normalized().conjugate() * fore));
    if (rest != Rest::bent_by_itself) put3(chain.hinge, random.spread(0.1, 10) * hinge);
    return chain;
}

// The hinge in the shoulder joint's frame, as the documentation of swivel_chain has it.
Vector3d hinge_of(const swivel_chain& chain)
{
    if (vec(chain.hinge).norm() > 0) return vec(chain.hinge).normalized();
    const Vector3d fore = quat(chain.elbow_rotation).normalized() * vec(chain.wrist_offset);
    return fore.cross(vec(chain.elbow_offset)).normalized();
}

struct Joints {
    Quaterniond shoulder, elbow, wrist;  // local
};

// Down the skeleton from the parent joint: nothing of the arm frame is in it.
Places places_of(const swivel_chain& chain, const Parent& parent, const Joints& local)
{
    const Quaterniond shoulder_w = parent.rotation * local.shoulder, elbow_w = shoulder_w * local.elbow;
    const Vector3d elbow = parent.position + parent.scale * (shoulder_w * vec(chain.elbow_offset));
    return {elbow, elbow + parent.scale * (elbow_w * vec(chain.wrist_offset)), elbow_w * local.wrist};
}

Joints joints_of(const Crowd& crowd, std::uint32_t group, std::uint32_t n)
{
    Float4 q[3] = {{}, {}, {0, 0, 0, 1}};
    crowd.read(SWIVEL_SHOULDER, group, std::span(q, 1), n);
    crowd.read(SWIVEL_ELBOW, group, std::span(q + 1, 1), n);
    if (swivel_field_row_count(crowd.get(), SWIVEL_WRIST)) crowd.read(SWIVEL_WRIST, group, std::span(q + 2, 1), n);
    for (const Float4& each : q) {
        CHECK(is_unit(each));
        CHECK(is_in_hemisphere(each));
    }
    return {quat(q[0]).normalized(), quat(q[1]).normalized(), quat(q[2]).normalized()};
}

// Without a world the arm frame is the space of the targets; the parent joint is then seen from it.
Parent parent_of(const Limb& limb, const swivel_binding& binding, std::uint32_t features)
{
    if (features & SWIVEL_WORLD) return limb.parent();
    return {Vector3d::Zero(), quat(binding.parent_from_arm).normalized().conjugate(), 1};
}

Joints rest_of(const swivel_chain& chain)
{
    return {quat(chain.shoulder_rotation).normalized(), quat(chain.elbow_rotation).normalized(),
            quat(chain.wrist_rotation).normalized()};
}

constexpr std::uint32_t kGroups = 12, kLimbs = 21;

}  // namespace

TEST_CASE("skeletons: local rotations put the wrist on its target, the hand as wanted, the elbow on the pole's side")
{
    const std::uint32_t j = SWIVEL_JOINTS, w = SWIVEL_WORLD, h = SWIVEL_WITH_HAND, d = SWIVEL_POLE_DIRECTION;
    for (const std::uint32_t features : {j, j | h, j | w, j | w | h, j | w | d, j | w | h | d})
        for (const Rest rest : {Rest::straight, Rest::bent, Rest::bent_by_itself}) {
            Random random{features * 3 + static_cast<std::uint64_t>(rest)};
            std::vector<swivel_chain> chains;
            std::vector<swivel_group_def> groups;
            std::vector<BoundLimb> bound;
            for (std::uint32_t g = 0; g < kGroups; ++g) {
                chains.push_back(random_chain(random, rest));
                bound.push_back(bind(chains.back()));
                groups.push_back({kLimbs, bound.back().binding});
                CHECK(std::fabs(bound[g].lengths[0] - vec(chains[g].elbow_offset).norm()) <=
                      1e-6 * bound[g].lengths[0]);
                CHECK(std::fabs(bound[g].lengths[1] - vec(chains[g].wrist_offset).norm()) <=
                      1e-6 * bound[g].lengths[1]);
            }
            Crowd crowd(features, groups);
            std::vector<std::vector<Limb>> limbs(kGroups);
            for (std::uint32_t g = 0; g < kGroups; ++g)
                for (std::uint32_t n = 0; n < kLimbs; ++n) {
                    limbs[g].push_back(random_limb(random, features, {bound[g].lengths[0], bound[g].lengths[1]}));
                    write_limb(crowd, g, n, limbs[g].back());
                }
            crowd.solve();
            for (std::uint32_t g = 0; g < kGroups; ++g) {
                const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS, g);
                const Vector3d hinge = hinge_of(chains[g]);
                const Vector3d hinge_e = quat(chains[g].elbow_rotation).normalized().conjugate() * hinge;
                std::vector<Places> places;
                for (std::uint32_t n = 0; n < kLimbs; ++n) {
                    INFO("features " << features << ", rest " << static_cast<int>(rest) << ", group " << g << ", limb "
                                     << n);
                    const Joints local = joints_of(crowd, g, n);
                    const Parent parent = parent_of(limbs[g][n], bound[g].binding, features);
                    places.push_back(places_of(chains[g], parent, local));
                    check_places(limbs[g][n], features, places.back(), flags[n]);
                    // The elbow joint turns about the hinge alone, and bends the forearm about -hinge.
                    CHECK((local.elbow * hinge_e - hinge).norm() <= 2e-6);
                    const Vector3d upper = vec(chains[g].elbow_offset),
                                   fore = local.elbow * vec(chains[g].wrist_offset);
                    CHECK(upper.cross(fore).dot(-hinge) > 0);
                }
                check_forward(crowd, g, limbs[g], places, 5e-7);
            }
        }
}

TEST_CASE("skeletons: the rest pose's own wrist and elbow give back the rest rotations")
{
    for (const Rest rest : {Rest::bent, Rest::bent_by_itself})
        for (std::uint64_t seed = 0; seed < 60; ++seed) {
            INFO("rest " << static_cast<int>(rest) << ", seed " << seed);
            Random random{seed};
            const swivel_chain chain = random_chain(random, rest);
            const BoundLimb bound = bind(chain);
            constexpr std::uint32_t features = SWIVEL_JOINTS | SWIVEL_WORLD | SWIVEL_WITH_HAND;
            Crowd crowd = crowd_of(features, 1, bound.binding);
            Limb limb = random_limb(random, features, {bound.lengths[0], bound.lengths[1]});
            const Places places = places_of(chain, limb.parent(), rest_of(chain));
            limb.target = floats(places.wrist);
            limb.pole = floats(places.elbow);
            limb.hand = floats(places.hand);
            write_limb(crowd, 0, 0, limb);
            crowd.solve();
            const Joints got = joints_of(crowd, 0, 0), want = rest_of(chain);
            // The target's rounding, seen from a parent 5 units away, through a bend of down to 0.1.
            CHECK(distance(got.shoulder, want.shoulder) <= 1e-4);
            CHECK(distance(got.elbow, want.elbow) <= 1e-4);
            CHECK(distance(got.wrist, want.wrist) <= 1e-4);
        }
}

TEST_CASE("skeletons: a tilted hinge still turns about one axis of the upper arm")
{
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        INFO("seed " << seed);
        Random random{seed};
        swivel_chain chain = random_chain(random, Rest::bent);
        const Vector3d tilted = hinge_of(chain) + 0.5 * vec(chain.elbow_offset).normalized();
        std::ranges::copy(floats(tilted), chain.hinge);
        const BoundLimb bound = bind(chain);
        constexpr std::uint32_t count = 16, features = SWIVEL_JOINTS | SWIVEL_WORLD;
        Crowd crowd = crowd_of(features, count, bound.binding);
        std::vector<Limb> limbs;
        for (std::uint32_t n = 0; n < count; ++n) {
            limbs.push_back(random_limb(random, features, {bound.lengths[0], bound.lengths[1]}));
            write_limb(crowd, 0, n, limbs.back());
        }
        crowd.solve();
        const Vector3d upper = vec(chain.elbow_offset).normalized();
        const Vector3d axis = (tilted - tilted.dot(upper) * upper).normalized();
        const Quaterniond first = joints_of(crowd, 0, 0).elbow;
        for (std::uint32_t n = 0; n < count; ++n) {
            const Joints local = joints_of(crowd, 0, n);
            const Places places = places_of(chain, limbs[n].parent(), local);
            check_places(limbs[n], features, places, SWIVEL_REACHED);
            CHECK((local.elbow * first.conjugate()).vec().cross(axis).norm() <= 2e-6);
        }
    }
}

TEST_CASE("skeletons: the negated hinge bends the limb the other way")
{
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        INFO("seed " << seed);
        Random random{seed};
        swivel_chain chain = random_chain(random, Rest::straight);
        constexpr std::uint32_t features = SWIVEL_JOINTS | SWIVEL_WORLD;
        const BoundLimb one = bind(chain);
        for (float& x : chain.hinge) x = -x;
        const BoundLimb other = bind(chain);
        const swivel_group_def groups[] = {{1, one.binding}, {1, other.binding}};
        Crowd crowd(features, groups);
        const Limb limb = random_limb(random, features, {one.lengths[0], one.lengths[1]});
        write_limb(crowd, 0, 0, limb);
        write_limb(crowd, 1, 0, limb);
        crowd.solve();
        const Joints a = joints_of(crowd, 0, 0), b = joints_of(crowd, 1, 0);
        for (const Joints& local : {a, b})
            check_places(limb, features, places_of(chain, limb.parent(), local), SWIVEL_REACHED);
        const Quaterniond rest = quat(chain.elbow_rotation).normalized();
        // The same bend from straight, in opposite senses: one undoes the other.
        CHECK(distance(a.elbow * rest.conjugate(), (b.elbow * rest.conjugate()).conjugate()) <= 2e-6);
        CHECK(distance(a.elbow, b.elbow) > 0.01);
    }
}

TEST_CASE("skeletons: a mirrored limb with mirrored goals has mirrored rotations")
{
    const auto mirror3 = [](const Float3& v) { return Float3{-v[0], v[1], v[2]}; };
    const auto mirror4 = [](const Float4& q) { return Float4{q[0], -q[1], -q[2], q[3]}; };
    const auto as3 = [](const float(&v)[3]) { return Float3{v[0], v[1], v[2]}; };
    const auto as4 = [](const float(&q)[4]) { return Float4{q[0], q[1], q[2], q[3]}; };
    const auto mirrored = [&](const Quaterniond& q) { return Quaterniond(q.w(), q.x(), -q.y(), -q.z()); };
    for (const Rest rest : {Rest::straight, Rest::bent, Rest::bent_by_itself})
        for (std::uint64_t seed = 0; seed < 40; ++seed) {
            INFO("rest " << static_cast<int>(rest) << ", seed " << seed);
            Random random{seed};
            const swivel_chain left = random_chain(random, rest);
            swivel_chain right = left;
            std::ranges::copy(mirror4(as4(left.shoulder_rotation)), right.shoulder_rotation);
            std::ranges::copy(mirror4(as4(left.elbow_rotation)), right.elbow_rotation);
            std::ranges::copy(mirror4(as4(left.wrist_rotation)), right.wrist_rotation);
            std::ranges::copy(mirror3(as3(left.elbow_offset)), right.elbow_offset);
            std::ranges::copy(mirror3(as3(left.wrist_offset)), right.wrist_offset);
            const Float3 hinge = mirror3(as3(left.hinge));  // an axis of turning mirrors with the other sign
            std::ranges::copy(Float3{-hinge[0], -hinge[1], -hinge[2]}, right.hinge);
            const BoundLimb l = bind(left), r = bind(right);
            constexpr std::uint32_t features = SWIVEL_JOINTS | SWIVEL_WORLD | SWIVEL_WITH_HAND;
            const swivel_group_def groups[] = {{1, l.binding}, {1, r.binding}};
            Crowd crowd(features, groups);
            const Limb limb = random_limb(random, features, {l.lengths[0], l.lengths[1]});
            Limb other = limb;
            other.target = mirror3(limb.target);
            other.pole = mirror3(limb.pole);
            other.position = mirror3(limb.position);
            other.rotation = mirror4(limb.rotation);
            other.hand = mirror4(limb.hand);
            write_limb(crowd, 0, 0, limb);
            write_limb(crowd, 1, 0, other);
            crowd.solve();
            const Joints a = joints_of(crowd, 0, 0), b = joints_of(crowd, 1, 0);
            CHECK(distance(mirrored(a.shoulder), b.shoulder) <= 1e-5);
            CHECK(distance(mirrored(a.elbow), b.elbow) <= 1e-5);
            CHECK(distance(mirrored(a.wrist), b.wrist) <= 1e-5);
        }
}

TEST_CASE("skeletons: bad input leaves the skeleton's own rest rotations")
{
    Random random{4};
    const swivel_chain chain = random_chain(random, Rest::bent);
    Crowd crowd = crowd_of(SWIVEL_JOINTS | SWIVEL_WITH_HAND, 3, bind(chain).binding);
    crowd.write(SWIVEL_TARGET, 0, std::vector<Float3>{{0, 0, 1}, {kInf, 0, 0}, {0, 0, 1}});
    crowd.solve();
    CHECK(read<std::uint32_t>(crowd, SWIVEL_FLAGS)[1] == SWIVEL_BAD_INPUT);
    const Joints got = joints_of(crowd, 0, 1), rest = rest_of(chain);
    CHECK(distance(got.shoulder, rest.shoulder) <= 1e-7);
    CHECK(distance(got.elbow, rest.elbow) <= 1e-7);
    CHECK(distance(got.wrist, rest.wrist) <= 1e-7);
    CHECK(distance(joints_of(crowd, 0, 0).shoulder, rest.shoulder) > 1e-3);
}

TEST_CASE("swivel_bind refuses what is not a limb, and changes nothing")
{
    Random random{9};
    const auto refuse = [&](const char* what, Rest rest, auto spoil) {
        INFO(what);
        swivel_chain chain = random_chain(random, rest);
        swivel_binding binding;
        float lengths[2] = {7, 7};
        REQUIRE(swivel_bind(&chain, &binding, lengths) == SWIVEL_OK);
        std::memset(&binding, 0x5a, sizeof binding);
        const swivel_binding untouched = binding;
        lengths[0] = lengths[1] = 7;
        spoil(chain);
        CHECK_REFUSED(swivel_bind(&chain, &binding, lengths), SWIVEL_INVALID_ARGUMENT);
        CHECK(std::memcmp(&binding, &untouched, sizeof binding) == 0);
        CHECK(lengths[0] == 7);
        CHECK(lengths[1] == 7);
    };
    const auto fill = [](auto& values, float x) { std::ranges::fill(values, x); };
    for (const float bad : {0.0f, kNan, kInf, 1e-20f, 3e38f}) {
        refuse("shoulder rotation", Rest::bent, [&](swivel_chain& c) { fill(c.shoulder_rotation, bad); });
        refuse("elbow rotation", Rest::bent, [&](swivel_chain& c) { fill(c.elbow_rotation, bad); });
        refuse("wrist rotation", Rest::bent, [&](swivel_chain& c) { fill(c.wrist_rotation, bad); });
        refuse("upper arm", Rest::bent, [&](swivel_chain& c) { fill(c.elbow_offset, bad); });
        refuse("forearm", Rest::bent, [&](swivel_chain& c) { fill(c.wrist_offset, bad); });
    }
    for (const float bad : {kNan, kInf, 3e38f})
        refuse("hinge", Rest::bent, [&](swivel_chain& c) { fill(c.hinge, bad); });
    for (const float one : {kNan, kInf}) {
        refuse("one number of a rotation", Rest::bent, [&](swivel_chain& c) { c.wrist_rotation[1] = one; });
        refuse("one number of an offset", Rest::bent, [&](swivel_chain& c) { c.wrist_offset[2] = one; });
    }
    refuse("hinge along the upper arm", Rest::bent,
           [](swivel_chain& c) { std::ranges::copy(c.elbow_offset, c.hinge); });
    refuse("hinge against the upper arm", Rest::bent,
           [](swivel_chain& c) { std::ranges::copy(floats(Vector3d(-vec(c.elbow_offset))), c.hinge); });
    refuse("hinge along the forearm", Rest::bent, [](swivel_chain& c) {
        std::ranges::copy(floats(Vector3d(quat(c.elbow_rotation).normalized() * vec(c.wrist_offset))), c.hinge);
    });
    refuse("straight without a hinge", Rest::straight, [](swivel_chain& c) { std::ranges::fill(c.hinge, 0.0f); });

    swivel_chain chain = random_chain(random, Rest::bent);
    swivel_binding binding;
    CHECK_REFUSED(swivel_bind(nullptr, &binding, nullptr), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(swivel_bind(&chain, nullptr, nullptr), SWIVEL_INVALID_ARGUMENT);
    CHECK(swivel_bind(&chain, &binding, nullptr) == SWIVEL_OK);
    for (const float(&q)[4] :
         {std::cref(binding.parent_from_arm), std::cref(binding.upper_from_arm), std::cref(binding.fore_from_arm),
          std::cref(binding.shoulder_rest), std::cref(binding.elbow_rest), std::cref(binding.wrist_rest)})
        CHECK(is_unit({q[0], q[1], q[2], q[3]}));
}
