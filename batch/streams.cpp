// SPDX-License-Identifier: MIT
#include "batch/streams.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "simd/rows.h"
#include "simd/transpose.h"

namespace swivel {

namespace {

template <std::size_t C>
struct In {
    static void four(const char* values, std::size_t stride, float* lanes)
    {
        four_values_to_rows<C>(values, stride, lanes);
    }
    static void one(const char* value, float* lane) { value_to_rows<C>(value, lane); }
};

template <std::size_t C>
struct Out {
    static void four(char* values, std::size_t stride, const float* lanes)
    {
        four_values_from_rows<C>(lanes, values, stride);
    }
    static void one(char* value, const float* lane) { value_from_rows<C>(lane, value); }
};

// Limbs of one block, from any lane on.
template <class Copy, class Byte>
void copy_lanes(float* lanes, std::size_t limb_count, Byte* values, std::size_t stride)
{
    for (; limb_count >= 4; limb_count -= 4, lanes += 4, values += 4 * stride) Copy::four(values, stride, lanes);
    for (; limb_count > 0; --limb_count, ++lanes, values += stride) Copy::one(values, lanes);
}

// Block by block, since the lanes of one block lie side by side. Whole ones are copied without a loop.
template <class Copy, class Byte>
void copy_blocks(const FieldRows& rows, std::size_t first, std::size_t limb_count, Byte* values, std::size_t stride)
{
    const std::size_t step = std::size_t{rows.row_count} * SWIVEL_LANES, lane = first % SWIVEL_LANES;
    float* block = rows.base + first / SWIVEL_LANES * step;
    if (lane > 0) {
        const std::size_t count = std::min(limb_count, SWIVEL_LANES - lane);
        copy_lanes<Copy>(block + lane, count, values, stride);
        block += step, limb_count -= count, values += count * stride;
    }
    for (; limb_count >= SWIVEL_LANES; limb_count -= SWIVEL_LANES, block += step)
        for (std::size_t n = 0; n < SWIVEL_LANES; n += 4, values += 4 * stride) Copy::four(values, stride, block + n);
    copy_lanes<Copy>(block, limb_count, values, stride);
}

// Long values go four components at a time.
template <template <std::size_t> class Copy, class Byte>
void copy(FieldRows rows, std::size_t first, std::size_t limb_count, Byte* values, std::size_t stride)
{
    for (; rows.component_count > 4; rows.component_count -= 4, rows.base += 4 * SWIVEL_LANES, values += 16)
        copy_blocks<Copy<4>>(rows, first, limb_count, values, stride);
    switch (rows.component_count) {
        case 1:
            return copy_blocks<Copy<1>>(rows, first, limb_count, values, stride);
        case 2:
            return copy_blocks<Copy<2>>(rows, first, limb_count, values, stride);
        case 3:
            return copy_blocks<Copy<3>>(rows, first, limb_count, values, stride);
        case 4:
            return copy_blocks<Copy<4>>(rows, first, limb_count, values, stride);
    }
}

}  // namespace

FieldRows rows_of(const swivel_crowd& crowd, const Group& group, Field field)
{
    const bool input = is_input(field);
    const std::uint32_t row_count = input ? crowd.input_row_count : crowd.result_row_count;
    const std::size_t offset =
        row_offset(std::size_t{group.first_block} * SWIVEL_LANES, row_count, crowd.first_row[index_of(field)]);
    return {(input ? crowd.input : crowd.results) + offset, row_count, field_row_count(crowd.features, field)};
}

void copy_in(const FieldRows& rows, std::size_t first, std::size_t limb_count, swivel_in values)
{
    copy<In>(rows, first, limb_count, static_cast<const char*>(values.data), values.stride);
}

void copy_doubles_in(const FieldRows& rows, std::size_t first, std::size_t limb_count, swivel_in values,
                     swivel_in origins)
{
    constexpr double nowhere[3] = {0, 0, 0};
    const char* const origin = static_cast<const char*>(origins.data ? origins.data : nowhere);
    const std::size_t origin_stride = origins.data ? origins.stride : 0;
    const char* const value = static_cast<const char*>(values.data);
    float* const base = rows.base;  // the compiler cannot know that values do not overlap `rows`
    const std::uint32_t row_count = rows.row_count;
    // One component of a few limbs, so that differences are rounded and stored together.
    const auto copy_lanes = [&](std::size_t n, auto count) {
        float* const lane = base + row_offset(first + n, row_count, 0);
        for (std::size_t c = 0; c < 3; ++c) {
            double at[count], from[count];
            for (std::size_t k = 0; k < count; ++k) {
                std::memcpy(at + k, value + (n + k) * values.stride + c * sizeof(double), sizeof(double));
                std::memcpy(from + k, origin + (n + k) * origin_stride + c * sizeof(double), sizeof(double));
            }
            for (std::size_t k = 0; k < count; ++k) lane[c * SWIVEL_LANES + k] = static_cast<float>(at[k] - from[k]);
        }
    };
    for (std::size_t n = 0; n < limb_count;) {
        if ((first + n) % 4 == 0 && n + 4 <= limb_count) {
            copy_lanes(n, std::integral_constant<std::size_t, 4>());
            n += 4;
        } else {
            copy_lanes(n++, std::integral_constant<std::size_t, 1>());
        }
    }
}

void copy_out(const FieldRows& rows, std::size_t first, std::size_t limb_count, swivel_out values)
{
    copy<Out>(rows, first, limb_count, static_cast<char*>(values.data), values.stride);
}

}  // namespace swivel
