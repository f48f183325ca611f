// SPDX-License-Identifier: MIT
//
// The promise: wrong arguments are refused with one line and change nothing.
#include "tests/solve_jobs.h"
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
    def.size = sizeof def + 1;
    refuse(&def);
    def.size = ~std::size_t{0};
    refuse(&def);
    for (const std::size_t size : {std::size_t{0}, sizeof groups[0] - 4, sizeof groups[0] + 8}) {
        def = good;
        groups[0].size = size;
        refuse(&def);
        groups[0].size = sizeof groups[0];
    }
    swivel_features known = SWIVEL_MOST_TWIST_BONES * SWIVEL_WITH_TWIST_BONES;
    swivel_feature_info info;
    for (std::uint32_t n = 0; swivel_describe_feature(n, &info); ++n) known |= info.feature;
    for (int bit = 0; bit < 64; ++bit) {  // those between the features and around the number of twist bones
        const swivel_features feature = UINT64_C(1) << bit;
        if (feature & known) continue;
        groups[0].features = SWIVEL_WITH_HAND | feature;
        refuse(&good);
    }
    for (const swivel_features bones : std::initializer_list<swivel_features>{8, 9, 15, 255}) {
        groups[0].features = SWIVEL_WITH_HAND | bones * SWIVEL_WITH_TWIST_BONES;
        refuse(&good);
    }
    for (const swivel_features features :
         {swivel_features{0}, SWIVEL_JOINTS, swivel_features{SWIVEL_JOINTS | SWIVEL_WITH_HAND}}) {
        groups[0].features = features | SWIVEL_POLE_DIRECTION;
        refuse(&good);
    }
    for (const swivel_features features : std::initializer_list<swivel_features>{
             SWIVEL_WORLD | SWIVEL_POLE_DIRECTION | SWIVEL_POLE_NORMAL,
             SWIVEL_WORLD | SWIVEL_POLE_DIRECTION | SWIVEL_POLE_INCOMING | SWIVEL_WITH_INCOMING,
             SWIVEL_POLE_NORMAL | SWIVEL_POLE_INCOMING | SWIVEL_WITH_INCOMING,
             SWIVEL_POLE_INCOMING,
             SWIVEL_WITH_WEIGHTS,
             SWIVEL_WITH_EFFECTOR,
             SWIVEL_WITH_HAND_CONE,
             SWIVEL_WITH_FOREARM_TWIST,
             SWIVEL_WITH_HAND_TWIST,
             SWIVEL_WITH_WRIST_BOX,
         }) {
        groups[0].features = features;
        refuse(&good);
    }
    groups[0].features = 0;
    groups[0].shoulder_order = static_cast<swivel_euler_order>(SWIVEL_ZYX + 1);
    refuse(&good);
    groups[0].shoulder_order = SWIVEL_XYZ;
    groups[0].wrist_order = static_cast<swivel_euler_order>(7);
    refuse(&good);
    groups[0].wrist_order = SWIVEL_XYZ;
    const std::uint32_t unknown = 2;
    std::memcpy(&groups[0].on_bad_input, &unknown, sizeof unknown);
    refuse(&good);
    groups[0] = group_of(3);
    def = good;
    def.group_count = 0;
    refuse(&def);
    def = good;
    def.workspace_count = 65;
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
    Crowd crowd = crowd_with(0, groups);
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
    for (const swivel_field field :
         {SWIVEL_SHOULDER, SWIVEL_ELBOW, SWIVEL_WRIST, SWIVEL_FLAGS, SWIVEL_INPUT_END, SWIVEL_SHOULDER_POSITION,
          SWIVEL_PARENT_ROTATION, SWIVEL_PARENT_SCALE, SWIVEL_HAND})
        CHECK_REFUSED(swivel_write(c, field, 0, 0, 1, {in, 0}), bad);

    CHECK_REFUSED(swivel_read(nullptr, SWIVEL_SHOULDER, 0, 0, 1, {out, 16}), bad);
    CHECK_REFUSED(swivel_read(c, SWIVEL_SHOULDER, 2, 0, 1, {out, 16}), bad);
    CHECK_REFUSED(swivel_read(c, SWIVEL_SHOULDER, 0, 20, 1, {out, 16}), bad);
    CHECK_REFUSED(swivel_read(c, SWIVEL_SHOULDER, 0, 0, 1, {nullptr, 16}), bad);
    CHECK_REFUSED(swivel_read(c, SWIVEL_SHOULDER, 0, 0, 1, {out, 15}), bad);
    CHECK_REFUSED(swivel_read(c, SWIVEL_SHOULDER, 0, 0, 1, {out, 0}), bad);
    for (const swivel_field field : {SWIVEL_WRIST, SWIVEL_HAND, SWIVEL_PARENT_SCALE, SWIVEL_INPUT_END})
        CHECK_REFUSED(swivel_read(c, field, 0, 0, 1, {out, 16}), bad);

    CHECK_REFUSED(swivel_solve(nullptr, nullptr), bad);
    CHECK_REFUSED(solve_blocks(nullptr, 0, 1), bad);
    REQUIRE(swivel_block_count(c) == 3);
    CHECK_REFUSED(solve_blocks(c, 0, 4), bad);
    CHECK_REFUSED(solve_blocks(c, 3, 1), bad);
    CHECK_REFUSED(solve_blocks(c, 4, 0), bad);
    CHECK_REFUSED(solve_blocks(c, 1, ~0u), bad);
    CHECK(solve_blocks(c, 3, 0) == SWIVEL_OK);
    CHECK(swivel_write(c, SWIVEL_TARGET, 0, 20, 0, {nullptr, 12}) == SWIVEL_OK);  // no limbs need no data
    CHECK(swivel_read(c, SWIVEL_SHOULDER, 0, 0, 0, {nullptr, 16}) == SWIVEL_OK);
    const Crowd boxes({group(1, SWIVEL_WITH_SHOULDER_BOX)});
    CHECK(swivel_write(boxes.get(), SWIVEL_SHOULDER_BOX, 0, 0, 0, {nullptr, 48}) == SWIVEL_OK);
    CHECK(swivel_forward(c, 0, 0, 0, {nullptr, 24}, {}, {}) == SWIVEL_OK);

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
}

TEST_CASE("errors name group and field")
{
    const swivel_group_def groups[] = {group_of(20), group_of(5)};
    Crowd crowd = crowd_with(0, groups);
    swivel_crowd* const c = crowd.get();
    float value[4] = {};
    double doubles[4] = {};
    const swivel_out none{};
    const auto says = [](swivel_status status, const std::string& line) {
        CHECK(status == SWIVEL_INVALID_ARGUMENT);
        CHECK(swivel_last_error() == line);
    };
    says(swivel_write(c, SWIVEL_TARGET, 1, 0, 1, {value, 4}),
         "group 1, target: stride 4 is smaller than a value, 12 bytes");
    says(swivel_write(c, SWIVEL_POLE, 0, 0, 1, {nullptr, 12}), "group 0, pole: data is null");
    says(swivel_write(c, SWIVEL_PARENT_SCALE, 1, 0, 1, {value, 0}),
         "group 1, parent_scale: not part of this group; create it with SWIVEL_WORLD");
    says(swivel_write(c, SWIVEL_FLAGS, 0, 0, 1, {value, 0}),
         "flags is a result; swivel_write takes inputs and what is carried");
    says(swivel_write(c, SWIVEL_INPUT_END, 0, 0, 1, {value, 0}),
         "there is no field " + std::to_string(SWIVEL_INPUT_END));
    says(swivel_read(c, SWIVEL_WRIST, 0, 0, 1, {value, 16}),
         "group 0, wrist: not part of this group; create it with SWIVEL_WITH_HAND");
    says(swivel_read(c, SWIVEL_ELBOW, 0, 0, 1, {value, 0}),
         "group 0, elbow: stride 0 is smaller than a value, 8 bytes");
    says(swivel_read(c, SWIVEL_INPUT_END, 0, 0, 1, {value, 16}),
         "there is no field " + std::to_string(SWIVEL_INPUT_END));
    says(swivel_forward(c, 1, 0, 1, none, {doubles, 8}, none),
         "group 1, wrist: stride 8 is smaller than a value, 24 bytes");
    says(swivel_residuals(c, 1, 0, 1, none), "group 1, distance: data is null");
}

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

TEST_CASE("results as joints need bindings of unit rotations")
{
    swivel_group_def group = group_of(3);
    CHECK_NOTHROW(crowd_with(SWIVEL_JOINTS, {&group, 1}));
    swivel_binding& b = group.binding;
    for (float* const q :
         {b.parent_from_arm, b.upper_from_arm, b.elbow_parent_from_arm, b.fore_from_arm, b.wrist_parent_from_arm,
          b.shoulder_rest, b.elbow_rest, b.wrist_rest, b.twist_parent_from_arm[6], b.twist_from_arm[0]}) {
        for (const float w : {0.0f, 1.001f, std::numeric_limits<float>::quiet_NaN()}) {
            q[3] = w;
            const bool is_none = w == 0 && q == group.binding.parent_from_arm;
            CHECK_THROWS_WITH(crowd_with(SWIVEL_JOINTS, {&group, 1}),
                              Catch::Contains("group 0") && Catch::Contains(is_none ? "has no binding" : "unit"));
            CHECK_NOTHROW(crowd_with(0, {&group, 1}));
        }
        q[3] = 1;
    }
}

TEST_CASE("a binding of an older header gets what it has room for; one of no size, and what is reserved, are refused")
{
    swivel_chain chain = swivel_default_chain();
    chain.elbow_offset[2] = chain.wrist_offset[2] = chain.bend[1] = 1;
    swivel_binding whole = swivel_default_binding(), part = whole, none = whole;
    part.size = offsetof(swivel_binding, lengths);
    none.size = 0;
    REQUIRE(swivel_bind(&chain, &whole) == SWIVEL_OK);
    REQUIRE(swivel_bind(&chain, &part) == SWIVEL_OK);
    CHECK(std::ranges::equal(part.wrist_rest, whole.wrist_rest));
    CHECK(part.lengths[0] == 0);
    CHECK(whole.lengths[0] == 1);
    CHECK_REFUSED(swivel_bind(&chain, &none), SWIVEL_INVALID_ARGUMENT);
    chain.reserved = 1;
    CHECK_REFUSED(swivel_bind(&chain, &whole), SWIVEL_INVALID_ARGUMENT);
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

TEST_CASE("a binding that is none, or without lengths, is refused with JOINTS")
{
    swivel_group_def group = swivel::group(3, SWIVEL_JOINTS);
    const swivel_crowd_def def = def_of(group);
    CHECK_REFUSED(swivel_crowd_bytes(&def), 0u);
    CHECK(std::string(swivel_last_error()) == "group 0 has no binding; make it with swivel_bind()");
    group.binding = group_of(3).binding;
    std::ranges::fill(group.binding.lengths, 0.0f);
    CHECK_REFUSED(swivel_crowd_bytes(&def), 0u);
    for (const Float2& lengths : {Float2{kNan, kNan}, Float2{0, 1}, Float2{1, 0}}) {
        std::ranges::copy(lengths, group.binding.lengths);
        CHECK(swivel_crowd_bytes(&def) > 0);
    }
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
struct FloatsFirst {
    Floats v;
    float w;
};
static_assert(FieldValue<Floats> && FieldValue<FloatsFirst> && FieldValue<Float3> && FieldValue<float[4]>);
static_assert(FieldValue<std::uint32_t> && FieldValue<const float>);
static_assert(!FieldValue<Doubles> && !FieldValue<double> && !FieldValue<std::array<double, 3>> &&
              !FieldValue<IntFirst>);
struct Made {
    explicit Made(float) {}
    float x = 0;
};
struct MadeFirst {
    Made made;
    float w;
};
static_assert(FieldValue<Made> && FieldValue<MadeFirst>);  // classes are taken at their word
static_assert(!FieldValue<int> && !FieldValue<Eigen::Vector3d> && !FieldValue<std::vector<float>>);
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
