// SPDX-License-Identifier: MIT
#include "tools/swivel/golden_crowd.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace swivel::tools {

namespace {

// SplitMix64 (Steele, Lea, Flood, 2014): integers and exact conversions, so the same floats everywhere.
struct Random {
    std::uint64_t state;

    std::uint64_t bits()
    {
        std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    float signed_unit() { return static_cast<float>(static_cast<std::int32_t>(bits() >> 40) - (1 << 23)) * 0x1p-23f; }
    std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(bits() >> 32) % n; }
};

// Numbers at which formulas break: one in sixteen components, in every other run of 64 limbs. The runs between are
// ordinary arms alone, for which kernels take a shorter way.
float number(Random& random, std::uint32_t limb, float size)
{
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    const float hard[] = {0.0f,  -0.0f,  1e-15f, -3e-12f, 1e-38f, 1e-45f, 1.0f, -1.0f,
                          1e15f, -1e15f, 2e15f,  3e38f,   nan,    inf,    -inf, 0.5f};
    if (limb / 64 % 2 == 0 && random.below(16) == 0) return hard[random.below(16)];
    return size * random.signed_unit();
}

template <std::size_t N>
std::vector<std::array<float, N>> numbers(Random& random, std::uint32_t count, float size)
{
    std::vector<std::array<float, N>> values(count);
    for (std::uint32_t limb = 0; limb < count; ++limb)
        for (float& x : values[limb]) x = number(random, limb, size);
    return values;
}

swivel_binding binding_of(std::uint32_t group)
{
    const float side = group == 0 ? 1.0f : -1.0f;
    swivel_chain chain{};
    chain.shoulder_rotation[2] = 0.6f;
    chain.shoulder_rotation[3] = 0.8f;
    chain.elbow_rotation[1] = group == 2 ? 0.28f : 0.0f;
    chain.elbow_rotation[3] = group == 2 ? 0.96f : 1.0f;
    chain.wrist_rotation[0] = -0.8f;
    chain.wrist_rotation[3] = 0.6f;
    chain.elbow_offset[0] = side * 5;
    chain.wrist_offset[0] = side * 4;
    if (group != 2) chain.hinge[1] = side;
    return bind(chain).binding;
}

// Pairs scaled to unit length, as cosine and sine; what cannot be stays bad. upper: with a sine of 0 or more.
void make_turn(float* pair, bool upper)
{
    const float length = std::sqrt(pair[0] * pair[0] + pair[1] * pair[1]);
    if (upper) pair[1] = std::fabs(pair[1]);
    if (length > 0) pair[0] /= length, pair[1] /= length;
}
void make_unit(float* v)
{
    const float length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int n = 0; n < 3; ++n) v[n] /= length;
}

template <std::size_t N, class Shape>
void write_shaped(Crowd& crowd, std::uint32_t group, swivel_field field, Random& random, Shape shape)
{
    if (swivel_field_row_count(crowd.get(), field) == 0) return;
    auto values = numbers<N>(random, swivel_group_limb_count(crowd.get(), group), 1);
    for (auto& value : values) shape(value.data());
    crowd.write(field, group, values);
}

// What whole limbs have beside: numbers of the shape that is asked for, except where they are hard.
void write_limb(Crowd& crowd, std::uint32_t group, Random& random)
{
    const auto as_they_are = [](float*) {};
    const auto range = [](float* x) { make_turn(x, false), make_turn(x + 2, true); };
    const auto box = [&](float* x) { range(x), range(x + 4), range(x + 8); };
    write_shaped<3>(crowd, group, SWIVEL_EFFECTOR, random, [](float* x) { x[0] *= 0.25f; });
    write_shaped<2>(crowd, group, SWIVEL_ANGLE, random, as_they_are);
    for (const swivel_field q : {SWIVEL_INCOMING_SHOULDER, SWIVEL_INCOMING_ELBOW, SWIVEL_INCOMING_WRIST})
        write_shaped<4>(crowd, group, q, random, as_they_are);
    write_shaped<3>(crowd, group, SWIVEL_WEIGHTS, random, [](float* x) {
        for (int n = 0; n < 3; ++n) x[n] = std::fabs(x[n]);
    });
    write_shaped<4>(crowd, group, SWIVEL_REACH, random, [](float* x) {
        for (int n = 0; n < 4; ++n) x[n] = std::fabs(x[n]) * 0.25f;
        x[2] += 1;
    });
    write_shaped<2>(crowd, group, SWIVEL_MOST_SWIVEL, random, [](float* x) { make_turn(x, true); });
    write_shaped<2>(crowd, group, SWIVEL_FLEXION_LIMIT, random,
                    [](float* x) { x[0] = 0.5f + 0.5f * std::fabs(x[0]), x[1] = 0.5f * std::fabs(x[1]); });
    for (const swivel_field cone : {SWIVEL_SHOULDER_CONE, SWIVEL_HAND_CONE})
        write_shaped<4>(crowd, group, cone, random, make_unit);
    for (const swivel_field twist : {SWIVEL_HUMERAL_TWIST, SWIVEL_FOREARM_TWIST})
        write_shaped<4>(crowd, group, twist, random, range);
    write_shaped<7>(crowd, group, SWIVEL_HAND_TWIST, random, [&](float* x) { make_unit(x), range(x + 3); });
    write_shaped<5>(crowd, group, SWIVEL_AIM, random,
                    [](float* x) { make_unit(x), x[3] = std::fabs(x[3]), make_turn(x + 3, true); });
    write_shaped<4>(crowd, group, SWIVEL_CLAVICLE, random, [](float* x) { x[3] = std::fabs(x[3]); });
    for (const swivel_field b : {SWIVEL_SHOULDER_BOX, SWIVEL_WRIST_BOX}) write_shaped<12>(crowd, group, b, random, box);
}

void write_group(Crowd& crowd, std::uint32_t features, std::uint32_t group, Random& random)
{
    const std::uint32_t count = swivel_group_limb_count(crowd.get(), group);
    crowd.write(SWIVEL_TARGET, group, numbers<3>(random, count, 2));
    if (!(features & SWIVEL_POLE_INCOMING)) crowd.write(SWIVEL_POLE, group, numbers<3>(random, count, 2));
    auto lengths = numbers<2>(random, count, 1);
    for (std::uint32_t limb = 0; limb < count; ++limb)
        for (float& length : lengths[limb])
            length = limb / 64 % 2 == 0 && random.below(64) == 0 ? length : std::fabs(length) + 0.25f;
    crowd.write(SWIVEL_LENGTHS, group, lengths);
    if (features & SWIVEL_WORLD) {
        crowd.write(SWIVEL_PARENT_POSITION, group, numbers<3>(random, count, 1));
        crowd.write(SWIVEL_PARENT_ROTATION, group, numbers<4>(random, count, 1));
        auto scales = numbers<1>(random, count, 1);
        for (auto& scale : scales) scale[0] = std::fabs(scale[0]) + 0.5f;
        crowd.write(SWIVEL_PARENT_SCALE, group, scales);
    }
    if (features & SWIVEL_WITH_HAND) crowd.write(SWIVEL_HAND, group, numbers<4>(random, count, 1));
    write_limb(crowd, group, random);
}

}  // namespace

bool is_feature_set(std::uint32_t features) { return !(features & SWIVEL_POLE_DIRECTION) || (features & SWIVEL_WORLD); }

Crowd golden_crowd(std::uint32_t features, std::uint32_t limb_count)
{
    const swivel_group_def groups[] = {
        {limb_count, binding_of(0)}, {limb_count / 2 + 1, binding_of(1)}, {7, binding_of(2)}};
    swivel_crowd_def def = swivel_default_crowd_def();
    def.features = features;
    def.groups = groups;
    def.group_count = 3;
    def.shoulder_order = SWIVEL_YXZ;
    def.wrist_order = SWIVEL_ZXY;
    Crowd crowd(def);
    Random random{features};
    for (std::uint32_t group = 0; group < 3; ++group) write_group(crowd, features, group, random);
    return crowd;
}

void write_golden_targets(Crowd& crowd, std::uint64_t seed)
{
    Random random{~seed};
    for (std::uint32_t group = 0; group < 3; ++group) {
        const std::uint32_t count = swivel_group_limb_count(crowd.get(), group);
        crowd.write(SWIVEL_TARGET, group, numbers<3>(random, count, 2));
        if (swivel_field_row_count(crowd.get(), SWIVEL_POLE))
            crowd.write(SWIVEL_POLE, group, numbers<3>(random, count, 2));
    }
}

std::uint64_t digest(const Crowd& crowd, std::uint64_t hash)
{
    for (int f = SWIVEL_SHOULDER; f < SWIVEL_FIELD_COUNT; ++f) {
        const auto field = static_cast<swivel_field>(f);
        const std::uint32_t rows = swivel_field_row_count(crowd.get(), field);
        for (std::uint32_t group = 0; rows != 0 && group < 3; ++group) {
            const std::uint32_t count = swivel_group_limb_count(crowd.get(), group);
            std::vector<std::uint32_t> words(std::size_t{count} * rows);
            check(swivel_read(crowd.get(), field, group, 0, count, {words.data(), rows * sizeof(std::uint32_t)}));
            for (const std::uint32_t word : words)
                for (int byte = 0; byte < 4; ++byte) hash = (hash ^ (word >> (8 * byte) & 0xffu)) * 0x100000001b3u;
        }
    }
    return hash;
}

}  // namespace swivel::tools
