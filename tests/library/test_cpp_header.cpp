// SPDX-License-Identifier: MIT
//
// The promise: swivel.hpp takes what is a field's value and nothing else, and throws the line of what is refused. Its
// jobs view groups and masks, and copy the views of streams that have a name. What cannot work does not compile.
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
static_assert(Maskable<const std::array<std::uint32_t, 2>&>);
static_assert(!Maskable<std::vector<int>> && !Maskable<std::vector<std::uint64_t>> && !Maskable<std::vector<bool>>);
static_assert(!Maskable<std::list<std::uint32_t>> && !Maskable<const std::uint32_t*> && !Maskable<std::uint32_t>);

// ---- what is a field's value

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
static_assert(!FieldValue<Eigen::Vector3d> && !FieldValue<std::vector<float>>);
static_assert(DoubleValue<Doubles> && DoubleValue<std::array<double, 3>> && !DoubleValue<Floats> &&
              !DoubleValue<Float3> && !DoubleValue<float>);
// Classes with constructors are taken at their word.
static_assert(FieldValue<Made> && DoubleValue<Made>);

struct Leg {
    Float3 target;
    std::array<float, 16> world;
};
struct Person {
    Doubles place;
    Float3 grip;
    Float4 pose;
    Leg legs[2];
};
static_assert(std::is_convertible_v<decltype(stream(std::declval<std::vector<Person>&>(), &Person::pose)), swivel_out>);
static_assert(
    !std::is_convertible_v<decltype(stream(std::declval<const std::vector<Person>&>(), &Person::pose)), swivel_out>);
template <class Frame, class Values>
concept TakesIn = requires(Frame&& frame, Values values)
{
    std::forward<Frame>(frame).in(SWIVEL_TARGET, values);
};
template <class Frame, class Values>
concept TakesOut = requires(Frame&& frame, Values values)
{
    std::forward<Frame>(frame).out(SWIVEL_SHOULDER, values);
};
static_assert(TakesIn<Streams&, swivel_in> && TakesIn<Streams&, Stream<const Floats>>);
static_assert(TakesIn<Streams&, Stream<Doubles>> && !TakesIn<Streams&, Stream<int>>);
static_assert(TakesOut<Streams&, swivel_out> && TakesOut<Streams&, Stream<Floats>>);
static_assert(!TakesOut<Streams&, Stream<Doubles>> && !TakesOut<Streams&, Stream<const Floats>>);

template <class Frame>
concept TakesStreams = requires(Frame&& frame)
{
    Job{.streams = {std::forward<Frame>(frame), std::forward<Frame>(frame)}};
};
static_assert(TakesStreams<Streams&> && TakesStreams<const Streams&> && TakesStreams<const swivel_streams&>);
// A job would view what ends with its line. So a temporary becomes no streams, and takes no fields.
static_assert(!TakesStreams<Streams>);
static_assert(!TakesIn<Streams, swivel_in> && !TakesIn<Streams, Stream<Floats>>);
static_assert(!TakesOut<Streams, swivel_out> && !TakesOut<Streams, Stream<Floats>>);
static_assert(std::is_void_v<decltype(std::declval<Streams&>().origin(swivel_in{}))>);
template <class Range>
concept Streamable = requires(Range&& range)
{
    stream(std::forward<Range>(range), &Person::grip);
};
static_assert(Streamable<std::vector<Person>&> && !Streamable<std::vector<Person>>);  // a frame views it
// A crowd is made of definitions, one or several, of free limbs or below a skeleton.
static_assert(std::is_constructible_v<Crowd, const swivel_limb_def&> && std::is_constructible_v<Crowd, Definition>);
static_assert(std::is_constructible_v<Crowd, const std::vector<Definition>&> &&
              std::is_constructible_v<Crowd, std::initializer_list<Definition>>);
static_assert(!std::is_constructible_v<Crowd, std::uint32_t> &&
              !std::is_constructible_v<Crowd, swivel_features, std::initializer_list<Definition>>);

}  // namespace

TEST_CASE("C++: a job solves what its mask chooses, also as another job's copy, until it has none")
{
    Crowd crowd = crowd_with(0, {group_of(20)});
    crowd.write_all(SWIVEL_TARGET, 0, std::array{0.3f, 0.2f, 1.0f});
    const std::array first{0xfu}, second{0x80018u}, third{0x30u};
    Job few{.mask = first}, others{.mask = second};
    CHECK(solved_by(crowd, few) == 0xfu);
    CHECK(solved_by(crowd, others) == 0x80018u);
    Job copy = few, changed;
    few = others;
    CHECK(solved_by(crowd, copy) == 0xfu);
    CHECK(solved_by(crowd, few) == 0x80018u);
    changed.mask = third;
    CHECK(solved_by(crowd, changed) == 0x30u);
    changed.mask.reset();
    CHECK(solved_by(crowd, changed) == 0xfffffu);
    CHECK(solved_by(crowd, {.mask = std::array{0xfu}}) == 0xfu);
    CHECK(solved_by(crowd, std::move(copy)) == 0xfu);
}

TEST_CASE("C++: a job with a name keeps the views of its streams, which see what is written later")
{
    Crowd crowd = crowd_with(0, {group_of(20)});
    Float3 target{0.2f, 0.3f, 0.4f};
    Streams frame;
    frame.in(SWIVEL_TARGET, {target.data(), 0});
    const Job framed{.streams = {frame}}, copy = framed;
    for (const Job* const job : {&framed, &copy}) {
        target[0] += 0.1f;
        CHECK(solved_by(crowd, *job) == 0xfffffu);
        std::vector<Float3> read(20);
        crowd.read(SWIVEL_TARGET, 0, read);
        CHECK(read[19] == target);
    }
}

TEST_CASE("C++: a job views groups and masks, without an allocation")
{
    Crowd crowd = crowd_with(0, {group_of(20)});
    crowd.write_all(SWIVEL_TARGET, 0, std::array{0.3f, 0.2f, 1.0f});
    std::vector<std::uint32_t> mask{0xfu};
    const Words words{{0x21u}};
    const std::size_t before = allocation_count();
    const Job named{.mask = mask}, span{.mask = std::span(mask)}, own{.mask = words};
    CHECK(allocation_count() == before);
    mask[0] = 0x300u;
    for (const Job* job : {&named, &span}) CHECK(solved_by(crowd, *job) == 0x300u);
    CHECK(solved_by(crowd, own) == 0x21u);
}

TEST_CASE("C++: a matrix is no rotation, and other arrays of floats are no other field's")
{
    std::vector<Person> people(3);
    std::vector<std::array<float, 16>> matrices(3);
    std::vector<std::array<float, 12>> boxes(3);
    Crowd crowd(limbs(3, SWIVEL_WORLD | SWIVEL_WITH_SHOULDER_BOX));
    Streams frame;
    const auto world_of_leg = [](const Person& person) -> auto& { return person.legs[0].world; };
    const std::string no_value = "an array of 16 floats is no value of parent_rotation";
    CHECK_THROWS_WITH(frame.in(SWIVEL_PARENT_ROTATION, stream(people, world_of_leg)), no_value);
    CHECK_THROWS_WITH(crowd.write(SWIVEL_PARENT_ROTATION, 0, matrices), no_value);
    CHECK_THROWS_WITH(crowd.write_all(SWIVEL_PARENT_ROTATION, 0, matrices[0]), no_value);
    CHECK_THROWS_WITH(crowd.read(SWIVEL_SHOULDER, 0, matrices), "an array of 16 floats is no value of shoulder");
    CHECK_NOTHROW(crowd.write(SWIVEL_SHOULDER_BOX, 0, boxes));
    CHECK_THROWS_WITH(describe(SWIVEL_INPUT_END), Catch::Contains("there is no field "));
}

TEST_CASE("C++: flags are no floats")
{
    std::vector<float> floats(3);
    std::vector<Made> classes(3, Made(1));  // which are taken at their word
    const auto are_bits = Catch::Contains("flags are bits");
    const Crowd crowd(limbs(3));
    Streams frame;
    CHECK_THROWS_WITH(crowd.read(SWIVEL_FLAGS, 0, floats), are_bits);
    CHECK_THROWS_WITH(frame.out(SWIVEL_FLAGS, stream(floats)), are_bits);
    CHECK_NOTHROW(crowd.read(SWIVEL_FLAGS, 0, classes));
}

TEST_CASE("C++: numbers in braces are one value for all limbs")
{
    Crowd crowd(limbs(3, SWIVEL_WITH_ANGLE));
    crowd.write_all(SWIVEL_POLE, 0, {0, -2, 0.5f});
    const float angle[2] = {0, 1};
    crowd.write_all(SWIVEL_ANGLE, 0, angle);
    CHECK(read<Float3>(crowd, SWIVEL_POLE) == std::vector<Float3>(3, Float3{0, -2, 0.5f}));
    CHECK(read<Float2>(crowd, SWIVEL_ANGLE)[2] == Float2{0, 1});
    CHECK_THROWS_AS(crowd.write_all(SWIVEL_POLE, 0, {0, 1}), Error);
}

TEST_CASE("C++: an empty list of groups names none, an empty mask has too few words, without streams rows are solved")
{
    Crowd crowd(limbs(20)), two({limbs(20), limbs(3)});
    const Streams first, second;
    CHECK(crowd.solve({.streams = {first}}) == 20);
    CHECK(two.solve({.streams = {first, second}}) == 23);
    CHECK(two.solve({.groups = std::array{1u}}) == 3);
    CHECK(two.solve({.groups = std::vector<std::uint32_t>()}) == 0);
    CHECK(two.solve({.groups = {}, .mask = {}, .streams = {}}) == 23);
    CHECK_THROWS_WITH(two.solve({.mask = std::vector<std::uint32_t>()}), Catch::Contains("a mask of 0 words"));
    CHECK_THROWS_WITH(two.solve({.streams = {first}}), Catch::Contains("1 streams for 2 groups"));
}

TEST_CASE("C++: a stream is the first one's member, or a part of it, and the way to the next")
{
    std::vector<Person> characters(20);
    const swivel_in grip = stream(characters, &Person::grip), far = stream(characters, &Person::place);
    const swivel_out pose = stream(characters, &Person::pose);
    CHECK((grip.data == &characters[0].grip && grip.stride == sizeof(Person)));
    CHECK((far.data == &characters[0].place && far.stride == sizeof(Person)));
    CHECK((pose.data == &characters[0].pose && pose.stride == sizeof(Person)));
    Streams doubles;
    doubles.in(SWIVEL_TARGET, stream(characters, &Person::place));
    CHECK(swivel_streams(doubles).positions == SWIVEL_DOUBLES);
    CHECK_THROWS_WITH(doubles.in(SWIVEL_POLE, stream(characters, &Person::grip)),
                      Catch::Contains("floats and in doubles"));
    CHECK_THROWS_WITH(doubles.in(SWIVEL_HAND, stream(characters, &Person::place)),
                      "hand is no position; give it floats");
    Streams made;
    const std::vector<Made> classes(20, Made(1));  // taken for floats, which need no origin
    made.in(SWIVEL_PARENT_SCALE, stream(classes));
    const swivel_streams view = made;
    CHECK((view.fields[0].data == classes.data() && view.positions == SWIVEL_NUMBERS_UNSPECIFIED));
    made.in(SWIVEL_TARGET, stream(characters, &Person::grip));
    CHECK(view.field_count == 1);  // a view lists what had been added before
    const swivel_streams later = made;
    CHECK((later.field_count == 2 && later.fields[1].data == &characters[0].grip));
    CHECK(later.positions == SWIVEL_FLOATS);
    const auto second_target = [](auto& person) -> auto& { return person.legs[1].target; };
    const swivel_out left = stream(characters, second_target);
    CHECK((left.data == &characters[0].legs[1].target && left.stride == sizeof(Person)));
    const std::vector<Person>& seen = characters;
    const auto component = [](const Person& person) -> auto& { return person.pose[2]; };
    CHECK(swivel_in(stream(seen, component)).data == &characters[0].pose[2]);
    characters.clear();
    CHECK(swivel_in(stream(characters, &Person::grip)).data == nullptr);
    CHECK(degrees(180) == Approx(3.14159265358979));
}

TEST_CASE("C++: ranges have a value for each limb, or say from which limb on; frames one for each group")
{
    Crowd crowd = crowd_with(0, {group_of(20), group_of(5)});
    const std::vector<Float3> targets(20);
    CHECK_NOTHROW(crowd.write(SWIVEL_TARGET, 0, targets));
    CHECK_THROWS_AS(crowd.write(SWIVEL_TARGET, 1, targets), Error);
    CHECK_THROWS_WITH(crowd.write(SWIVEL_TARGET, 0, std::span(targets).first(19)),
                      "19 values for 20 limbs; give one for each, or pass the number of the first limb, too");
    CHECK_NOTHROW(crowd.write(SWIVEL_TARGET, 0, std::span(targets).first(19), 0));
    CHECK_NOTHROW(crowd.write(SWIVEL_TARGET, 0, std::span(targets).first(19), 1));
    CHECK_THROWS_AS(crowd.write(SWIVEL_TARGET, 0, std::span(targets).first(19), 2), Error);
    CHECK_NOTHROW(crowd.write(SWIVEL_TARGET, 0, std::vector<Float3>(), 20));
    CHECK_THROWS_AS(crowd.write_all(SWIVEL_POLE, 7, Float3{0, 1, 0}), Error);
    CHECK_THROWS_AS(crowd.write_all(SWIVEL_POLE, 0, 1.0f), Error);
    std::vector<double> residuals(6);
    CHECK_THROWS_AS(crowd.residuals(1, residuals), Error);
    const auto frames = [](std::size_t count) { return Job{.streams = std::vector(count, swivel_default_streams())}; };
    CHECK_NOTHROW(crowd.solve(frames(2)));
    for (const std::size_t count : {std::size_t{1}, std::size_t{3}})
        CHECK_THROWS_WITH(crowd.solve(frames(count)),
                          std::to_string(count) + " streams for 2 groups; give one for each");
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
