// SPDX-License-Identifier: MIT
//
// Copies between rows and the caller's strided data, 4 bytes a component, bit for bit; positions from doubles, too.
#pragma once

#include "batch/crowd.h"

namespace swivel {

// A field's rows in the blocks of one group. Not for packed results (unpack.h).
struct FieldRows {
    float* base;              // lane 0 of its first row in the group's first block
    std::uint32_t row_count;  // of a block
    std::uint32_t component_count;
};
FieldRows rows_of(const swivel_crowd& crowd, const Group& group, Field field);

// Values of limbs first ... first + limb_count - 1 of the group; data is limb first's.
void copy_in(const FieldRows& rows, std::size_t first, std::size_t limb_count, swivel_in values);
// The same from 3 doubles each. The limb's origin is subtracted, unless the data of origins is null. They are rounded
// in the floating-point environment that the caller has set (FloatEnv).
void copy_doubles_in(const FieldRows& rows, std::size_t first, std::size_t limb_count, swivel_in values,
                     swivel_in origins);
void copy_out(const FieldRows& rows, std::size_t first, std::size_t limb_count, swivel_out values);

}  // namespace swivel
