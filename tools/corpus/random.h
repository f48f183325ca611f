// SPDX-License-Identifier: MIT
//
// Random numbers of the corpus: integers and exact conversions, so the same numbers on every machine.
#pragma once

#include <cstdint>
#include <string_view>

#include "swivel/swivel.hpp"

namespace swivel::corpus {

// SplitMix64 (Steele, Lea, Flood, 2014).
struct Random {
    std::uint64_t state;

    std::uint64_t bits()
    {
        std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(bits() >> 32) % n; }
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }  // in [0, 1)
    double between(double a, double b) { return a + (b - a) * unit(); }
    double signed_unit() { return between(-1, 1); }
    // From 2^min to 2^max, every power of two as likely as the others.
    double spread(int min, int max)
    {
        const int power = min + static_cast<int>(below(static_cast<std::uint32_t>(max - min)));
        double size = 1 + unit();
        for (int n = 0; n < power; ++n) size *= 2;
        for (int n = 0; n > power; --n) size /= 2;
        return size;
    }
};

// FNV-1a (64 bits).
inline constexpr std::uint64_t kDigestStart = 0xcbf29ce484222325u;
constexpr std::uint64_t add_byte(std::uint64_t hash, std::uint64_t byte) { return (hash ^ byte) * 0x100000001b3u; }
constexpr std::uint64_t hash_of(std::string_view text)
{
    std::uint64_t hash = kDigestStart;
    for (const char c : text) hash = add_byte(hash, static_cast<unsigned char>(c));
    return hash;
}

// The purpose that the numbers of a field are drawn for.
enum class Use : std::uint32_t { value = 0, spoil = 1 };

// Each field of each group draws from its own stream, seeded by its name. So its numbers do not depend on a crowd's
// other inputs and fields. Other data of bodies, such as "skeleton" and "motion", draws by names of the corpus.
// frame: 0, except for values that are new in each frame.
inline Random stream(std::uint64_t seed, std::uint32_t group, std::string_view name, Use use, std::uint32_t frame)
{
    const std::uint64_t place =
        (std::uint64_t{frame} << 32) | (static_cast<std::uint64_t>(use) << 24) | std::uint64_t{group};
    Random key{hash_of(name) ^ place};
    return {Random{seed ^ key.bits()}.bits()};
}
inline Random stream(std::uint64_t seed, std::uint32_t group, swivel_field field, Use use, std::uint32_t frame)
{
    return stream(seed, group, describe(field).name, use, frame);
}

}  // namespace swivel::corpus
