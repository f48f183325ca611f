// SPDX-License-Identifier: MIT
//
// The promise: a job of swivel.hpp keeps what would end with its line, and views what has a name. Explanations are
// whole. What cannot work does not compile.
#include "tests/allocation_count.h"
#include "tests/test_arm.h"
#include "tests/test_crowd.h"

#include <array>
#include <bit>
#include <list>
#include <span>

using namespace swivel;
using namespace swivel::test;

namespace {

// Which limbs of the first 32 a job solves: those whose flags it sets again.
std::uint32_t solved_by(Crowd& crowd, const Job& job)
{
    const swivel_rows results = swivel_result_rows(crowd.get(), 0);
    const std::size_t values = std::size_t{results.block_count} * results.row_count * SWIVEL_LANES;
    std::fill_n(results.base, values, 0.0f);
    const std::uint32_t count = crowd.solve(job);
    std::vector<std::uint32_t> flags(swivel_group_limb_count(crowd.get(), 0));
    crowd.read(SWIVEL_FLAGS, 0, flags);
    std::uint32_t solved = 0;
    for (std::size_t limb = 0; limb < flags.size(); ++limb)
        if (flags[limb]) solved |= 1u << limb;
    CHECK(count == static_cast<std::uint32_t>(std::popcount(solved)));
    return solved;
}

// Overwrites the stack that an earlier line used.
[[gnu::noinline]] void scribble()
{
    std::array<volatile std::uint32_t, 4096> words;
    for (volatile std::uint32_t& word : words) word = 0xdeadbeefu;
}

std::vector<std::uint32_t> made() { return {1, 2}; }
const std::vector<std::uint32_t> made_const() { return {1, 2}; }

// Words that have no name end where this does.
Job job_of_a_function()
{
    Job job{.mask = {0x14u}};
    return job;
}

struct Words {
    std::vector<std::uint32_t> words;
    operator std::span<const std::uint32_t>() const { return words; }
};

template <class Range>
concept Maskable = requires(Range&& range)
{
    Job{.mask = std::forward<Range>(range)};
};
static_assert(Maskable<std::vector<std::uint32_t>&> && Maskable<std::span<std::uint32_t>> && Maskable<Words&>);
static_assert(!Maskable<std::vector<int>> && !Maskable<std::vector<std::uint64_t>> && !Maskable<std::vector<bool>>);
static_assert(!Maskable<std::list<std::uint32_t>> && !Maskable<const std::uint32_t*> && !Maskable<std::uint32_t>);

struct Leg {
    Float3 target;
    std::array<float, 16> world;
};
struct Person {
    Float3 grip;
    Leg legs[2];
};
template <class Frames>
concept TakesFrames = requires(Frames&& frames)
{
    Job{.frames = std::forward<Frames>(frames)};
};
static_assert(TakesFrames<Frame&> && TakesFrames<std::vector<Frame>&>);
static_assert(!TakesFrames<Frame> && !TakesFrames<std::vector<Frame>>);  // a job would view what ends with its line
template <class Range>
concept Streamable = requires(Range&& range)
{
    stream(std::forward<Range>(range), &Person::grip);
};
static_assert(Streamable<std::vector<Person>&> && !Streamable<std::vector<Person>>);  // a frame views it
static_assert(!std::is_constructible_v<Crowd, swivel_features, std::initializer_list<const swivel_group_def*>>);

}  // namespace

TEST_CASE("C++: a job with a name keeps values in braces")
{
    Crowd crowd = crowd_with(0, {group_of(20)});
    crowd.write_all(SWIVEL_TARGET, 0, std::array{0.3f, 0.2f, 1.0f});
    Job mask{.mask = {0xfu}}, limbs{.limbs = {3u, 4u, 19u}};
    scribble();
    CHECK(solved_by(crowd, mask) == 0xfu);
    CHECK(solved_by(crowd, limbs) == 0x80018u);

    Job copy = mask, changed;
    mask = limbs;
    scribble();
    CHECK(solved_by(crowd, copy) == 0xfu);
    CHECK(solved_by(crowd, mask) == 0x80018u);
    changed.mask = {0x30u};
    scribble();
    CHECK(solved_by(crowd, changed) == 0x30u);
    changed.mask = everything;
    CHECK(solved_by(crowd, changed) == 0xfffffu);
    CHECK(solved_by(crowd, job_of_a_function()) == 0x14u);
    CHECK(solved_by(crowd, {.mask = {0xfu}}) == 0xfu);
    CHECK(solved_by(crowd, std::move(copy)) == 0xfu);
    CHECK(solved_by(crowd, {.limbs = std::vector<std::uint32_t>()}) == 0);
}

TEST_CASE("C++: a job with a name keeps ranges without a name, and frames in braces")
{
    Crowd crowd = crowd_with(0, {group_of(20)});
    crowd.write_all(SWIVEL_TARGET, 0, std::array{0.3f, 0.2f, 1.0f});
    Job limbs{.limbs = made()}, constant{.limbs = made_const()}, array{.mask = std::array{0x70u}},
        words{.mask = Words{{0x21u}}};
    scribble();
    CHECK(solved_by(crowd, limbs) == 0x6u);
    CHECK(solved_by(crowd, constant) == 0x6u);
    CHECK(solved_by(crowd, array) == 0x70u);
    CHECK(solved_by(crowd, words) == 0x21u);

    const Float3 target{0.2f, 0.3f, 0.4f};
    const Frame frame = Frame().in(SWIVEL_TARGET, {target.data(), 0});
    Job framed{.frames = {frame}};
    scribble();
    CHECK(solved_by(crowd, framed) == 0xfffffu);
    std::vector<Float3> read(20);
    crowd.read(SWIVEL_TARGET, 0, read);
    CHECK(read[19] == target);
}

TEST_CASE("C++: a job views ranges with a name, and spans, without an allocation")
{
    Crowd crowd = crowd_with(0, {group_of(20)});
    crowd.write_all(SWIVEL_TARGET, 0, std::array{0.3f, 0.2f, 1.0f});
    std::vector<std::uint32_t> mask{0xfu};
    const Words words{{0x21u}};
    const std::size_t before = allocation_count();
    const Job named{.mask = mask}, span{.mask = std::span(mask)}, pointer{.mask = {mask.data(), 1}}, own{.mask = words};
    CHECK(allocation_count() == before);
    mask[0] = 0x300u;
    for (const Job* job : {&named, &span, &pointer}) CHECK(solved_by(crowd, *job) == 0x300u);
    CHECK(solved_by(crowd, own) == 0x21u);
}

TEST_CASE("C++: a stream reaches members of members and elements of arrays")
{
    std::vector<Person> people(3);
    const swivel_out left = stream(people, &Person::legs, 1, &Leg::target);
    CHECK((left.data == &people[0].legs[1].target && left.stride == sizeof(Person)));
    CHECK(swivel_in(stream(people, &Person::grip, 2)).data == &people[0].grip[2]);
}

TEST_CASE("C++: a matrix is no rotation, and other arrays of floats are no other field's")
{
    std::vector<Person> people(3);
    std::vector<std::array<float, 16>> matrices(3);
    std::vector<std::array<float, 12>> boxes(3);
    Crowd crowd(group(3, SWIVEL_WORLD | SWIVEL_WITH_SHOULDER_BOX));
    Frame frame;
    const auto no_value = Catch::Contains("floats is no value of");
    CHECK_THROWS_WITH(frame.in(SWIVEL_PARENT_ROTATION, stream(people, &Person::legs, 0, &Leg::world)), no_value);
    CHECK_THROWS_WITH(crowd.write(SWIVEL_PARENT_ROTATION, 0, matrices), no_value);
    CHECK_THROWS_WITH(crowd.write_all(SWIVEL_PARENT_ROTATION, 0, matrices[0]), no_value);
    CHECK_THROWS_WITH(crowd.read(SWIVEL_SHOULDER, 0, matrices), no_value);
    CHECK_NOTHROW(crowd.write(SWIVEL_SHOULDER_BOX, 0, boxes));
}

TEST_CASE("C++: one frame and one group need no braces, an empty list is nothing")
{
    Crowd crowd(group(20)), two({group(20), group(3)});
    std::vector<Frame> frames(2);
    CHECK(crowd.solve({.frames = frames[0]}) == 20);
    CHECK(two.solve({.frames = frames}) == 23);
    CHECK(two.solve({.groups = {1}}) == 3);
    CHECK(two.solve({.groups = {}}) == 0);
    CHECK(two.solve({.limbs = {}}) == 0);
    CHECK(two.solve({.groups = everything}) == 23);
    CHECK_THROWS_WITH(two.solve({.mask = {}}), Catch::Contains("a mask of 0 words"));
    CHECK_THROWS_WITH(two.solve({.frames = frames[0]}), Catch::Contains("1 frames for 2 groups"));
}

TEST_CASE("C++: an explanation is whole, however long")
{
    constexpr swivel_features kLimits = SWIVEL_WITH_SHOULDER_CONE | SWIVEL_WITH_HUMERAL_TWIST |
                                        SWIVEL_WITH_SHOULDER_BOX | SWIVEL_WITH_HAND_CONE | SWIVEL_WITH_FOREARM_TWIST |
                                        SWIVEL_WITH_HAND_TWIST | SWIVEL_WITH_WRIST_BOX | SWIVEL_WITH_FLEXION_LIMIT;
    Crowd crowd =
        crowd_with(kEverything | kLimits | SWIVEL_WITH_INCOMING | SWIVEL_WITH_WEIGHTS | SWIVEL_WITH_REACH |
                       SWIVEL_WITH_MOST_SWIVEL | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_ANGLE | SWIVEL_WITH_CLAVICLE,
                   {group_of(2)});
    for (swivel_field field : every_field()) {
        const std::uint32_t rows = swivel_field_row_count(crowd.get(), 0, field);
        if (field >= SWIVEL_INPUT_END || rows == 0) continue;
        const std::vector<float> bad(rows, kNan);
        REQUIRE(swivel_write(crowd.get(), field, 0, 0, 2, {bad.data(), 0}) == SWIVEL_OK);
    }
    crowd.solve();
    std::vector<char> room(1 << 20, '?');
    REQUIRE(swivel_explain(crowd.get(), 0, 0, room.data(), room.size()) == SWIVEL_OK);
    CHECK(crowd.explain(0, 0) == room.data());
    CHECK(crowd.explain(0, 0).size() > 1023);
}
