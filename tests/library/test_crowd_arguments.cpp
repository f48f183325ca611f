// SPDX-License-Identifier: MIT
//
// The promise: errors have their texts and belong to their thread, definitions of older headers are read as far as they
// go, swivel_find() finds every limb with a flag, and the C++ wrapper takes what is a field's value and nothing else.
#include "tests/test_arm.h"
#include "tests/test_crowd.h"
#include "tests/test_random.h"

#include <array>
#include <limits>
#include <span>
#include <string>
#include <thread>

using namespace swivel;
using namespace swivel::test;

TEST_CASE("statuses and errors have their texts, errors belong to their thread")
{
    for (const int status : {0, 1, 2, 3, 4, 77}) {
        const std::string text = swivel_status_text(static_cast<swivel_status>(status));
        CHECK(is_one_line(text));
        CHECK((text == "unknown status") == (status == 77));
    }
    CHECK(swivel_version() == SWIVEL_VERSION);
    swivel_solve(nullptr, nullptr);
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

TEST_CASE("a binding of an older header gets what it has room for")
{
    swivel_chain chain = swivel_default_chain();
    chain.elbow_offset[2] = chain.wrist_offset[2] = chain.bend[1] = 1;
    swivel_binding whole = swivel_default_binding(), part = whole;
    part.size = offsetof(swivel_binding, lengths);
    REQUIRE(swivel_bind(&chain, &whole) == SWIVEL_OK);
    REQUIRE(swivel_bind(&chain, &part) == SWIVEL_OK);
    CHECK(std::ranges::equal(part.wrist_rest, whole.wrist_rest));
    CHECK(part.lengths[0] == 0);
    CHECK(whole.lengths[0] == 1);
}

namespace {

template <class Values>
concept Writable = requires(Crowd& crowd, Values& values)
{
    crowd.write(SWIVEL_TARGET, 0, values);
    crowd.read(SWIVEL_TARGET, 0, values);
};
template <class Value>
concept WritableAll = requires(Crowd& crowd, const Value& value)
{
    crowd.write_all(SWIVEL_TARGET, 0, value);
};

template <class Values>
concept Answerable = requires(const Crowd& crowd, Values& values)
{
    crowd.elbows(0, values);
    crowd.wrists(0, values);
    crowd.hands(0, values);
    crowd.residuals(0, values);
    crowd.joint_angles(0, SWIVEL_XYZ, SWIVEL_XYZ, 0, values);
};

struct Goal {
    float target[3];
    int other;
};
struct Owner {
    std::string name;
    float target[3];
};

static_assert(Writable<std::vector<float>> && Writable<std::vector<std::uint32_t>> && Writable<std::vector<Float3>>);
static_assert(Writable<std::vector<Goal>> && Writable<std::span<Goal>> && Writable<float[3]> && Writable<float[3][4]>);
static_assert(!Writable<std::vector<double>> && !Writable<std::vector<int>> && !Writable<double[3]>);
static_assert(!Writable<std::vector<std::array<double, 3>>> && !Writable<double[3][4]> &&
              !Writable<std::vector<Owner>>);
static_assert(WritableAll<Float3> && WritableAll<float> && WritableAll<Goal> && WritableAll<float[3]>);
static_assert(Answerable<std::vector<double>> && Answerable<std::vector<std::array<double, 3>>> &&
              Answerable<double[2][7]>);
static_assert(!Answerable<std::vector<float>> && !Answerable<std::vector<std::array<float, 6>>> &&
              !Answerable<float[2][14]>);
static_assert(!WritableAll<double> && !WritableAll<std::array<double, 3>> && !WritableAll<int> && !WritableAll<Owner>);

}  // namespace

TEST_CASE("write_all checks the group and the value's size")
{
    const swivel_group_def group = group_of(3);
    Crowd crowd = crowd_with(0, {&group, 1});
    CHECK_THROWS_AS(crowd.write_all(SWIVEL_POLE, 7, Float3{0, 1, 0}), Error);
    CHECK_THROWS_AS(crowd.write_all(SWIVEL_POLE, 0, 1.0f), Error);
    CHECK(swivel_group_limb_count(crowd.get(), 7) == 0);
}

TEST_CASE("a definition of an older header is read as far as it goes")
{
    // As a first release's header might have had them: without a group's binding, and without memory.
    constexpr std::size_t step = offsetof(swivel_group_def, binding), length = offsetof(swivel_crowd_def, memory);
    alignas(swivel_group_def) std::array<unsigned char, 2 * step> groups;
    for (const std::uint32_t n : {0u, 1u}) {
        swivel_group_def group = swivel_default_group_def(3 + n);
        group.size = step;
        std::memcpy(groups.data() + n * step, &group, step);
    }
    swivel_crowd_def def = swivel_default_crowd_def();
    def.group_count = 2;
    def.groups = reinterpret_cast<const swivel_group_def*>(groups.data());
    def.memory = groups.data();  // never read
    def.size = length;
    swivel_crowd* crowd = nullptr;
    REQUIRE(swivel_crowd_create(&def, &crowd) == SWIVEL_OK);
    CHECK(swivel_group_limb_count(crowd, 0) == 3);
    CHECK(swivel_group_limb_count(crowd, 1) == 4);
    swivel_crowd_destroy(crowd);
}

TEST_CASE("a crowd that is null has nothing")
{
    CHECK(swivel_block_count(nullptr) == 0);
    CHECK(swivel_group_first_limb(nullptr, 0) == 0);
    CHECK(swivel_group_limb_count(nullptr, 0) == 0);
    CHECK(swivel_field_first_row(nullptr, 0, SWIVEL_POLE) == 0);
    CHECK(swivel_field_row_count(nullptr, 0, SWIVEL_POLE) == 0);
    CHECK((!swivel_input_rows(nullptr, 0).base && swivel_input_rows(nullptr, 0).row_count == 0));
    CHECK((!swivel_result_rows(nullptr, 0).base && swivel_result_rows(nullptr, 0).row_count == 0));
}

TEST_CASE("find gives the limbs with a flag one after the other, and no other")
{
    const std::uint32_t counts[] = {5, 16, 40};
    std::vector<swivel_group_def> groups;
    for (const std::uint32_t count : counts) groups.push_back(group_of(count));
    {
        Crowd crowd(groups);
        for (std::uint32_t g = 0; g < groups.size(); ++g) crowd.write_all(SWIVEL_LENGTHS, g, Float2{1, 1});
        CHECK(!crowd.find(~0u));  // never solved
        Random random{3};
        for (std::uint32_t g = 0; g < groups.size(); ++g) {
            std::vector<Float3> targets(counts[g]);
            for (Float3& target : targets) target = {0, random.below(3) ? 0.5f : 9.0f, random.below(8) ? 0.1f : kNan};
            crowd.write(SWIVEL_TARGET, g, targets);
        }
        crowd.solve();
        for (const std::uint32_t flags : {std::uint32_t{SWIVEL_CLAMPED_FAR}, std::uint32_t{SWIVEL_BAD_INPUT},
                                          std::uint32_t{SWIVEL_CLAMPED_FAR | SWIVEL_BAD_INPUT}, 1u << 29}) {
            std::vector<std::pair<std::uint32_t, std::uint32_t>> found, expected;
            std::uint32_t group = 0, limb = 0;
            for (; swivel_find(crowd.get(), flags, &group, &limb); ++limb) found.emplace_back(group, limb);
            for (std::uint32_t g = 0; g < groups.size(); ++g) {
                const auto words = read<std::uint32_t>(crowd, SWIVEL_FLAGS, g);
                for (std::uint32_t n = 0; n < words.size(); ++n)
                    if (words[n] & flags) expected.emplace_back(g, n);
            }
            CHECK(found == expected);
            CHECK(found.empty() == (flags == 1u << 29));
        }
    }
}

TEST_CASE("find changes nothing where there is nothing to find")
{
    Crowd crowd = crowd_of(0, 20);
    crowd.solve();
    std::uint32_t group = 0, limb = 0;
    CHECK(swivel_find(nullptr, ~0u, &group, &limb) == 0);
    CHECK(swivel_find(crowd.get(), ~0u, nullptr, &limb) == 0);
    CHECK(swivel_find(crowd.get(), ~0u, &group, nullptr) == 0);
    for (const auto& [g, n] : {std::pair{0u, 20u}, {0u, ~0u}, {1u, 0u}, {~0u, 3u}}) {
        group = g, limb = n;
        CHECK(swivel_find(crowd.get(), ~0u, &group, &limb) == 0);
        CHECK((group == g && limb == n));
    }
}

// ---- C++

namespace {

struct Floats {
    float x, y, z;
};
struct Doubles {
    double x, y, z;
};
struct IntFirst {
    int a;
    float b;
};
struct Made {
    explicit Made(float) {}
    float x = 0;
};
static_assert(FieldValue<Floats> && FieldValue<const float> && !FieldValue<Doubles> && !FieldValue<IntFirst>);
static_assert(FieldValue<Made>);  // classes are taken at their word
static_assert(!FieldValue<Eigen::Vector3d> && !FieldValue<std::vector<float>>);
static_assert(DoubleValue<Doubles> && DoubleValue<std::array<double, 3>> && !DoubleValue<Floats> &&
              !DoubleValue<float>);

struct Person {
    Doubles place;
    Floats grip;
    Float4 pose;
};
static_assert(std::is_convertible_v<decltype(stream(std::declval<std::vector<Person>&>(), &Person::pose)), swivel_out>);
static_assert(
    !std::is_convertible_v<decltype(stream(std::declval<const std::vector<Person>&>(), &Person::pose)), swivel_out>);
template <class Value>
concept FramesIn = requires(Frame frame, Stream<Value> values)
{
    frame.in(SWIVEL_TARGET, values);
};
template <class Value>
concept FramesOut = requires(Frame frame, Stream<Value> values)
{
    frame.out(SWIVEL_SHOULDER, values);
};
static_assert(FramesIn<const Floats> && FramesIn<Doubles> && !FramesIn<int>);
static_assert(FramesOut<Floats> && !FramesOut<Doubles> && !FramesOut<const Floats>);

}  // namespace

TEST_CASE("C++: a stream is the first one's member and the way to the next")
{
    std::vector<Person> characters(20);
    const swivel_in grip = stream(characters, &Person::grip), far = stream(characters, &Person::place);
    const swivel_out pose = stream(characters, &Person::pose);
    CHECK((grip.data == &characters[0].grip && grip.stride == sizeof(Person)));
    CHECK((far.data == &characters[0].place && far.stride == sizeof(Person)));
    CHECK((pose.data == &characters[0].pose && pose.stride == sizeof(Person)));
    Frame doubles;
    doubles.in(SWIVEL_TARGET, stream(characters, &Person::place));
    CHECK(swivel_frame(doubles).positions == SWIVEL_DOUBLES);
    CHECK_THROWS_WITH(doubles.in(SWIVEL_POLE, stream(characters, &Person::grip)),
                      Catch::Contains("floats and in doubles"));
    CHECK_THROWS_WITH(doubles.in(SWIVEL_HAND, stream(characters, &Person::place)), Catch::Contains("is no position"));
    Frame made;
    const std::vector<Made> classes(20, Made(1));  // taken for floats, which need no origin
    made.in(SWIVEL_PARENT_SCALE, stream(classes));
    const swivel_frame view = made;
    CHECK((view.fields[0].data == classes.data() && view.fields[1].data == nullptr));
    CHECK(view.positions == SWIVEL_NUMBERS_UNSAID);
    made.in(SWIVEL_TARGET, stream(characters, &Person::grip));  // a view sees what is added later
    CHECK(view.fields[1].data == &characters[0].grip);
    CHECK(swivel_frame(made).positions == SWIVEL_FLOATS);
    characters.clear();
    CHECK(swivel_in(stream(characters, &Person::grip)).data == nullptr);
    CHECK(degrees(180) == Approx(3.14159265358979));
}

TEST_CASE("C++: ranges have a value for each limb, or say from which limb on; frames one for each group")
{
    const swivel_group_def groups[] = {group_of(20), group_of(5)};
    Crowd crowd = crowd_with(0, groups);
    const std::vector<Float3> targets(20);
    CHECK_NOTHROW(crowd.write(SWIVEL_TARGET, 0, targets));
    CHECK_THROWS_AS(crowd.write(SWIVEL_TARGET, 1, targets), Error);
    CHECK_THROWS_AS(crowd.write(SWIVEL_TARGET, 0, std::span(targets).first(19)), Error);
    CHECK_NOTHROW(crowd.write(SWIVEL_TARGET, 0, std::span(targets).first(19), 0));
    CHECK_NOTHROW(crowd.write(SWIVEL_TARGET, 0, std::span(targets).first(19), 1));
    CHECK_THROWS_AS(crowd.write(SWIVEL_TARGET, 0, std::span(targets).first(19), 2), Error);
    CHECK_NOTHROW(crowd.write(SWIVEL_TARGET, 0, std::vector<Float3>(), 20));
    std::vector<double> residuals(6);
    CHECK_THROWS_AS(crowd.residuals(1, residuals), Error);
    const std::vector<swivel_frame> frames(3, swivel_default_frame());
    CHECK_NOTHROW(crowd.solve({.frames = std::span(frames).first(2)}));
    for (const std::size_t count : {std::size_t{1}, std::size_t{3}})
        CHECK_THROWS_WITH(crowd.solve({.frames = std::span(frames).first(count)}),
                          std::to_string(count) + " frames for 2 groups; give one for each");
}
