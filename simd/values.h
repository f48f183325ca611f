// SPDX-License-Identifier: MIT
//
// Values of 3 or 4 floats, as callers keep them, straight into lanes: one load for each value, then transposes in
// registers. No byte beside a value is read. Values may have any alignment.
#pragma once

#include <array>
#include <cstring>
#include <utility>

#include "simd/lanes.h"

namespace swivel::inline SWIVEL_ISA {

// Where the lanes' values start, less an offset that all share.
using LaneValues = const char* const*;

template <class T, std::size_t C>
requires(lane_count<T> == 1) SWIVEL_ALWAYS_INLINE std::array<T, C> load_values(LaneValues lane, std::size_t offset)
{
    std::array<T, C> value;
    std::memcpy(value.data(), lane[0] + offset, sizeof value);
    return value;
}

#ifndef XSIMD_NO_SUPPORTED_ARCHITECTURE

using Four = float __attribute__((vector_size(16)));

template <std::size_t C>
SWIVEL_ALWAYS_INLINE Four load_value(const char* value)
{
    // The first C numbers one by one would go through memory.
    if constexpr (C == 4) {
        Four four;
        std::memcpy(&four, value, sizeof four);
        return four;
    } else {
        float x, y, z;
        std::memcpy(&x, value, sizeof x);
        std::memcpy(&y, value + sizeof x, sizeof y);
        std::memcpy(&z, value + 2 * sizeof x, sizeof z);
        return Four{x, y, z, 0};
    }
}
// Two registers as one of twice the lanes.
template <class V, std::size_t... N>
SWIVEL_ALWAYS_INLINE auto joined(V low, V high, std::index_sequence<N...>)
{
    return __builtin_shufflevector(low, high, N...);
}
// Within each four lanes: a0 b0 a1 b1, or a2 b2 a3 b3.
template <std::size_t from, class V, std::size_t... N>
SWIVEL_ALWAYS_INLINE V zipped(V a, V b, std::index_sequence<N...>)
{
    return __builtin_shufflevector(a, b, (N / 4 * 4 + N % 4 / 2 + from + (N % 2) * sizeof...(N))...);
}
// Within each four lanes: a0 a1 b0 b1, or a2 a3 b2 b3.
template <std::size_t from, class V, std::size_t... N>
SWIVEL_ALWAYS_INLINE V paired(V a, V b, std::index_sequence<N...>)
{
    return __builtin_shufflevector(a, b, (N / 4 * 4 + N % 2 + from + (N % 4 / 2) * sizeof...(N))...);
}

// The values of lanes k, k + 4, ... side by side.
template <std::size_t width, std::size_t C>
SWIVEL_ALWAYS_INLINE auto every_fourth(LaneValues lane, std::size_t offset)
{
    if constexpr (width == 4) {
        return load_value<C>(lane[0] + offset);
    } else {
        constexpr std::size_t half = width / 2;
        return joined(every_fourth<half, C>(lane, offset), every_fourth<half, C>(lane + half, offset),
                      std::make_index_sequence<width>{});
    }
}

template <class T, std::size_t C>
requires(lane_count<T> > 1) SWIVEL_ALWAYS_INLINE std::array<T, C> load_values(LaneValues lane, std::size_t offset)
{
    constexpr std::size_t width = T::width;
    static_assert(lane_count<T> == width && (C == 3 || C == 4));
    constexpr auto lanes = std::make_index_sequence<width>{};
    const auto a = every_fourth<width, C>(lane, offset), b = every_fourth<width, C>(lane + 1, offset),
               c = every_fourth<width, C>(lane + 2, offset), d = every_fourth<width, C>(lane + 3, offset);
    const auto ab = zipped<0>(a, b, lanes), cd = zipped<0>(c, d, lanes);
    const auto ab_high = zipped<2>(a, b, lanes), cd_high = zipped<2>(c, d, lanes);
    using Register = typename T::Register;
    std::array<T, C> value;
    value[0] = T((Register)paired<0>(ab, cd, lanes));
    value[1] = T((Register)paired<2>(ab, cd, lanes));
    value[2] = T((Register)paired<0>(ab_high, cd_high, lanes));
    if constexpr (C == 4) value[3] = T((Register)paired<2>(ab_high, cd_high, lanes));
    return value;
}

#endif

}  // namespace swivel::inline SWIVEL_ISA
