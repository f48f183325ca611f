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

void write_group(Crowd& crowd, std::uint32_t features, std::uint32_t group, Random& random)
{
    const std::uint32_t count = swivel_group_limb_count(crowd.get(), group);
    crowd.write(SWIVEL_TARGET, group, numbers<3>(random, count, 2));
    crowd.write(SWIVEL_POLE, group, numbers<3>(random, count, 2));
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
}

}  // namespace

bool is_feature_set(std::uint32_t features) { return !(features & SWIVEL_POLE_DIRECTION) || (features & SWIVEL_WORLD); }

Crowd golden_crowd(std::uint32_t features, std::uint32_t limb_count)
{
    const swivel_group_def groups[] = {
        {limb_count, binding_of(0)}, {limb_count / 2 + 1, binding_of(1)}, {7, binding_of(2)}};
    Crowd crowd(features, groups);
    Random random{features};
    for (std::uint32_t group = 0; group < 3; ++group) write_group(crowd, features, group, random);
    return crowd;
}

std::uint64_t digest(const Crowd& crowd, std::uint64_t hash)
{
    for (const swivel_field field : {SWIVEL_SHOULDER, SWIVEL_ELBOW, SWIVEL_WRIST, SWIVEL_FLAGS}) {
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
