// SPDX-License-Identifier: MIT
#include "batch/crowd/streams.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "simd/rows.h"
#include "simd/transpose.h"

namespace swivel {

namespace {

template <std::size_t C>
struct In {
    using Byte = const char;
    static void four(const char* values, std::size_t stride, float* lanes)
    {
        four_values_to_rows<C>(values, stride, lanes);
    }
    static void one(const char* value, float* lane) { value_to_rows<C>(value, lane); }
};

template <std::size_t C>
struct Out {
    using Byte = char;
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

// Goes block by block, because a block's lanes lie side by side. Whole blocks take the short loop, which must not be
// unrolled: unrolled loads are too far apart for the CPU's prefetcher.
template <class Copy>
void copy_blocks(const Stream& stream, std::size_t first, std::size_t limb_count)
{
    const std::size_t stride = stream.stride, step = stream.block_floats, lane = first % SWIVEL_LANES;
    typename Copy::Byte* values = stream.values + (first - stream.values_first) * stride;
    float* block = stream.rows + first / SWIVEL_LANES * step;
    if (lane > 0) {
        const std::size_t count = std::min(limb_count, SWIVEL_LANES - lane);
        copy_lanes<Copy>(block + lane, count, values, stride);
        block += step, limb_count -= count, values += count * stride;
    }
    for (; limb_count >= SWIVEL_LANES; limb_count -= SWIVEL_LANES, block += step)
#pragma GCC unroll 1
        for (std::size_t n = 0; n < SWIVEL_LANES; n += 4, values += 4 * stride) Copy::four(values, stride, block + n);
    if (limb_count > 0) copy_lanes<Copy>(block, limb_count, values, stride);
}

void copy_doubles(const Stream& stream, std::size_t first, std::size_t limb_count)
{
    const std::size_t stride = stream.stride, origin_stride = stream.origin_stride,
                      skipped = first - stream.values_first;
    const char *value = stream.values + skipped * stride, *origin = stream.origin + skipped * origin_stride;
    // One component of a few limbs, so that differences are rounded and stored together.
    const auto copy_lanes = [&](float* lane, auto count) {
        for (std::size_t c = 0; c < 3; ++c) {
            double at[count], from[count];
            for (std::size_t k = 0; k < count; ++k) {
                std::memcpy(at + k, value + k * stride + c * sizeof(double), sizeof(double));
                std::memcpy(from + k, origin + k * origin_stride + c * sizeof(double), sizeof(double));
            }
            for (std::size_t k = 0; k < count; ++k) lane[c * SWIVEL_LANES + k] = static_cast<float>(at[k] - from[k]);
        }
        value += count * stride, origin += count * origin_stride;
    };
    for (std::size_t limb = first, end = first + limb_count; limb < end;) {
        float* const lane = stream.rows + limb / SWIVEL_LANES * stream.block_floats + limb % SWIVEL_LANES;
        if (limb % 4 == 0 && limb + 4 <= end) {
            copy_lanes(lane, std::integral_constant<std::size_t, 4>());
            limb += 4;
        } else {
            copy_lanes(lane, std::integral_constant<std::size_t, 1>());
            ++limb;
        }
    }
}

// The max number of a field's streams.
constexpr std::uint32_t kMaxFieldStreams = stream_count(field_row_count(kEveryFeature, SWIVEL_TWIST_BONES));

// Streams in only read the caller's values.
char* bytes_of(swivel_in values) { return static_cast<char*>(const_cast<void*>(values.data)); }

// Long values go four components at a time.
template <template <std::size_t> class Copy>
Stream* streams(FieldRows rows, std::size_t first, char* values, std::size_t stride, Stream* to)
{
    constexpr decltype(Stream::run) run[] = {copy_blocks<Copy<1>>, copy_blocks<Copy<2>>, copy_blocks<Copy<3>>,
                                             copy_blocks<Copy<4>>};
    for (std::uint32_t c = 0; c < rows.component_count; c += 4)
        *to++ = {run[std::min(rows.component_count - c, 4u) - 1],
                 rows.base + c * SWIVEL_LANES,
                 std::size_t{rows.row_count} * SWIVEL_LANES,
                 values + c * sizeof(float),
                 stride,
                 first,
                 nullptr,
                 0};
    return to;
}

}  // namespace

FieldRows rows_of(const Group& group, swivel_field field)
{
    const bool input = is_input(field);
    float* const base = input ? group.input : group.results;
    return {base + row_offset(0, 0, group.first_row[index_of(field)]),
            input ? group.input_row_count : group.result_row_count, field_row_count(group.features, field)};
}

Stream* streams_in(const FieldRows& rows, std::size_t first, swivel_in values, Stream* to)
{
    return streams<In>(rows, first, bytes_of(values), values.stride, to);
}

Stream* streams_of_doubles(const FieldRows& rows, std::size_t first, swivel_in values, swivel_in origins, Stream* to)
{
    static constexpr double nowhere[3] = {0, 0, 0};
    *to++ = {copy_doubles,
             rows.base,
             std::size_t{rows.row_count} * SWIVEL_LANES,
             bytes_of(values),
             values.stride,
             first,
             static_cast<const char*>(origins.data ? origins.data : nowhere),
             origins.data ? origins.stride : 0};
    return to;
}

Stream* streams_out(const FieldRows& rows, std::size_t first, swivel_out values, Stream* to)
{
    return streams<Out>(rows, first, static_cast<char*>(values.data), values.stride, to);
}

void copy(const Stream* stream, const Stream* end, std::size_t first, std::size_t limb_count)
{
    for (; stream != end; ++stream) stream->run(*stream, first, limb_count);
}

void copy_in(const FieldRows& rows, std::size_t first, std::size_t limb_count, swivel_in values)
{
    if (limb_count == 0) return;  // there may be no values
    Stream all[kMaxFieldStreams];
    copy(all, streams_in(rows, first, values, all), first, limb_count);
}

void copy_doubles_in(const FieldRows& rows, std::size_t first, std::size_t limb_count, swivel_in values,
                     swivel_in origins)
{
    Stream one;
    copy(&one, streams_of_doubles(rows, first, values, origins, &one), first, limb_count);
}

void copy_out(const FieldRows& rows, std::size_t first, std::size_t limb_count, swivel_out values)
{
    if (limb_count == 0) return;  // there may be no values
    Stream all[kMaxFieldStreams];
    copy(all, streams_out(rows, first, values, all), first, limb_count);
}

}  // namespace swivel
