// SPDX-License-Identifier: MIT
#include "tests/fuzz/crowd_of_bytes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>

#include "tests/three_joints.h"

namespace swivel::fuzz {
namespace {

// What the kernels of plain arms know. With any other feature, limbs have another kernel.
constexpr swivel_features kPlain = SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND | SWIVEL_POLE_DIRECTION;

float hard_number(Random& random)
{
    constexpr float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    constexpr std::array hard = {0.0f,  -0.0f, 1e-15f, -3e-12f, 1e-38f, 1e-45f, 1.0f,  -1.0f,   1e15f, -1e15f,
                                 2e15f, 3e38f, inf,    -inf,    nan,    0.5f,   1e-9f, 0.9999f, 1e7f,  1e-7f};
    return hard[random.below(static_cast<std::uint32_t>(hard.size()))];
}

// Two angles, the smaller first, of 0 to `most`.
std::array<double, 2> two_angles(Random& random, double max)
{
    const double a = std::abs(random.share()) * max, b = std::abs(random.share()) * max;
    return {std::min(a, b), std::max(a, b)};
}

void make_range(Random& random, float* range)
{
    const auto [min, max] = two_angles(random, 6);
    swivel_range(min - 3, max - 3, range);
}

// A value of a field's range, as the library says it in words: by its own maker of such values where it names one.
void make_ordinary(Random& random, swivel_field field, std::span<float> value)
{
    const std::array<double, 3> axis = {random.share(), random.share(), random.share()};
    const auto [min, max] = two_angles(random, 3.1415926);
    const std::string_view range = described(field).range;
    const auto says = [&](std::string_view words) { return range.find(words) != range.npos; };
    if (says("swivel_cos_sin()")) return void(swivel_cos_sin(says("of 0 to pi") ? min : 4 * min - 6, value.data()));
    if (says("swivel_flexion()")) return void(swivel_flexion(min, max, value.data()));
    if (says("swivel_cone()")) return void(swivel_cone(axis.data(), max, value.data()));
    if (says("swivel_aim()")) return void(swivel_aim(axis.data(), max, value.data()));
    if (says("swivel_range()")) {  // below an axis, or alone
        std::array<float, 4> cone = {0, 0, 1, 0};
        swivel_cone(axis.data(), 1, cone.data());
        std::copy_n(cone.begin(), value.size() % 4, value.begin());
        for (std::size_t n = value.size() % 4; n < value.size(); n += 4) make_range(random, &value[n]);
        return;
    }
    for (float& x : value) x = random.share();
    if (says("the stretch 1 to 1000")) {
        for (float& x : value) x = 0.25f * std::abs(x);
        value[2] += 1;
    } else if (says("a share of 0 to 1")) {
        value.back() = std::abs(value.back());
    } else if (range.starts_with("0 to 1")) {
        for (float& x : value) x = std::abs(x);
        if (random.below(4) == 0) value[0] = std::round(value[0]);  // nothing or all
    } else if (says("1e-15 to 1e15")) {
        for (float& x : value) x = std::abs(x) + 0.01f;
    } else if (field == SWIVEL_GROUND || field == SWIVEL_PROP_POSITION || field == SWIVEL_PROP_ROTATION) {
        if (random.below(4) == 0) std::ranges::fill(value, std::numeric_limits<float>::quiet_NaN());  // none
    } else if (field == SWIVEL_TARGET) {
        for (float& x : value) x *= 2;
    }
}

void turn_at_random(Random& random, float (&q)[4])
{
    float length2 = 0;
    for (float& x : q) x = random.share(), length2 += x * x;
    if (length2 < 1e-3f) return turn_at_random(random, q);
    for (float& x : q) x /= std::sqrt(length2);
}

swivel_binding binding_of(Random random)
{
    test::ThreeJoints limb;
    for (auto& q : limb.rotations)
        for (float& x : q) x = random.share();
    for (auto* const v : {&limb.translations[1], &limb.translations[2], &limb.bend})
        for (float& x : *v) x = random.share();
    const swivel_skeleton skeleton = limb.skeleton();
    const swivel_limb_joints joints = limb.joints();
    swivel_binding binding = swivel_default_binding();
    if (swivel_bind_joints(&skeleton, &joints, &binding) != SWIVEL_OK) binding = test::arm_frame_joints().bound();
    // Joints in between, and twist bones, with any rest rotations.
    turn_at_random(random, binding.elbow_parent_from_arm);
    turn_at_random(random, binding.wrist_parent_from_arm);
    for (auto* frames : {&binding.twist_parent_from_arm, &binding.twist_from_arm})
        for (auto& frame : *frames) turn_at_random(random, frame);
    return binding;
}

// Bits of seeds that stand for no feature.
constexpr std::uint32_t kOtherBits[] = {4, 23, 31, 35, 37, 38, 40, 41, 42};
static_assert(std::is_sorted(std::begin(kOtherBits), std::end(kOtherBits)),
              "seed_bit() passes them from the lowest on");
constexpr std::uint32_t kTwistBonesBit = 40;  // the first of three for the number of twist bones

// The bit that stands for a feature in seeds, by the feature's place in the library's table. Seeds count on the table's
// order, so new features come to its end.
std::uint32_t seed_bit(std::uint32_t place)
{
    std::uint32_t bit = place;
    for (const std::uint32_t other : kOtherBits) bit += other <= bit;
    return bit;
}

// A feature of a kind of limbs with all that it needs, which may need others, and what these exclude.
struct Whole {
    swivel_features features, excludes = 0;

    Whole(swivel_features feature, swivel_kind kind) : features(feature)
    {
        swivel_feature_info info;
        for (swivel_features before = 0; before != features;) {
            before = features;
            for (std::uint32_t n = 0; swivel_describe_feature(n, &info); ++n)
                if (features & info.feature) features |= info.needs, excludes |= info.excludes;
        }
        // A body's limb has these without the features.
        if (kind == SWIVEL_KIND_BODY_LIMB) features &= ~(SWIVEL_WORLD | SWIVEL_WITH_INCOMING);
    }
};

}  // namespace

std::uint64_t Random::bits()
{
    std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}
float Random::share() { return static_cast<float>(static_cast<std::int32_t>(bits() >> 40) - (1 << 23)) * 0x1p-23f; }

// Those that are wanted, go with each other, and need none that another one excludes.
LimbFeatures features_of(Bytes& bytes, swivel_kind kind)
{
    const std::uint32_t choice = bytes.take<std::uint8_t>() % 4;
    const auto bits = bytes.take<std::uint64_t>();
    // choice 0: half of all; 1: those that plain arms have, so often; 2 and 3: few.
    const std::uint64_t wanted = choice < 2 ? bits : bits & bytes.take<std::uint64_t>();
    LimbFeatures taken;
    swivel_features excluded = 0;
    swivel_feature_info info;
    for (std::uint32_t n = 0; swivel_describe_feature(n, &info); ++n) {
        const bool is_wanted = (wanted >> seed_bit(n) & 1) != 0 && (choice != 1 || info.feature & kPlain);
        const Whole whole(info.feature, kind);
        if (!is_wanted || !(info.kinds >> kind & 1)) continue;
        if ((excluded & whole.features) || (taken.features & whole.excludes)) continue;
        taken.features |= whole.features;
        excluded |= whole.excludes;
    }
    if (choice != 1) taken.twist_bones = static_cast<std::uint32_t>(wanted >> kTwistBonesBit) % 8;
    if (taken.twist_bones > 0) taken.features |= SWIVEL_WITH_HAND;
    return taken;
}

swivel_features feature_of_bit(std::uint32_t bit)
{
    swivel_feature_info info;
    for (std::uint32_t n = 0; swivel_describe_feature(n, &info); ++n)
        if (seed_bit(n) == bit) return info.feature;
    return swivel_features{1} << 63;
}

const swivel_region* region_of(Bytes& bytes, swivel_features features)
{
    static const std::vector<swivel_region> regions = [] {
        std::vector<swivel_region> made(16, swivel_default_region());
        Random random{16};
        const auto cone = [&] {
            return swivel_region_cone{{random.share(), random.share(), random.share()},
                                      0.05f + std::abs(random.share())};
        };
        for (swivel_region& region : made) {
            const swivel_region_cone cones[] = {cone(), cone(), cone()};
            const float corners[9] = {1, 0.1f * random.share(), 0, 0, 1, 0.1f * random.share(), 0, 0, 1};
            swivel_region_add_cones(&region, cones, 1 + random.below(3), random.below(2));
            if (random.below(2)) swivel_region_add_polygon(&region, corners, 3);
            if (random.below(2)) swivel_region_forbid(&region, &cones[random.below(3)]);
        }
        return made;
    }();
    if (!(features & SWIVEL_WITH_REGION)) return nullptr;
    return &regions[bytes.below(static_cast<std::uint32_t>(regions.size()))];
}

std::vector<swivel_limb_def> limb_defs_of(Bytes& bytes, std::uint32_t max_limbs)
{
    std::vector<swivel_limb_def> groups(1 + bytes.take<std::uint8_t>() % 3);
    LimbFeatures of_first;
    for (swivel_limb_def& group : groups) {
        group = swivel_default_limb_def(1 + bytes.take<std::uint8_t>() % max_limbs);
        const bool is_first = &group == groups.data();
        const LimbFeatures own = is_first || bytes.one_in(2) ? features_of(bytes, SWIVEL_KIND_LIMB) : of_first;
        if (is_first) of_first = own;
        group.features = own.features;
        group.twist_bone_count = own.twist_bones;
        group.shoulder_order = static_cast<swivel_euler_order>(bytes.below(6));
        group.wrist_order = static_cast<swivel_euler_order>(bytes.below(6));
        if (bytes.one_in(2)) group.on_bad_input = SWIVEL_KEEP_POSE;
        group.binding = binding_of({bytes.take<std::uint16_t>()});
        group.region = region_of(bytes, group.features);
        if (group.features & SWIVEL_POLE_HALF_LINE && bytes.one_in(2)) group.pole_behind[bytes.below(2)] = 1;
    }
    return groups;
}

void make_value(Random& random, swivel_field field, std::uint32_t kind, std::span<float> value)
{
    if (kind % 8 < 7) {
        make_ordinary(random, field, value);
        if (kind % 8 == 6)
            for (float& x : value)
                if (random.below(4) == 0) x = hard_number(random);
    } else {
        for (float& x : value) x = std::bit_cast<float>(static_cast<std::uint32_t>(random.bits()));
    }
}

void put_value(Random& random, swivel_field field, std::uint32_t kind, std::size_t count, char* at,
               std::size_t number_bytes, double wide)
{
    std::array<float, 28> value{};  // of seven twist bones, the most that a field has
    make_value(random, field, kind, std::span(value).first(count));
    for (std::size_t n = 0; n < count; ++n) {
        const double far = wide * double{value[n]};
        std::memcpy(at + n * number_bytes, number_bytes == sizeof far ? static_cast<const void*>(&far) : &value[n],
                    number_bytes);
    }
}

void put_place(Random& random, bool any_bits, char* at)
{
    for (std::size_t c = 0; c < 3; ++c) {
        const double x = any_bits ? std::bit_cast<double>(random.bits()) : 1e6 + double{random.share()};
        std::memcpy(at + c * sizeof x, &x, sizeof x);
    }
}

swivel_field_info described(swivel_field field)
{
    swivel_field_info info = {};
    for (std::uint32_t n = 0; swivel_describe_field(n, &info); ++n)
        if (info.field == field) return info;
    info = {};
    info.range = "";
    return info;
}

void fill_inputs(Bytes& bytes, swivel_crowd& crowd)
{
    for (std::uint32_t group = 0; group < swivel_group_count(&crowd); ++group) {
        const swivel_rows rows = swivel_input_rows(&crowd, group);
        const std::uint32_t limbs = rows.block_count * SWIVEL_LANES;
        for (int f = 0; f < SWIVEL_INPUT_END; ++f) {
            const auto field = static_cast<swivel_field>(f);
            const std::uint32_t count = swivel_field_row_count(&crowd, group, field);
            if (count == 0) continue;
            const std::uint32_t first_row = swivel_field_first_row(&crowd, group, field),
                                kind = bytes.take<std::uint8_t>();
            Random random{bytes.take<std::uint16_t>()};
            std::array<float, 12> value{};
            for (std::uint32_t limb = 0; limb < limbs; ++limb) {
                make_value(random, field, kind, std::span(value).first(count));
                for (std::uint32_t c = 0; c < count; ++c) number_at(rows, limb, first_row + c) = value[c];
            }
        }
        for (std::uint32_t n = bytes.take<std::uint8_t>() % 32; n > 0; --n) {
            const std::uint32_t limb = bytes.take<std::uint8_t>() % limbs;
            number_at(rows, limb, bytes.take<std::uint8_t>() % rows.row_count) = bytes.any_float();
        }
    }
}

}  // namespace swivel::fuzz
