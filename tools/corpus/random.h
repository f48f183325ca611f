// SPDX-License-Identifier: MIT
//
// Random numbers of the corpus: integers and exact conversions, so the same numbers on every machine.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>

#include "tools/corpus/recipe.h"

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
    // In 2^least ... 2^most, every power of two as likely as the others.
    double spread(int min, int max)
    {
        const int power = min + static_cast<int>(below(static_cast<std::uint32_t>(max - min)));
        double size = 1 + unit();
        for (int n = 0; n < power; ++n) size *= 2;
        for (int n = 0; n > power; --n) size /= 2;
        return size;
    }
};

// The purpose that the numbers of a field are drawn for.
enum class Use : std::uint32_t { value = 0, spoil = 1 };

// Each field of each group draws from a stream of its own. So its numbers stay the same whatever else a crowd is given.
// frame: 0, except for values that are new in each frame.
inline Random stream(std::uint64_t seed, std::uint32_t group, Field field, Use use, std::uint32_t frame)
{
    const auto number =
        static_cast<std::uint64_t>(std::find(std::begin(kDrawn), std::end(kDrawn), field) - std::begin(kDrawn)) + 1;
    Random key{(std::uint64_t{frame} << 32) | (static_cast<std::uint64_t>(use) << 24) | (std::uint64_t{group} << 8) |
               number};
    return {Random{seed ^ key.bits()}.bits()};
}

}  // namespace swivel::corpus
