// SPDX-License-Identifier: MIT
//
// The promise: the caller's floating-point environment changes no bit of what any function of swivel.h computes, says
// or refuses. No call raises the caller's traps, and each puts the environment back, sticky flags included. Every
// function of the header is in one of two lists here. One is of those that compute or judge floats, one of the others.
// test_bits.cpp has more of swivel_solve(), on rows of all kinds of crowds.
#include "swivel/lecture.h"
#include "tests/test_arm.h"
#include "tests/test_crowd.h"
#include "tests/test_random.h"

#include <cfenv>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <regex>
#include <set>

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
float any_float(Random& random)
{
    const double number = any_number(random);
    return number == number ? static_cast<float>(number) : std::numeric_limits<float>::signaling_NaN();
}
// Mostly numbers that calls accept.
double number(Random& random) { return random.below(20) ? random.between(-2, 2) : any_number(random); }
float number_as_float(Random& random)
{
    return random.below(20) ? static_cast<float>(random.between(-2, 2)) : any_float(random);
}
template <std::size_t count>
void fill(float (&values)[count], Random& random)
{
    for (float& value : values) value = number_as_float(random);
}

constexpr std::uint32_t kLimbs = 40;
constexpr swivel_features kFeatures = SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND | SWIVEL_WITH_SHOULDER_CONE |
                                      SWIVEL_WITH_HUMERAL_TWIST | SWIVEL_WITH_MOST_SWIVEL;

// A solved crowd with limits, steps, hands and some bad inputs.
Crowd random_crowd(Random& random)
{
    Crowd crowd = crowd_of(kFeatures, kLimbs, group_of(1).binding);
    std::vector<Float3> targets(kLimbs), poles(kLimbs);
    std::vector<Float4> hands(kLimbs), parents(kLimbs);
    for (std::uint32_t n = 0; n < kLimbs; ++n) {
        targets[n] = floats(random.between(0, 2.5) * random.direction());
        poles[n] = floats(random.direction());
        hands[n] = floats(random.rotation());
        parents[n] = floats(random.rotation());
        if (random.below(10) == 0) targets[n][0] = any_float(random);
    }
    crowd.write(SWIVEL_TARGET, 0, targets);
    crowd.write(SWIVEL_POLE, 0, poles);
    crowd.write(SWIVEL_HAND, 0, hands);
    crowd.write(SWIVEL_PARENT_ROTATION, 0, parents);
    crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, Float3{0.1f, 0.2f, 0.3f});
    crowd.write_all(SWIVEL_SHOULDER_CONE, 0, cone({0, -1, 1}, random.between(0.3, 1.5)));
    crowd.write_all(SWIVEL_HUMERAL_TWIST, 0, range(-0.5, random.between(0.1, 1)));
    crowd.write_all(SWIVEL_MOST_SWIVEL, 0, turn(0.2));
    crowd.solve();
    return crowd;
}

swivel_chain random_chain(Random& random)
{
    swivel_chain chain = swivel_default_chain();
    fill(chain.shoulder_rotation, random);
    fill(chain.elbow_rotation, random);
    fill(chain.wrist_rotation, random);
    fill(chain.elbow_offset, random);
    fill(chain.wrist_offset, random);
    fill(chain.bend, random);
    return chain;
}

// A call with inputs of its own. It is made later, in some environment, and writes what it gave.
using Call = std::function<void(Record&)>;
using Make = Call (*)(Random&);

// Values of one limb in each call: kept where the call can read them later.
template <class Value>
std::shared_ptr<Value> keep(Value value)
{
    return std::make_shared<Value>(std::move(value));
}
template <class Values>
Record& add_all(Record& to, const Values& values)
{
    for (const auto& value : values) to.add(value);
    return to;
}

const std::map<std::string, Make> kComputing = {
    {"swivel_bind",
     [](Random& random) -> Call {
         return [chain = random_chain(random)](Record& to) {
             swivel_binding binding = swivel_default_binding();
             to.add(swivel_bind(&chain, &binding));
             to.add(binding);
         };
     }},
    {"swivel_bind_joints",
     [](Random& random) -> Call {
         std::array<std::array<float, 4>, 5> rotations;
         std::array<std::array<float, 3>, 5> places;
         for (auto& q : rotations)
             for (float& c : q) c = number_as_float(random);
         for (auto& v : places)
             for (float& c : v) c = number_as_float(random);
         return [rotations, places](Record& to) {
             const std::int32_t parents[] = {-1, 0, 1, 2, 3};
             swivel_skeleton skeleton = swivel_default_skeleton();
             skeleton.parents = {parents, sizeof parents[0]};
             skeleton.rotations = {rotations.data(), sizeof rotations[0]};
             skeleton.translations = {places.data(), sizeof places[0]};
             skeleton.joint_count = 5;
             const swivel_limb_joints joints = swivel_default_limb_joints(1, 3, 4);
             swivel_binding binding = swivel_default_binding();
             to.add(swivel_bind_joints(&skeleton, &joints, &binding));
             to.add(binding);
         };
     }},
    {"swivel_arm_axis",
     [](Random& random) -> Call {
         swivel_chain chain = random_chain(random);
         swivel_binding binding = group_of(1).binding;
         (void)swivel_bind(&chain, &binding);
         float parent[4];
         fill(parent, random);
         const std::array<double, 3> direction{number(random), number(random), number(random)};
         return [binding, q = std::to_array(parent), direction](Record& to) {
             double axis[3] = {};
             to.add(swivel_arm_axis(&binding, q.data(), direction.data(), axis));
             to.add(axis);
         };
     }},
    {"swivel_crowd_bytes",
     [](Random& random) -> Call {
         swivel_group_def group = group_of(3);
         group.binding.lengths[0] = number_as_float(random);
         // On the edge of unit length: 1e-5 is allowed.
         group.binding.parent_from_arm[3] = static_cast<float>(1 + random.between(4.9e-6, 5.1e-6));
         if (random.below(4) == 0) group.binding.fore_from_arm[random.below(4)] = any_float(random);
         group.features = SWIVEL_JOINTS;
         return [group](Record& to) {
             const swivel_crowd_def def = def_of(group);
             to.add(swivel_crowd_bytes(&def));
         };
     }},
    {"swivel_crowd_create",
     [](Random& random) -> Call {
         swivel_group_def group = group_of(3);
         group.binding.parent_from_arm[3] = static_cast<float>(1 + random.between(4.9e-6, 5.1e-6));
         group.binding.shoulder_rest[1] = random.below(4) ? 1e-4f : any_float(random);
         group.features = SWIVEL_JOINTS;
         return [group](Record& to) {
             const swivel_crowd_def def = def_of(group);
             swivel_crowd* crowd = nullptr;
             to.add(swivel_crowd_create(&def, &crowd));
             to.add(swivel_digest(crowd));
             swivel_crowd_destroy(crowd);
         };
     }},
    {"swivel_unpack_rotation",
     [](Random& random) -> Call {
         const std::array<std::uint16_t, 3> words{static_cast<std::uint16_t>(random.word()),
                                                  static_cast<std::uint16_t>(random.word()),
                                                  static_cast<std::uint16_t>(random.word())};
         return [words](Record& to) {
             float xyzw[4];
             swivel_unpack_rotation(words.data(), 1, xyzw);
             to.add(xyzw);
         };
     }},
    {"swivel_unpack_half",
     [](Random& random) -> Call {
         return [word = static_cast<std::uint16_t>(random.word())](Record& to) { to.add(swivel_unpack_half(word)); };
     }},
    {"swivel_write_doubles",
     [](Random& random) -> Call {
         const auto crowd = keep(random_crowd(random));
         const std::array<double, 3> place{1e7 * number(random), number(random), number(random)};
         return [crowd, place](Record& to) {
             to.add(swivel_write_doubles(crowd->get(), SWIVEL_TARGET, 0, 0, kLimbs, {&place, 0}, {}));
             add_all(to, all_words(*crowd));
         };
     }},
    {"swivel_pack",
     [](Random& random) -> Call {
         const auto crowd = keep(random_crowd(random));
         return [crowd](Record& to) {
             const std::uint32_t rows = swivel_packed_row(kFeatures, SWIVEL_RESULT_END);
             std::vector<std::uint16_t> words(std::size_t{(kLimbs + 15) / 16} * rows * SWIVEL_LANES);
             to.add(swivel_pack(crowd->get(), 0, {0, (kLimbs + 15) / 16}, words.data()));
             for (const std::uint16_t word : words) to.add(word);
         };
     }},
    {"swivel_solve",
     [](Random& random) -> Call {
         const auto crowd = keep(random_crowd(random));
         return [crowd](Record& to) {
             to.add(swivel_reset(crowd->get(), 0, 0, kLimbs));
             to.add(swivel_solve(crowd->get(), nullptr));
             to.add(swivel_digest(crowd->get()));
         };
     }},
    {"swivel_choose",
     [](Random& random) -> Call {
         std::array<float, kLimbs> priorities;
         for (float& priority : priorities) priority = any_float(random);
         return [priorities](Record& to) {
             Crowd crowd = crowd_of(0, kLimbs);
             float urgency[(kLimbs + 15) / 16] = {};
             const swivel_in each{priorities.data(), sizeof(float)};
             std::uint32_t mask[2] = {};
             for (int n = 0; n < 4; ++n) {
                 to.add(swivel_choose(crowd.get(), &each, urgency, 1, mask, 2, nullptr));
                 to.add(mask);
             }
             to.add(urgency);
         };
     }},
    {"swivel_explain",
     [](Random& random) -> Call {
         const auto crowd = keep(random_crowd(random));
         return [crowd](Record& to) {
             for (std::uint32_t limb = 0; limb < kLimbs; ++limb) {
                 char text[1024] = {};
                 to.add(swivel_explain(crowd->get(), 0, limb, text, sizeof text));
                 to.add(text);
             }
         };
     }},
    {"swivel_allowed_arcs",
     [](Random& random) -> Call {
         const auto crowd = keep(random_crowd(random));
         return [crowd](Record& to) {
             for (std::uint32_t limb = 0; limb < kLimbs; ++limb) {
                 swivel_arc arcs[8] = {};
                 std::uint32_t count = 0;
                 to.add(swivel_allowed_arcs(crowd->get(), 0, limb, arcs, 8, &count));
                 to.add(arcs);
             }
         };
     }},
    {"swivel_joint_angles",
     [](Random& random) -> Call {
         const auto crowd = keep(random_crowd(random));
         return [crowd](Record& to) {
             double angles[kLimbs][7] = {};
             to.add(swivel_joint_angles(crowd->get(), 0, 0, kLimbs, SWIVEL_XYZ, SWIVEL_ZYX, 0,
                                        {angles, sizeof angles[0]}));
             to.add(angles);
         };
     }},
    {"swivel_forward",
     [](Random& random) -> Call {
         const auto crowd = keep(random_crowd(random));
         return [crowd](Record& to) {
             double elbows[kLimbs][3] = {}, wrists[kLimbs][3] = {}, hands[kLimbs][4] = {};
             to.add(swivel_forward(crowd->get(), 0, 0, kLimbs, {elbows, sizeof elbows[0]}, {wrists, sizeof wrists[0]},
                                   {hands, sizeof hands[0]}));
             to.add(elbows);
             to.add(wrists);
             to.add(hands);
         };
     }},
    {"swivel_residuals",
     [](Random& random) -> Call {
         const auto crowd = keep(random_crowd(random));
         return [crowd](Record& to) {
             double distances[kLimbs] = {};
             to.add(swivel_residuals(crowd->get(), 0, 0, kLimbs, {distances, sizeof distances[0]}));
             to.add(distances);
         };
     }},
    {"swivel_range",
     [](Random& random) -> Call {
         return [least = number(random), most = number(random) + 1](Record& to) {
             float values[4] = {};
             to.add(swivel_range(least, most, values));
             to.add(values);
         };
     }},
    {"swivel_cone",
     [](Random& random) -> Call {
         const std::array<double, 3> axis{number(random), number(random), number(random)};
         return [axis, most = number(random) + 1](Record& to) {
             float values[4] = {};
             to.add(swivel_cone(axis.data(), most, values));
             to.add(values);
         };
     }},
    {"swivel_flexion",
     [](Random& random) -> Call {
         return [least = number(random), most = number(random) + 1](Record& to) {
             float values[2] = {};
             to.add(swivel_flexion(least, most, values));
             to.add(values);
         };
     }},
    {"swivel_aim",
     [](Random& random) -> Call {
         const std::array<double, 3> axis{number(random), number(random), number(random)};
         return [axis, flexion = number(random) + 1](Record& to) {
             float values[5] = {};
             to.add(swivel_aim(axis.data(), flexion, values));
             to.add(values);
         };
     }},
    {"swivel_turn",
     [](Random& random) -> Call {
         return [angle = number(random)](Record& to) {
             float values[2] = {};
             swivel_turn(angle, values);
             to.add(values);
         };
     }},
    {"swivel_mirror",
     [](Random& random) -> Call {
         float from[12];
         for (float& value : from) value = any_float(random);
         return [values = std::to_array(from)](Record& to) {
             for (const swivel_field field : every_field()) {
                 float mirrored[12] = {};
                 to.add(swivel_mirror(field, SWIVEL_YXZ, values.data(), mirrored));
                 to.add(mirrored);
             }
         };
     }},
    {"swivel_steps",
     [](Random& random) -> Call {
         std::array<double, 8> in;
         for (double& value : in) value = number(random);
         in[6] = std::abs(in[6]);
         in[7] = std::abs(in[7]);
         return [in](Record& to) {
             swivel_entity entities[SWIVEL_ENTITY_COUNT] = {};
             double error = 0;
             to.add(!swivel_steps(in.data(), in.data() + 3, in[6], in[7], entities, &error));
             for (const swivel_entity& entity : entities) to.add(entity.coefficients);
             to.add(error);
         };
     }},
    {"swivel_verify",
     [](Random& random) -> Call {
         return [seed = random.bits()](Record& to) {
             const auto write = [](const swivel_check* check, void* user) {
                 static_cast<Record*>(user)->add(check->max);
                 static_cast<Record*>(user)->add(check->rms);
             };
             to.add(swivel_verify(1, seed, write, &to));
         };
     }},
};

// These copy, count, or answer from integers.
const std::set<std::string> kWithoutFloats = {"swivel_version",
                                              "swivel_status_text",
                                              "swivel_last_error",
                                              "swivel_crowd_destroy",
                                              "swivel_block_count",
                                              "swivel_group_first_limb",
                                              "swivel_digest",
                                              "swivel_group_limb_count",
                                              "swivel_field_first_row",
                                              "swivel_field_row_count",
                                              "swivel_input_rows",
                                              "swivel_result_rows",
                                              "swivel_read",
                                              "swivel_write",
                                              "swivel_reset",
                                              "swivel_find",
                                              "swivel_isa_name",
                                              "swivel_use_isa",
                                              "swivel_isa_at",
                                              "swivel_isa_runs",
                                              "swivel_group_count",
                                              "swivel_packed_row",
                                              "swivel_group_features",
                                              "swivel_component_count",
                                              "swivel_describe_field",
                                              "swivel_describe_feature",
                                              "swivel_flag_name"};

// How many sets of inputs a function gets. swivel_verify() always checks some 300,000 hard poses.
int repeats_of(const std::string& name) { return name == "swivel_verify" ? 1 : name == "swivel_explain" ? 20 : 200; }

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

TEST_CASE("the lists name every function of swivel.h once")
{
    std::ifstream file(SWIVEL_SOURCE_DIR "/include/swivel/swivel.h");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::regex declaration(R"(\nSWIVEL_API [^(;]*?\b(swivel_\w+)\()");
    std::set<std::string> declared = {"swivel_steps", "swivel_verify"}, listed = kWithoutFloats;  // of lecture.h
    for (std::sregex_iterator it(text.begin(), text.end(), declaration), end; it != end; ++it)
        declared.insert((*it)[1]);
    for (const auto& [name, make] : kComputing) CHECK(listed.insert(name).second);
    REQUIRE(declared.size() > 40);
    CHECK(listed == declared);
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
    for (const auto& [name, make] : kComputing) {
        Random random{7};
        bool holds = true;
        for (int n = 0; n < repeats_of(name) && holds; ++n) {
            const Call call = make(random);
            Record expected;
            call(expected);
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
                call(got);
                const Control found = control();
                std::fesetenv(&before);
                INFO(name << ", " << in.name << ", inputs " << n);
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
    const swivel_group_def group = group_of(1);
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
