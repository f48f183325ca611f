// SPDX-License-Identifier: MIT
//
// The promise: the caller's floating-point environment changes no bit of what any function of swivel.h and its sisters
// computes, says or refuses. No call raises the caller's traps, and each puts the environment back, sticky flags
// included. Every function of these headers is called here, or is in the list of those that neither compute nor judge
// floats.
#include "swivel/lecture.h"
#include "swivel/swivel_explain.h"
#include "swivel/swivel_regions.h"
#include "tests/test_arm.h"
#include "tests/test_crowd.h"
#include "tests/test_random.h"
#include "tools/corpus/corpus.h"

#include <cfenv>
#include <fstream>
#include <iterator>
#include <random>
#include <regex>
#include <string_view>

#ifdef __x86_64__
#include <xmmintrin.h>
#endif

using namespace swivel;
using namespace swivel::test;

namespace {

// What calls gave, byte by byte.
struct Record {
    std::string bytes;

    template <class Value>
    void add(const Value& value)
    {
        static_assert(std::is_trivially_copyable_v<Value>);
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void add(swivel_status status)
    {
        bytes += std::to_string(status);
        if (status != SWIVEL_OK) bytes += swivel_last_error();
    }
};

// A number of any size, sometimes none.
double any_number(Random& random)
{
    switch (random.below(8)) {
        case 0:
            return random.below(2) ? std::numeric_limits<double>::signaling_NaN() : double{kInf};
        case 1:
            return random.spread(1e-44, 1e-36);  // denormal as a float
        default:
            return random.between(-2, 2);
    }
}
// Mostly numbers that calls accept.
double number(Random& random) { return random.below(20) ? random.between(-2, 2) : any_number(random); }
float as_float(double x) { return x == x ? static_cast<float>(x) : std::numeric_limits<float>::signaling_NaN(); }
void fill(std::span<float> values, Random& random)
{
    for (float& value : values) value = as_float(number(random));
}

constexpr std::uint32_t kLimbs = 40;

// What calls take, made before in the usual environment.
struct CallInputs {
    std::array<double, 12> numbers;
    std::array<double, 3> far;
    double max;
    std::array<float, 60> values;
    std::array<float, kLimbs> priorities;
    std::array<std::uint16_t, 3> words;
    ThreeJoints limb;
    swivel_limb_def group = group_of(3);
    Crowd crowd;
    std::vector<Float3> targets;  // of its first group

    // One of the corpus's crowds of whole limbs, some of which have bad input.
    explicit CallInputs(Random& random) : crowd(make_crowd(any_recipe(random), kLimbs))
    {
        targets = read<Float3>(crowd, SWIVEL_TARGET);
        for (double& number_in : numbers) number_in = number(random);
        far = {1e7 * numbers[0], numbers[1], numbers[2]};
        max = numbers[4] + 1;
        fill(values, random);
        for (float& priority : priorities) priority = as_float(any_number(random));
        for (std::uint16_t& word : words) word = static_cast<std::uint16_t>(random.word());
        for (auto& q : limb.rotations) fill(q, random);
        for (auto* v : {&limb.translations[1], &limb.translations[2], &limb.bend}) fill(*v, random);
        group.features = SWIVEL_JOINTS;
        if (random.below(4) == 0) group.binding.lengths[0] = as_float(number(random));
        // On the edge of unit length: 1e-5 is allowed.
        group.binding.parent_from_arm[3] = static_cast<float>(1 + random.between(4.9e-6, 5.1e-6));
        if (random.below(4) == 0) group.binding.fore_from_arm[random.below(4)] = as_float(any_number(random));
    }
    static const corpus::Recipe& any_recipe(Random& random)
    {
        const std::span<const corpus::Recipe> all = corpus::recipes_of(corpus::Part::limbs);
        return all[random.below(static_cast<std::uint32_t>(all.size()))];
    }
};

void make_values(const CallInputs& in, Record& record)
{
    const double *axis = in.numbers.data(), min = in.numbers[3], max = in.max;
    float values[12] = {};
    record.add(swivel_range(min, max, values)), record.add(values);
    record.add(swivel_cone(axis, max, values)), record.add(values);
    record.add(swivel_flexion(min, max, values)), record.add(values);
    record.add(swivel_aim(axis, max, values)), record.add(values);
    swivel_cos_sin(min, values), record.add(values);
    for (const swivel_field field : every_field())
        record.add(swivel_mirror(field, SWIVEL_YXZ, in.values.data(), values)), record.add(values);
    swivel_unpack_rotation(in.words.data(), 1, values), record.add(values);
    record.add(swivel_unpack_half(in.words[0]));

    swivel_entity entities[SWIVEL_ENTITY_COUNT] = {};
    double error = 0;
    record.add(!swivel_steps(axis, axis + 3, std::fabs(in.numbers[6]), std::fabs(in.numbers[7]), entities, &error));
    for (const swivel_entity& entity : entities) record.add(entity.coefficients);
    record.add(error);
}

void bind_limbs(const CallInputs& in, Record& record)
{
    swivel_binding binding = group_of(1).binding;
    double axis[3] = {};
    const swivel_skeleton alone = in.limb.skeleton();
    const swivel_limb_joints bent = in.limb.joints();
    record.add(swivel_bind_joints(&alone, &bent, &binding)), record.add(binding);
    record.add(swivel_arm_axis(&binding, in.values.data(), in.numbers.data(), axis)), record.add(axis);
    const std::int32_t parents[] = {-1, 0, 1, 2, 3};
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.parents = {parents, sizeof parents[0]};
    skeleton.rotations = {in.values.data(), 4 * sizeof(float)};
    skeleton.translations = {in.values.data() + 20, 3 * sizeof(float)};
    skeleton.joint_count = 5;
    const swivel_limb_joints joints = swivel_default_limb_joints(1, 3, 4);
    record.add(swivel_bind_joints(&skeleton, &joints, &binding)), record.add(binding);

    const swivel_group_def group = c_group(in.group);
    const swivel_crowd_def def = def_of(group);
    record.add(swivel_crowd_bytes(&def));
    swivel_crowd* crowd = nullptr;
    record.add(swivel_crowd_create(&def, &crowd)), record.add(swivel_digest(crowd));
    swivel_crowd_destroy(crowd);
}

void use_group(swivel_crowd* crowd, std::uint32_t group, Record& record)
{
    const swivel_features features = swivel_group_features(crowd, group);
    const std::uint32_t limbs = swivel_group_limb_count(crowd, group), blocks = (limbs + 15) / 16;
    std::vector<std::uint16_t> words(std::size_t{blocks} * swivel_packed_row(crowd, group, SWIVEL_RESULT_END) *
                                     SWIVEL_LANES);
    record.add(swivel_pack(crowd, group, {0, blocks}, words.data()));
    for (const std::uint16_t word : words) record.add(word);
    std::array<Float4, kLimbs> turns{};
    record.add(swivel_read(crowd, SWIVEL_SHOULDER, group, 0, limbs, {turns.data(), sizeof turns[0]})),
        record.add(turns);
    double elbows[kLimbs][3] = {}, wrists[kLimbs][3] = {}, hands[kLimbs][4] = {}, angles[kLimbs][7] = {},
           off[kLimbs] = {};
    const swivel_out hand{features & SWIVEL_WITH_HAND ? hands : nullptr, sizeof hands[0]};
    record.add(swivel_forward(crowd, group, 0, limbs, {elbows, sizeof elbows[0]}, {wrists, sizeof wrists[0]}, hand));
    record.add(elbows), record.add(wrists), record.add(hands);
    record.add(swivel_joint_angles(crowd, group, 0, limbs, SWIVEL_XYZ, SWIVEL_ZYX, 0, {angles, sizeof angles[0]}));
    record.add(angles);
    record.add(swivel_residuals(crowd, group, 0, limbs, {off, sizeof off[0]})), record.add(off);
    for (std::uint32_t limb = 0; limb < limbs; ++limb) {
        char text[SWIVEL_EXPLANATION_BYTES] = {};
        record.add(swivel_explain(crowd, group, limb, text, sizeof text)), record.add(text);
        swivel_arc arcs[8] = {};
        std::uint32_t count = 0;
        record.add(swivel_allowed_arcs(crowd, group, limb, arcs, 8, &count)), record.add(arcs);
    }
}
void use_crowd(const CallInputs& in, Record& record)
{
    swivel_crowd* const crowd = in.crowd.get();
    const std::uint32_t groups = swivel_group_count(crowd), blocks = swivel_block_count(crowd);
    for (std::uint32_t g = 0; g < groups; ++g) record.add(swivel_reset(crowd, g, 0, swivel_group_limb_count(crowd, g)));
    record.add(swivel_solve(crowd, nullptr)), record.add(swivel_digest(crowd));
    for (std::uint32_t g = 0; g < groups; ++g) use_group(crowd, g, record);
    float urgency[8] = {};
    const std::vector<swivel_in> each(groups, {in.priorities.data(), sizeof(float)});
    std::uint32_t mask[4] = {};
    for (int n = 0; n < 4; ++n)
        record.add(swivel_choose(crowd, each.data(), urgency, 1, mask, (blocks + 1) / 2, nullptr)), record.add(mask);
    record.add(urgency);
    record.add(swivel_write_doubles(crowd, SWIVEL_TARGET, 0, 0, kLimbs, {in.far.data(), 0}, {}));
    for (const std::uint32_t word : all_words(in.crowd)) record.add(word);
    record.add(swivel_write(crowd, SWIVEL_TARGET, 0, 0, kLimbs, {in.targets.data(), sizeof in.targets[0]}));
}

// A body that stands, in frames of any length, on supports that may be none.
void stand(const CallInputs& in, Record& record)
{
    constexpr std::int32_t parents[] = {-1, 0, 1, 2};
    constexpr float translations[][3] = {{0, 0, 0}, {0.1f, 0, 0}, {0, -0.4f, 0.1f}, {0, -0.4f, -0.1f}};
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.parents = {parents, sizeof parents[0]};
    skeleton.translations = {translations, sizeof translations[0]};
    skeleton.joint_count = 4;
    swivel_limb_joints joints = swivel_default_limb_joints(1, 2, 3);
    joints.bend[2] = -1;
    swivel_body_limb_def leg = swivel_default_body_limb_def(&joints);
    leg.features = SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND | SWIVEL_WITH_PLANT | SWIVEL_WITH_PLANT_ROTATION |
                   SWIVEL_WITH_CAP | SWIVEL_WITH_PELVIS_FIT;
    leg.plant.lock_radius = leg.plant.unlock_radius = std::fabs(in.values[0]);
    const swivel_shift_def shift = swivel_default_shift_def();
    swivel_group_def groups[] = {swivel_default_group_def(), swivel_default_group_def()};
    groups[0].body_limb = &leg, groups[1].shift = &shift;
    swivel_crowd_def def = swivel_default_crowd_def();
    def.groups = groups, def.group_count = 2;
    def.skeleton = &skeleton, def.body_count = 1;
    std::copy_n(&in.values[1], 3, def.up);
    swivel_crowd* crowd = nullptr;
    record.add(swivel_crowd_create(&def, &crowd));
    if (!crowd) return;
    const float contact = 1, support[4] = {0.1f, 0.2f, 0.3f, 0.9f};
    record.add(swivel_write(crowd, SWIVEL_CONTACT, 0, 0, 1, {&contact, 0}));
    for (std::size_t frame = 0; frame < 5; ++frame) {
        float rotations[4][4];
        std::memcpy(rotations, &in.values[4 + 4 * frame], sizeof rotations);
        swivel_pose pose = swivel_default_pose();
        pose.rotations = {rotations, sizeof rotations, sizeof rotations[0], nullptr};
        pose.time = {&in.values[30 + frame], 0};
        pose.support_rotation = {support, 0};
        swivel_job job = swivel_default_job();
        job.pose = &pose;
        record.add(swivel_solve(crowd, &job)), record.add(swivel_digest(crowd)), record.add(rotations);
        record.add(swivel_change_support(crowd, 0, 0, 1, {{}, {support, 0}},
                                         {{in.far.data(), 0}, {&in.values[40 + 4 * (frame % 4)], 0}}));
        record.add(swivel_digest(crowd));
        const double places[3][3] = {{0.1, in.far[0], 0}, {0.1, -0.4, 0.1}, {0.1, -0.8, 1.0 / 3}};
        char text[1024] = {};
        int agrees = -1;
        record.add(swivel_compare(crowd, 0, 0, &pose, places[0], places[1], places[2], text, sizeof text, &agrees));
        record.add(text), record.add(agrees);
        std::vector<swivel_shape> shapes(200);
        std::uint32_t count = 0;
        record.add(swivel_draw(crowd, SWIVEL_EVERY_GROUP, 0, &pose, shapes.data(), 200, &count)), record.add(count);
        for (std::uint32_t n = 0; n < std::min(count, 200u); ++n) record.add(shapes[n].from), record.add(shapes[n].to);
    }
    swivel_crowd_destroy(crowd);
}

// A region of any cones, corners and directions.
void make_region(const CallInputs& in, Record& record)
{
    const float* const values = in.values.data();
    swivel_region region = swivel_default_region(), other = region;
    swivel_region_cone cones[3];
    for (std::size_t n = 0; n < 3; ++n)
        cones[n] = {{values[4 * n], values[4 * n + 1], values[4 * n + 2]}, std::fabs(values[4 * n + 3])};
    const auto add = [&](swivel_status status, const swivel_region& made) {
        record.add(status), record.add(made.first), record.add(made.half_space);
    };
    add(swivel_region_add_cones(&region, cones, 3, 1), region);
    add(swivel_region_add_polygon(&region, values + 12, 3), region);
    add(swivel_region_add_directions(&region, values + 21, 10, 0.05f, 4), region);
    add(swivel_region_forbid(&region, cones), region);
    add(swivel_region_mirror(&region, &other), other);
    float room = 0;
    record.add(swivel_region_room(&region, values + 51, &room)), record.add(room);
}

void verify(const CallInputs&, Record& record)
{
    const auto write = [](const swivel_check* check, void* user) {
        static_cast<Record*>(user)->add(check->max);
        static_cast<Record*>(user)->add(check->rms);
    };
    record.add(swivel_verify(1, 7, write, &record));
}

// Calls, and how many sets of inputs they get. swivel_verify() always checks some 300,000 hard poses.
struct Calls {
    const char* name;
    int repeats;
    void (*make)(const CallInputs&, Record&);
};
constexpr Calls kCalls[] = {
    {"values from angles", 200, make_values}, {"bindings and defs", 200, bind_limbs}, {"a crowd", 30, use_crowd},
    {"a body that stands", 200, stand},       {"regions", 200, make_region},          {"swivel_verify", 1, verify},
};

// These copy, count, or answer from integers.
constexpr std::string_view kWithoutFloats =
    " version status_text last_error crowd_destroy block_count group_first_limb digest group_limb_count "
    "field_first_row field_row_count input_rows result_rows packed_row write reset isa_name use_isa "
    "isa_at isa_runs group_count group_kind group_features describe_field describe_feature "
    "describe_constant flag_name workspace_bytes state_bytes save load reset_body state_digest ";

#ifdef __x86_64__
// The control words and sticky flags of both units.
struct Control {
    std::uint32_t csr;
    std::uint16_t word, status;
    bool operator==(const Control&) const = default;
};
Control control()
{
    Control now{_mm_getcsr(), 0, 0};
    asm volatile("fnstcw %0\n\tfnstsw %1" : "=m"(now.word), "=m"(now.status));
    return now;
}
#endif

}  // namespace

TEST_CASE("every function of the headers is called here, or computes nothing")
{
    const auto text_of = [](const char* name) {
        std::ifstream file(std::string(SWIVEL_SOURCE_DIR "/") + name);
        return std::string{std::istreambuf_iterator<char>(file), {}};
    };
    const std::string here = text_of("tests/library/test_float_environment.cpp");
    std::string headers;
    for (const char* const name : {"swivel.h", "swivel_bodies.h", "swivel_regions.h", "swivel_explain.h"})
        headers += text_of((std::string("include/swivel/") + name).c_str());
    const std::regex declaration(R"(\nSWIVEL_API [^(;]*?\b(swivel_\w+)\()");
    int declared = 0;
    for (std::sregex_iterator it(headers.begin(), headers.end(), declaration), end; it != end; ++it, ++declared) {
        const std::string name = (*it)[1];
        INFO(name);
        const std::string bare = " " + name.substr(7) + " ";
        CHECK((kWithoutFloats.find(bare) != std::string::npos || here.find(" " + name + "(") != std::string::npos ||
               here.find("(" + name + "(") != std::string::npos));
    }
    CHECK(declared > 40);
}

#ifdef __x86_64__
TEST_CASE("no environment of the caller changes a bit, and each is put back")
{
    constexpr unsigned ftz = 0x8000, daz = 0x0040, one_sticky = 0x0004;
    struct Environment {
        const char* name;
        int rounding;
        unsigned csr;  // more bits
        bool traps;
    };
    const Environment environments[] = {
        {"as usual", FE_TONEAREST, 0, false},
        {"round up", FE_UPWARD, one_sticky, false},
        {"round down", FE_DOWNWARD, 0, false},
        {"round to zero", FE_TOWARDZERO, 0, false},
        {"flush denormals", FE_TONEAREST, ftz | daz | one_sticky, false},
        {"traps", FE_TONEAREST, 0, true},
    };
    for (const Calls& calls : kCalls) {
        const std::uint64_t seed = std::random_device()();
        Random random{seed};
        bool holds = true;
        for (int n = 0; n < calls.repeats && holds; ++n) {
            const CallInputs inputs(random);
            Record expected;
            calls.make(inputs, expected);
            for (const Environment& in : environments) {
                Record got;
                got.bytes.reserve(2 * expected.bytes.size());
                std::fenv_t before;
                std::fegetenv(&before);
                std::feclearexcept(FE_ALL_EXCEPT);
                std::fesetround(in.rounding);
                _mm_setcsr(_mm_getcsr() | in.csr);
                if (in.traps) ::feenableexcept(FE_ALL_EXCEPT);
                const Control wanted = control();
                calls.make(inputs, got);
                const Control found = control();
                std::fesetenv(&before);
                INFO(calls.name << ", " << in.name << ", seed " << seed << ", inputs " << n);
                CHECK(found == wanted);
                CHECK((got.bytes == expected.bytes));
                holds = holds && found == wanted && got.bytes == expected.bytes;
            }
        }
    }
}

TEST_CASE("callbacks run in the caller's environment")
{
    const auto is_upward = [](void* user) { *static_cast<bool*>(user) = std::fegetround() == FE_UPWARD; };
    static constexpr auto look = is_upward;
    bool in_verify = false, in_allocate = false;
    const swivel_limb_def limb = group_of(1);
    const swivel_group_def group = c_group(limb);
    swivel_crowd_def def = def_of(group);
    def.user = &in_allocate;
    def.allocate = [](std::size_t size, std::size_t alignment, void* user) {
        look(user);
        return std::aligned_alloc(alignment, size);
    };
    def.release = [](void* memory, std::size_t, void*) { std::free(memory); };
    swivel_crowd* crowd = nullptr;
    std::fesetround(FE_UPWARD);
    const int passed = swivel_verify(
        1, 1, [](const swivel_check*, void* user) { look(user); }, &in_verify);
    swivel_crowd_create(&def, &crowd);
    std::fesetround(FE_TONEAREST);
    swivel_crowd_destroy(crowd);
    CHECK(in_verify);
    CHECK(in_allocate);
    CHECK(passed);
}
#endif
