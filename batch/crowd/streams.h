// SPDX-License-Identifier: MIT
//
// Copies between rows and the caller's strided data, 4 bytes a component, bit for bit; positions from doubles, too.
#pragma once

#include <cstring>

#include "batch/crowd/crowd.h"

namespace swivel {

// Value n of the caller's.
template <class Value>
Value value_at(const swivel_in& values, std::size_t n)
{
    Value value;
    std::memcpy(&value, static_cast<const char*>(values.data) + n * values.stride, sizeof value);
    return value;
}

// A field's rows in the blocks of one group.
struct FieldRows {
    float* base;              // lane 0 of its first row in the group's first block
    std::uint32_t row_count;  // of a block
    std::uint32_t component_count;
};
FieldRows rows_of(const Group& group, swivel_field field);

// Copies up to four components of a field between rows and values. `run` is its loop, chosen once.
struct Stream {
    void (*run)(const Stream& stream, std::size_t first, std::size_t limb_count);
    float* rows;               // lane 0 of the first component's row in the group's first block
    std::size_t block_floats;  // from block to block
    char* values;              // written by streams_out() only
    std::size_t stride;
    std::size_t values_first;  // the limb of the first value, counted within the group
    const char* origin;        // of the same limb, for doubles
    std::size_t origin_stride;
};

// Stores the streams of all components of a field at `to`, and returns their end. values, origins: from limb `first`
// on.
// - streams_in: from floats.
// - streams_of_doubles: from 3 doubles. The limb's origin is subtracted, unless the data of origins is null. They are
//   rounded in the floating-point environment that the caller of copy() has set (FloatEnv).
// - streams_out: to floats.
Stream* streams_in(const FieldRows& rows, std::size_t first, swivel_in values, Stream* to);
Stream* streams_of_doubles(const FieldRows& rows, std::size_t first, swivel_in values, swivel_in origins, Stream* to);
Stream* streams_out(const FieldRows& rows, std::size_t first, swivel_out values, Stream* to);
constexpr std::uint32_t stream_count(std::uint32_t component_count) { return (component_count + 3) / 4; }

// Copies limbs first ... first + limb_count - 1 of the group by each of some streams.
void copy(const Stream* streams, const Stream* end, std::size_t first, std::size_t limb_count);

// Copy a field of limbs first ... first + limb_count - 1 of the group at once.
void copy_in(const FieldRows& rows, std::size_t first, std::size_t limb_count, swivel_in values);
void copy_doubles_in(const FieldRows& rows, std::size_t first, std::size_t limb_count, swivel_in values,
                     swivel_in origins);
void copy_out(const FieldRows& rows, std::size_t first, std::size_t limb_count, swivel_out values);

}  // namespace swivel
