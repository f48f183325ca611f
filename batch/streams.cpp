// SPDX-License-Identifier: MIT
#include "batch/streams.h"

#include <cstring>

#include "simd/rows.h"

namespace swivel {

namespace {

// Calls copy(address of the first component in the rows, limb) for each limb; components are SWIVEL_LANES floats apart.
template <class Copy>
void for_each_limb(const RowSpan& rows, Copy copy)
{
    for (std::size_t n = 0; n < rows.limb_count; ++n)
        copy(rows.base + row_offset(rows.first_limb + n, rows.row_count, rows.first_row), n);
}

}  // namespace

void copy_in(const RowSpan& rows, const swivel_in& values)
{
    const char* const data = static_cast<const char*>(values.data);
    for_each_limb(rows, [&](float* lane, std::size_t n) {
        for (std::uint32_t c = 0; c < rows.component_count; ++c)
            std::memcpy(lane + c * SWIVEL_LANES, data + n * values.stride + c * sizeof(float), sizeof(float));
    });
}

void copy_out(const RowSpan& rows, const swivel_out& values)
{
    char* const data = static_cast<char*>(values.data);
    for_each_limb(rows, [&](const float* lane, std::size_t n) {
        for (std::uint32_t c = 0; c < rows.component_count; ++c)
            std::memcpy(data + n * values.stride + c * sizeof(float), lane + c * SWIVEL_LANES, sizeof(float));
    });
}

}  // namespace swivel
