// SPDX-License-Identifier: MIT
//
// The promise: a whole frame through the caller's arrays gives the bits of writing, solving and reading, for any stride
// and alignment. It touches no byte beside the values, reads a limb before it writes it, and allocates nothing.
#include "tests/allocation_count.h"
#include "tests/solve_jobs.h"
#include "tests/test_arm.h"
#include "tests/test_crowd.h"
#include "tests/test_random.h"

#include <rapidcheck/catch.h>
#include <sys/mman.h>
#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <thread>

using namespace swivel;
using namespace swivel::test;

namespace {

using Bytes = std::vector<unsigned char>;

// The fields of frames, inputs first: their names, and the features that bring them.
struct Member {
    swivel_field field;
    const char *name, *feature;
};
constexpr Member kMember[] = {
    {SWIVEL_TARGET, "target", ""},
    {SWIVEL_POLE, "pole", ""},
    {SWIVEL_LENGTHS, "lengths", ""},
    {SWIVEL_SHOULDER_POSITION, "shoulder_position", "SWIVEL_WORLD"},
    {SWIVEL_PARENT_ROTATION, "parent_rotation", "SWIVEL_WORLD"},
    {SWIVEL_PARENT_SCALE, "parent_scale", "SWIVEL_WORLD"},
    {SWIVEL_HAND, "hand", "SWIVEL_WITH_HAND"},
    {SWIVEL_EFFECTOR, "effector", "SWIVEL_WITH_EFFECTOR"},
    {SWIVEL_ANGLE, "angle", "SWIVEL_WITH_ANGLE"},
    {SWIVEL_INCOMING_SHOULDER, "incoming_shoulder", "SWIVEL_WITH_INCOMING"},
    {SWIVEL_INCOMING_ELBOW, "incoming_elbow", "SWIVEL_WITH_INCOMING"},
    {SWIVEL_INCOMING_WRIST, "incoming_wrist", "SWIVEL_WITH_INCOMING"},
    {SWIVEL_WEIGHTS, "weights", "SWIVEL_WITH_WEIGHTS"},
    {SWIVEL_AIM, "aim", "SWIVEL_WITH_AIM"},
    {SWIVEL_CLAVICLE, "clavicle", "SWIVEL_WITH_CLAVICLE"},
    {SWIVEL_SHOULDER, "shoulder", ""},
    {SWIVEL_ELBOW, "elbow", ""},
    {SWIVEL_WRIST, "wrist", "SWIVEL_WITH_HAND"},
    {SWIVEL_FLAGS, "flags", ""},
    {SWIVEL_STRETCH, "stretch", "SWIVEL_WITH_REACH"},
    {SWIVEL_TWIST_BONES, "twist_bones", "SWIVEL_WITH_TWIST_BONES"},
    {SWIVEL_CLAVICLE_TURN, "clavicle_turn", "SWIVEL_WITH_CLAVICLE"},
};

constexpr std::uint32_t kInputs = 15, kMembers = std::size(kMember);
swivel_field field_at(std::uint32_t n) { return kMember[n].field; }
std::size_t value_bytes(const Crowd& crowd, std::uint32_t field)
{
    return swivel_field_row_count(crowd.get(), 0, field_at(field)) * sizeof(float);
}

// The place of a component of a limb of a group, as the header's layout says.
float* place(const Crowd& crowd, std::uint32_t field, std::uint32_t group, std::uint32_t n, std::size_t component)
{
    const swivel_rows rows =
        field < kInputs ? swivel_input_rows(crowd.get(), group) : swivel_result_rows(crowd.get(), group);
    const std::size_t row = swivel_field_first_row(crowd.get(), group, field_at(field)) + component;
    return rows.base + (std::size_t{n / 16} * rows.row_count + row) * 16 + n % 16;
}

// A field's values in bytes of their own, among bytes that are nobody's. size 0: the field is left out.
struct Array {
    Bytes bytes;
    std::size_t at = 0, stride = 0, size = 0;

    const unsigned char* value(std::uint32_t n) const { return bytes.data() + at + n * stride; }
    unsigned char* value(std::uint32_t n) { return bytes.data() + at + n * stride; }
};

float ordinary(Random& random, std::uint32_t field)
{
    const bool positive = field == SWIVEL_LENGTHS || field == SWIVEL_PARENT_SCALE;
    return static_cast<float>(positive ? random.between(0.5, 1.5) : random.between(-1, 1));
}

// Ordinary arms, and in one component of thirty-two any bits: NaNs with payloads, infinities, denormals.
Array random_array(Random& random, const Crowd& crowd, std::uint32_t field, std::uint32_t limb_count)
{
    Array array;
    array.size = value_bytes(crowd, field);
    if (array.size == 0 || random.below(5) == 0) return {};
    const bool one = field < kInputs && random.below(6) == 0;
    const std::size_t gaps[] = {0, 1, 3, 4, 8, random.below(200)};
    array.stride = one ? 0 : array.size + gaps[random.below(6)];
    array.at = random.below(20);
    array.bytes.resize(array.at + array.stride * (limb_count - 1) + array.size + random.below(20));
    for (unsigned char& byte : array.bytes) byte = static_cast<unsigned char>(random.word());
    for (std::uint32_t n = 0; n < limb_count && field < kInputs; ++n)
        for (std::size_t c = 0; c < array.size; c += sizeof(float))
            if (const float x = ordinary(random, field); random.below(32) != 0)
                std::memcpy(array.value(n) + c, &x, sizeof x);
    return array;
}

using Arrays = std::array<Array, kMembers>;  // of one group

void give(Frame& frame, std::uint32_t f, void* data, std::size_t stride)
{
    if (f < kInputs)
        frame.in(field_at(f), {data, stride});
    else
        frame.out(field_at(f), {data, stride});
}

struct Frames {
    std::vector<Frame> own;
    std::vector<swivel_frame> frames;

    explicit Frames(std::vector<Arrays>& arrays) : own(arrays.size())
    {
        for (std::size_t g = 0; g < arrays.size(); ++g)
            for (std::uint32_t f = 0; f < kMembers; ++f)
                if (Array& array = arrays[g][f]; array.size != 0) give(own[g], f, array.value(0), array.stride);
        frames.assign(own.begin(), own.end());
    }
};

// copy(field, group, array) for the fields of a frame that are given.
template <class Copy>
void each_array(std::vector<Arrays>& arrays, std::uint32_t from, std::uint32_t to, Copy copy)
{
    for (std::uint32_t g = 0; g < arrays.size(); ++g)
        for (std::uint32_t f = from; f < to; ++f)
            if (arrays[g][f].size != 0) copy(f, g, arrays[g][f]);
}

void solve_by_steps(Crowd& crowd, std::vector<Arrays>& arrays)
{
    const auto count = [&](std::uint32_t g) { return swivel_group_limb_count(crowd.get(), g); };
    each_array(arrays, 0, kInputs, [&](std::uint32_t f, std::uint32_t g, Array& array) {
        check(swivel_write(crowd.get(), field_at(f), g, 0, count(g), {array.value(0), array.stride}));
    });
    crowd.solve();
    each_array(arrays, kInputs, kMembers, [&](std::uint32_t f, std::uint32_t g, Array& array) {
        check(swivel_read(crowd.get(), field_at(f), g, 0, count(g), {array.value(0), array.stride}));
    });
}

// Without the library's copies: each word to and from its documented place.
void solve_by_words(Crowd& crowd, std::vector<Arrays>& arrays)
{
    const auto each_word = [&](std::uint32_t from, std::uint32_t to, auto copy) {
        each_array(arrays, from, to, [&](std::uint32_t f, std::uint32_t g, Array& array) {
            for (std::uint32_t n = 0; n < swivel_group_limb_count(crowd.get(), g); ++n)
                for (std::size_t c = 0; c < array.size / sizeof(float); ++c)
                    copy(place(crowd, f, g, n, c), array.value(n) + c * sizeof(float));
        });
    };
    each_word(0, kInputs, [](float* row, unsigned char* value) { std::memcpy(row, value, sizeof *row); });
    crowd.solve();
    each_word(kInputs, kMembers, [](float* row, unsigned char* value) { std::memcpy(value, row, sizeof *row); });
}

// A bool, so that a failure does not print a hundred thousand words.
bool same_words(const Crowd& a, const Crowd& b) { return all_words(a) == all_words(b); }

bool same_bytes(const std::vector<Arrays>& a, const std::vector<Arrays>& b)
{
    return std::ranges::equal(a, b, [](const Arrays& x, const Arrays& y) {
        return std::ranges::equal(x, y, [](const Array& p, const Array& q) { return p.bytes == q.bytes; });
    });
}

struct Problem {
    swivel_features features = 0;
    std::vector<swivel_group_def> groups;
    std::vector<Arrays> arrays;

    Crowd crowd() const { return crowd_with(features, groups); }
};

Problem random_problem(Random& random, std::uint32_t most_limbs)
{
    Problem problem;
    do problem.features = random.below(16);
    while ((problem.features & SWIVEL_POLE_DIRECTION) && !(problem.features & SWIVEL_WORLD));
    if (random.below(3) == 0) {
        problem.features |= SWIVEL_WITH_ANGLE | SWIVEL_WITH_INCOMING | SWIVEL_WITH_WEIGHTS | SWIVEL_WITH_REACH;
        if (problem.features & SWIVEL_WITH_HAND) problem.features |= SWIVEL_WITH_EFFECTOR | 2 * SWIVEL_WITH_TWIST_BONES;
    }
    if (problem.features < 16 && random.below(4) == 0) problem.features |= SWIVEL_WITH_AIM;
    if ((problem.features & SWIVEL_WORLD) && random.below(4) == 0) problem.features |= SWIVEL_WITH_CLAVICLE;
    for (std::uint32_t g = 1 + random.below(4); g > 0; --g) {
        problem.groups.push_back(group_of(1 + random.below(most_limbs)));
        const Quaterniond q = random.rotation();
        std::ranges::copy(floats(q), problem.groups.back().binding.upper_from_arm);
        std::ranges::copy(floats(q), problem.groups.back().binding.elbow_parent_from_arm);
    }
    const Crowd crowd = problem.crowd();
    for (const swivel_group_def& group : problem.groups) {
        problem.arrays.emplace_back();
        for (std::uint32_t f = 0; f < kMembers; ++f)
            problem.arrays.back()[f] = random_array(random, crowd, f, group.limb_count);
    }
    return problem;
}

// Rows of before and results of after, for limbs of a group in a range of blocks; padding lanes of results mean
// nothing.
struct Range {
    std::uint32_t first, count;
    bool has(std::uint32_t block) const { return block >= first && block - first < count; }
};

}  // namespace

TEST_CASE("a whole frame gives the bits of writing, solving and reading, in rows and arrays, and touches nothing else")
{
    rc::prop("random groups, features, strides, alignments, missing members", [](std::uint64_t seed) {
        Random random{seed};
        const Problem problem = random_problem(random, 100);
        std::vector<Arrays> by_words = problem.arrays, by_steps = problem.arrays, whole = problem.arrays,
                            in_blocks = problem.arrays;
        Crowd words = problem.crowd(), steps = problem.crowd(), frame = problem.crowd(), blocks = problem.crowd();
        solve_by_words(words, by_words);
        solve_by_steps(steps, by_steps);
        const Frames of_whole(whole), of_blocks(in_blocks);
        frame.solve({.frames = of_whole.frames});
        blocks.solve({.blocks = swivel_blocks{0, swivel_block_count(blocks.get())},
                      .frames = of_blocks.frames,
                      .on_this_thread = true});
        RC_ASSERT(same_words(steps, words));
        RC_ASSERT(same_words(frame, words));
        RC_ASSERT(same_words(blocks, words));
        RC_ASSERT(same_bytes(by_steps, by_words));
        RC_ASSERT(same_bytes(whole, by_words));
        RC_ASSERT(same_bytes(in_blocks, by_words));
    });
}

TEST_CASE("large crowds, in chunks on threads, give the bits of one thread")
{
    Random random{7};
    Problem problem;
    do problem = random_problem(random, 9000);
    while (problem.groups.size() < 3 || problem.groups[0].limb_count < 4000);
    std::vector<Arrays> by_words = problem.arrays, whole = problem.arrays;
    Crowd words = problem.crowd(), frame = problem.crowd();
    solve_by_words(words, by_words);
    const Frames of_whole(whole);
    frame.solve({.frames = of_whole.frames});
    CHECK(same_words(frame, words));
    CHECK(same_bytes(whole, by_words));
}

TEST_CASE("a range of blocks copies and solves its limbs alone, ranges in any order make the whole")
{
    rc::prop("random ranges", [](std::uint64_t seed) {
        Random random{seed};
        const Problem problem = random_problem(random, 100);
        std::vector<Arrays> expected = problem.arrays, got = problem.arrays;
        Crowd words = problem.crowd(), crowd = problem.crowd();
        const std::vector<std::uint32_t> before = all_words(crowd);
        solve_by_words(words, expected);
        const std::vector<std::uint32_t> after = all_words(words);
        const Frames of_got(got);
        const std::vector<swivel_frame>& frames = of_got.frames;

        const std::uint32_t block_count = swivel_block_count(crowd.get()), first = random.below(block_count);
        const Range range{first, random.below(block_count - first + 1)};
        crowd.solve({.blocks = swivel_blocks{range.first, range.count}, .frames = frames, .on_this_thread = true});
        const std::vector<std::uint32_t> words_now = all_words(crowd);
        std::size_t word = 0;
        for (std::uint32_t g = 0; g < problem.groups.size(); ++g)
            for (const swivel_rows rows : {swivel_input_rows(crowd.get(), g), swivel_result_rows(crowd.get(), g)})
                for (std::uint32_t b = 0; b < rows.block_count; ++b) {
                    const bool is_solved = range.has(swivel_group_first_limb(crowd.get(), g) / SWIVEL_LANES + b);
                    for (std::uint32_t n = rows.row_count * SWIVEL_LANES; n > 0; --n, ++word)
                        RC_ASSERT(words_now[word] == (is_solved ? after : before)[word]);
                }
        for (std::uint32_t g = 0; g < got.size(); ++g)
            for (std::uint32_t f = kInputs; f < kMembers; ++f) {
                Array& array = got[g][f];
                Bytes want = problem.arrays[g][f].bytes;
                for (std::uint32_t n = 0; n < problem.groups[g].limb_count && array.size != 0; ++n)
                    if (range.has((swivel_group_first_limb(crowd.get(), g) + n) / SWIVEL_LANES))
                        std::memcpy(want.data() + array.at + n * array.stride, expected[g][f].value(n), array.size);
                const bool as_wanted = array.bytes == want;
                RC_ASSERT(as_wanted);
            }

        std::vector<std::uint32_t> order(block_count);
        for (std::uint32_t b = 0; b < block_count; ++b) std::swap(order[b] = b, order[random.below(b + 1)]);
        for (const std::uint32_t block : order)
            crowd.solve({.blocks = swivel_blocks{block, 1}, .frames = frames, .on_this_thread = true});
        RC_ASSERT(same_words(crowd, words));
        RC_ASSERT(same_bytes(got, expected));
    });
}

TEST_CASE("one value for a whole group, and null members leave the rows alone")
{
    Crowd crowd = crowd_of(SWIVEL_WORLD, 50);
    const Float3 target = {0.5f, -1, 0.25f};
    const Float4 turned = {0, 0.6f, 0, 0.8f};
    crowd.write_all(SWIVEL_PARENT_ROTATION, 0, turned);
    crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, Float3{0, 0, 0});
    crowd.solve({.frames = {Frame().in(SWIVEL_TARGET, {&target, 0})}});
    CHECK(read<Float3>(crowd, SWIVEL_TARGET) == std::vector<Float3>(50, target));
    CHECK(read<Float4>(crowd, SWIVEL_PARENT_ROTATION) == std::vector<Float4>(50, turned));
    const auto solved = all_words(crowd);
    const swivel_frame none = swivel_default_frame();
    crowd.solve({.frames = {&none, 1}});
    CHECK((all_words(crowd) == solved));
}

TEST_CASE("a pose may be read and written in place")
{
    // A transform as engines keep it, its rotation replaced by the solved one; goals lie in another array.
    struct Transform {
        Float3 position;
        float scale;
        Float4 rotation;
    };
    struct Character {
        Transform joints[5];
        Float3 target, pole;
        std::uint32_t flags;
    };
    for (const std::uint32_t count : {1u, 3u, 16u, 50u, 777u}) {
        Crowd separate = crowd_of(SWIVEL_WORLD | SWIVEL_JOINTS, count, group_of(1).binding),
              whole = crowd_of(SWIVEL_WORLD | SWIVEL_JOINTS, count, group_of(1).binding);
        Random random{count};
        std::vector<Character> pose(count);
        for (Character& character : pose) {
            for (Transform& joint : character.joints)
                joint = {floats(random.direction()), 1.5f, floats(random.rotation())};
            character.target = floats(random.direction());
            character.pole = floats(random.direction());
        }
        std::vector<Character> in_place = pose;
        const auto fields_in = [](std::vector<Character>& all) {
            const std::size_t stride = sizeof(Character);
            return std::vector<swivel_frame_field>{
                {SWIVEL_TARGET, &all[0].target, stride},
                {SWIVEL_POLE, &all[0].pole, stride},
                {SWIVEL_SHOULDER_POSITION, &all[0].joints[2].position, stride},
                {SWIVEL_PARENT_ROTATION, &all[0].joints[2].rotation, stride},
                {SWIVEL_PARENT_SCALE, &all[0].joints[2].scale, stride},
                {SWIVEL_SHOULDER, &all[0].joints[2].rotation, stride},  // where the parent's rotation was read
                {SWIVEL_ELBOW, &all[0].joints[3].rotation, stride},
                {SWIVEL_FLAGS, &all[0].target, stride},  // over a part of an input
            };
        };
        const auto there = fields_in(pose), here = fields_in(in_place);
        for (const auto& [field, data, stride] : there)
            if (field < SWIVEL_INPUT_END) check(swivel_write(separate.get(), field, 0, 0, count, {data, stride}));
        separate.solve();
        for (const auto& [field, data, stride] : there)
            if (field >= SWIVEL_SHOULDER) check(swivel_read(separate.get(), field, 0, 0, count, {data, stride}));
        swivel_frame frame = swivel_default_frame();
        frame.fields = here.data();
        frame.field_count = static_cast<std::uint32_t>(here.size());
        whole.solve({.frames = {&frame, 1}});
        CHECK(same_words(whole, separate));
        CHECK(std::memcmp(pose.data(), in_place.data(), count * sizeof(Character)) == 0);
        CHECK(read<std::uint32_t>(whole, SWIVEL_FLAGS) == read<std::uint32_t>(separate, SWIVEL_FLAGS));
    }
}

// ---- memory

namespace {

// Pages to use, each between two that must not be touched.
struct GuardedPages {
    const std::size_t size = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)), count;
    unsigned char* const all = static_cast<unsigned char*>(
        ::mmap(nullptr, (2 * count + 1) * size, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));

    explicit GuardedPages(std::size_t page_count) : count(page_count)
    {
        REQUIRE(all != MAP_FAILED);
        for (std::size_t n = 0; n < count; ++n) REQUIRE(::mprotect(page(n), size, PROT_READ | PROT_WRITE) == 0);
    }
    ~GuardedPages() { ::munmap(all, (2 * count + 1) * size); }
    GuardedPages(const GuardedPages&) = delete;
    GuardedPages& operator=(const GuardedPages&) = delete;

    unsigned char* page(std::size_t n) const { return all + (2 * n + 1) * size; }
    std::size_t stride() const { return 2 * size; }
    void fill() const
    {
        for (std::size_t n = 0; n < count; ++n) std::memset(page(n), 0x41, size);
    }
    // Whether every byte is as filled but those of `limb_count` values.
    bool is_filled_beside(const unsigned char* data, std::size_t step, std::size_t bytes, std::size_t limb_count) const
    {
        for (std::size_t n = 0; n < count; ++n)
            for (const unsigned char* byte = page(n); byte < page(n) + size; ++byte) {
                const auto at = static_cast<std::size_t>(byte - data);
                const bool in_value = byte >= data && at / step < limb_count && at % step < bytes;
                if (!in_value && *byte != 0x41) return false;
            }
        return true;
    }
};

}  // namespace

TEST_CASE("values that start or end at a page nobody may touch, the array or each of them")
{
    constexpr std::uint32_t kMostLimbs = 21;
    const GuardedPages pages(kMostLimbs);
    for (const swivel_features features : {kEverything, swivel_features{0}})  // elbows of four and of two components
        for (const std::uint32_t count : {1u, 2u, 3u, 4u, 5u, 7u, 16u, kMostLimbs}) {
            Crowd crowd = crowd_of(features, count, group_of(1).binding);
            swivel_crowd* const c = crowd.get();
            const auto try_at = [&](std::uint32_t f, unsigned char* data, std::size_t stride) {
                const std::size_t bytes = value_bytes(crowd, f);
                INFO(kMember[f].name << ", " << count << " limbs, stride " << stride);
                pages.fill();
                Frame given;
                give(given, f, data, stride);
                const swivel_frame frame = given;
                if (f < kInputs) {
                    CHECK(swivel_write(c, field_at(f), 0, 0, count, {data, stride}) == SWIVEL_OK);
                    CHECK(solve_frame(c, &frame) == SWIVEL_OK);
                    CHECK(std::memcmp(place(crowd, f, 0, count - 1, bytes / 4 - 1), "AAAA", 4) == 0);
                } else {
                    CHECK(swivel_read(c, field_at(f), 0, 0, count, {data, stride}) == SWIVEL_OK);
                    CHECK(pages.is_filled_beside(data, stride, bytes, count));
                    pages.fill();
                    CHECK(solve_frame(c, &frame) == SWIVEL_OK);
                    CHECK(pages.is_filled_beside(data, stride, bytes, count));
                }
            };
            for (std::uint32_t f = 0; f < kMembers; ++f) {
                const std::size_t bytes = value_bytes(crowd, f);
                if (bytes == 0) continue;
                for (const std::size_t stride : {bytes, bytes + 1, bytes + 4, std::size_t{100}}) {
                    try_at(f, pages.page(0), stride);
                    try_at(f, pages.page(1) - pages.size - (stride * (count - 1) + bytes), stride);
                }
                try_at(f, pages.page(0), pages.stride());
                try_at(f, pages.page(0) + pages.size - bytes, pages.stride());
            }
        }
}

TEST_CASE("a frame of blocks allocates nothing")
{
    Random random{3};
    Problem problem = random_problem(random, 1000);
    Crowd crowd = problem.crowd();
    const Frames of_problem(problem.arrays);
    const std::vector<swivel_frame>& frames = of_problem.frames;
    const std::uint32_t block_count = swivel_block_count(crowd.get());
    crowd.solve({.blocks = swivel_blocks{0, block_count},
                 .frames = frames,
                 .on_this_thread = true});  // once before counting: the instruction set is chosen
    const std::size_t before = allocation_count();
    for (int n = 0; n < 20; ++n)
        crowd.solve({.blocks = swivel_blocks{0, block_count}, .frames = frames, .on_this_thread = true});
    (void)solve_frame(crowd.get(), nullptr);
    CHECK(allocation_count() == before);
    void* volatile by_new = ::operator new(1);
    ::operator delete(by_new);
    CHECK(allocation_count() > before);  // the counter counts
}

TEST_CASE("several threads run ranges of one frame that do not overlap")
{
    Random random{5};
    Problem problem;
    do problem = random_problem(random, 2000);
    while (problem.groups.size() < 2);
    std::vector<Arrays> expected = problem.arrays;
    Crowd alone = problem.crowd(), crowd = problem.crowd();
    solve_by_words(alone, expected);
    const Frames of_problem(problem.arrays);
    const std::vector<swivel_frame>& frames = of_problem.frames;
    const std::uint32_t block_count = swivel_block_count(crowd.get());
    std::vector<std::thread> threads;
    for (std::uint32_t t = 0; t < 3; ++t)
        threads.emplace_back([&, t] {
            for (std::uint32_t b = t; b < block_count; b += 3) solve_frame_blocks(crowd.get(), frames.data(), b, 1);
        });
    for (std::thread& thread : threads) thread.join();
    CHECK(same_words(crowd, alone));
    CHECK(same_bytes(problem.arrays, expected));
}

TEST_CASE("frames of an older header are read as far as they go, as far apart as the first says")
{
    constexpr std::size_t step = offsetof(swivel_frame, origin);  // as if a first release had no origins
    const swivel_group_def groups[] = {group_of(20), group_of(5)};
    Crowd framed = crowd_with(0, groups), rows = crowd_with(0, groups);
    alignas(swivel_frame) std::array<unsigned char, 2 * step> frames;
    std::vector<Float3> targets[] = {std::vector<Float3>(20, Float3{0, 1, 1}), std::vector<Float3>(5, Float3{1, 0, 1})};
    Frame own[2];
    for (std::uint32_t g = 0; g < 2; ++g) {
        swivel_frame frame = own[g].in(SWIVEL_TARGET, {targets[g].data(), sizeof(Float3)});
        frame.size = step;
        std::memcpy(frames.data() + g * step, &frame, step);
        for (Crowd* crowd : {&framed, &rows}) crowd->write_all(SWIVEL_LENGTHS, g, Float2{1, 1});
        rows.write(SWIVEL_TARGET, g, targets[g]);
    }
    rows.solve();
    REQUIRE(solve_frame(framed.get(), reinterpret_cast<const swivel_frame*>(frames.data())) == SWIVEL_OK);
    CHECK((all_words(framed) == all_words(rows)));
}

TEST_CASE("frames of limbs that are not chosen are neither read nor written")
{
    constexpr std::uint32_t counts[] = {100, 1500};
    const swivel_group_def groups[] = {group_of(counts[0]), group_of(counts[1])};
    Random random{8};
    for (const std::uint32_t one_in : {1u, 2u, 16u, 200u}) {
        Crowd framed = crowd_with(SWIVEL_JOINTS, groups), rows = crowd_with(SWIVEL_JOINTS, groups);
        std::vector<std::uint32_t> mask((swivel_block_count(rows.get()) + 1) / 2);
        std::vector<Float3> targets[2];
        std::vector<Float4> shoulders[2];
        std::array<Frame, 2> own;
        for (std::uint32_t g = 0; g < 2; ++g) {
            rows.write_all(SWIVEL_TARGET, g, Float3{0, 0.5f, 1});  // what unchosen limbs have and keep
            framed.write_all(SWIVEL_TARGET, g, Float3{0, 0.5f, 1});
            targets[g].assign(counts[g], Float3{kNan, 7, 7});
            shoulders[g].assign(counts[g], Float4{7, 7, 7, 7});
            for (std::uint32_t n = 0; n < counts[g]; ++n) {
                if (random.below(one_in) != 0) continue;
                const std::uint32_t limb = swivel_group_first_limb(rows.get(), g) + n;
                mask[limb / 32] |= 1u << limb % 32;
                targets[g][n] = floats(Vector3d(random.between(0.2, 2.2) * random.direction()));
                rows.write(SWIVEL_TARGET, g, std::span(&targets[g][n], 1), n);
            }
            own[g].in(SWIVEL_TARGET, {targets[g].data(), sizeof(Float3)});
            own[g].out(SWIVEL_SHOULDER, {shoulders[g].data(), sizeof(Float4)});
        }
        const std::array<swivel_frame, 2> frames = {own[0], own[1]};
        rows.solve({.mask = mask});
        const std::uint32_t blocks = swivel_block_count(rows.get()), part = 1 + random.below(blocks);
        framed.solve({.blocks = swivel_blocks{0, part}, .mask = mask, .frames = frames});
        framed.solve(
            {.blocks = swivel_blocks{part, blocks - part}, .mask = mask, .frames = frames, .on_this_thread = true});
        INFO("one in " << one_in << ", cut at block " << part);
        CHECK((all_words(framed) == all_words(rows)));
        for (std::uint32_t g = 0; g < 2; ++g) {
            const std::vector<Float4> wanted = read<Float4>(rows, SWIVEL_SHOULDER, g);
            for (std::uint32_t n = 0; n < counts[g]; ++n) {
                const std::uint32_t limb = swivel_group_first_limb(rows.get(), g) + n;
                const bool chosen = mask[limb / 32] >> limb % 32 & 1;
                REQUIRE(shoulders[g][n] == (chosen ? wanted[n] : Float4{7, 7, 7, 7}));
            }
        }
    }
}

// ---- errors

TEST_CASE("wrong frames are refused, name group and field, and change nothing")
{
    const swivel_group_def groups[] = {group_of(20), group_of(5), group_of(40)};
    float values[200] = {};
    // Frames of every input that there is without a further feature, but for one field of one group.
    const auto fill = [&](swivel_features features, std::uint32_t but_group, std::uint32_t but_field) {
        std::vector<Frame> frames(3);
        for (std::uint32_t g = 0; g < 3; ++g)
            for (std::uint32_t f = 0; f < kInputs; ++f)
                if (const std::string feature = kMember[f].feature;
                    feature.empty() || (feature == "SWIVEL_WORLD" && features & SWIVEL_WORLD) ||
                    (feature == "SWIVEL_WITH_HAND" && features & SWIVEL_WITH_HAND))
                    if (g != but_group || f != but_field) frames[g].in(field_at(f), {values, 0});
        return frames;
    };
    for (const swivel_features features : {swivel_features{0}, SWIVEL_WORLD, kEverything}) {
        Crowd crowd = crowd_with(features, groups);
        crowd.solve();
        const auto before = all_words(crowd);
        for (std::uint32_t g = 0; g < 3; ++g)
            for (std::uint32_t f = 0; f < kMembers; ++f) {
                const std::size_t bytes = value_bytes(crowd, f);
                std::vector<Frame> own = fill(features, g, f);
                const std::vector<Frame> others = own;
                std::string line = "group " + std::to_string(g) + ", " + kMember[f].name + ": ";
                const std::size_t stride = bytes == 0 ? 16 : bytes - 1;
                // Of two features that are missing the lower bit is named.
                const bool missing_hand = field_at(f) == SWIVEL_INCOMING_WRIST && !(features & SWIVEL_WITH_HAND);
                give(own[g], f, values, stride);
                const std::vector<swivel_frame> frames(own.begin(), own.end());
                if (bytes != 0)
                    line += "stride " + std::to_string(stride) + " is smaller than a value, " + std::to_string(bytes) +
                            " bytes";
                else
                    line += std::string("not part of this group; create it with ") +
                            (missing_hand ? "SWIVEL_WITH_HAND" : kMember[f].feature);
                CHECK(solve_frame(crowd.get(), frames.data()) == SWIVEL_INVALID_ARGUMENT);
                CHECK(swivel_last_error() == line);
                CHECK_REFUSED(solve_frame_blocks(crowd.get(), frames.data(), 0, 6), SWIVEL_INVALID_ARGUMENT);
                CHECK(swivel_last_error() == line);
                if (f >= kInputs && bytes != 0) {
                    own = others;
                    give(own[g], f, values, 0);  // one place for all: outputs cannot
                    const std::vector<swivel_frame> one_place(own.begin(), own.end());
                    CHECK_REFUSED(solve_frame(crowd.get(), one_place.data()), SWIVEL_INVALID_ARGUMENT);
                }
            }
        CHECK((all_words(crowd) == before));
    }
    for (const float x : values) CHECK(x == 0);
}

TEST_CASE("missing frames, crowds and blocks are refused; frames outside the range are not looked at")
{
    const swivel_group_def groups[] = {group_of(20), group_of(5)};
    Crowd crowd = crowd_with(0, groups);
    swivel_crowd* const c = crowd.get();
    const auto bad = SWIVEL_INVALID_ARGUMENT;
    float value[4] = {};
    swivel_frame frames[2] = {swivel_default_frame(), swivel_default_frame()};
    CHECK_REFUSED(solve_frame(nullptr, frames), bad);
    frames[0].size = 0;
    CHECK_REFUSED(solve_frame(c, frames), bad);
    frames[0].size = sizeof frames[0] + 8;
    CHECK_REFUSED(solve_frame(c, frames), bad);
    frames[0].size = sizeof frames[0];
    frames[1].size = 0;
    CHECK_REFUSED(solve_frame(c, frames), bad);
    frames[1].size = sizeof frames[1];
    CHECK_REFUSED(solve_frame_blocks(nullptr, frames, 0, 1), bad);
    CHECK_REFUSED(solve_frame_blocks(c, frames, 0, 4), bad);
    CHECK_REFUSED(solve_frame_blocks(c, frames, 4, 0), bad);
    CHECK_REFUSED(solve_frame_blocks(c, frames, 1, ~0u), bad);
    CHECK(solve_frame_blocks(c, frames, 3, 0) == SWIVEL_OK);
    swivel_frame_field fields[] = {{SWIVEL_TARGET, value, 4}, {SWIVEL_POLE, value, 0}};
    frames[1].fields = fields;
    frames[1].field_count = 2;
    CHECK_REFUSED(solve_frame_blocks(c, frames, 1, 2), bad);
    CHECK(solve_frame_blocks(c, frames, 0, 2) == SWIVEL_OK);  // blocks of group 0 alone
    fields[0].data = nullptr;                                 // not given: its stride is ignored
    CHECK(solve_frame(c, frames) == SWIVEL_OK);
    fields[0] = fields[1];
    CHECK_REFUSED(solve_frame(c, frames), bad);
    CHECK(swivel_last_error() == std::string("frame of group 1 lists pole twice; list it once"));
    fields[0].field = SWIVEL_INPUT_END;
    CHECK_REFUSED(solve_frame(c, frames), bad);
    frames[1].fields = nullptr;
    CHECK_REFUSED(solve_frame(c, frames), bad);
    frames[1].field_count = 0;
    CHECK(solve_frame(c, frames) == SWIVEL_OK);
    CHECK_NOTHROW(crowd.solve({.frames = frames}));
    CHECK_THROWS_AS(crowd.solve({.frames = {frames, 1}}), Error);
    CHECK_THROWS_AS(crowd.solve({.blocks = swivel_blocks{0, 1}, .frames = {frames, 1}, .on_this_thread = true}), Error);
}
