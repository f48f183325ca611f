// SPDX-License-Identifier: MIT
#include "batch/streams.h"

#include "simd/rows.h"
#include "simd/transpose.h"

namespace swivel {

namespace {

// Calls copy.one() or copy.four() with the place of the first component in the rows and the number of the first limb.
template <class Copy>
void for_each_limb(const RowSpan& rows, const Copy& copy)
{
    const auto lane = [&](std::size_t n) {
        return rows.base + row_offset(rows.first_limb + n, rows.row_count, rows.first_row);
    };
    std::size_t n = 0;
    for (; n < rows.limb_count && (rows.first_limb + n) % 4 != 0; ++n) copy.one(lane(n), n);
    for (; n + 4 <= rows.limb_count; n += 4) copy.four(lane(n), n);
    for (; n < rows.limb_count; ++n) copy.one(lane(n), n);
}

template <int C>
struct In {
    const char* data;
    std::size_t stride;

    void one(float* lane, std::size_t n) const { value_to_rows<C>(data + n * stride, lane); }
    void four(float* lanes, std::size_t n) const { four_values_to_rows<C>(data + n * stride, stride, lanes); }
};

template <int C>
struct Out {
    char* data;
    std::size_t stride;

    void one(const float* lane, std::size_t n) const { value_from_rows<C>(lane, data + n * stride); }
    void four(const float* lanes, std::size_t n) const { four_values_from_rows<C>(lanes, data + n * stride, stride); }
};

template <template <int> class Copy, class Byte>
void copy(const RowSpan& rows, Byte* data, std::size_t stride)
{
    switch (rows.component_count) {
        case 1:
            return for_each_limb(rows, Copy<1>{data, stride});
        case 2:
            return for_each_limb(rows, Copy<2>{data, stride});
        case 3:
            return for_each_limb(rows, Copy<3>{data, stride});
        case 4:
            return for_each_limb(rows, Copy<4>{data, stride});
    }
}

}  // namespace

RowSpan span_of(const swivel_crowd& crowd, const Group& group, swivel_field field, std::uint32_t first,
                std::uint32_t limb_count)
{
    const bool input = is_input(field);
    return {input ? crowd.input : crowd.results,
            input ? crowd.input_row_count : crowd.result_row_count,
            field_first_row(crowd.features, field),
            field_row_count(crowd.features, field),
            std::size_t{group.first_block} * SWIVEL_LANES + first,
            limb_count};
}

void copy_in(const RowSpan& rows, const swivel_in& values)
{
    copy<In>(rows, static_cast<const char*>(values.data), values.stride);
}

void copy_out(const RowSpan& rows, const swivel_out& values)
{
    copy<Out>(rows, static_cast<char*>(values.data), values.stride);
}

}  // namespace swivel
