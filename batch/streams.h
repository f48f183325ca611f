// SPDX-License-Identifier: MIT
//
// Copies between rows and the caller's strided data, 4 bytes a component, bit for bit.
#pragma once

#include "batch/crowd.h"

namespace swivel {

struct RowSpan {
    float* base;                               // input or result rows of the crowd
    std::uint32_t row_count;                   // of a block
    std::uint32_t first_row, component_count;  // the field
    std::size_t first_limb, limb_count;
};

// The field's rows of limbs first ... first + limb_count - 1 of the group.
RowSpan span_of(const swivel_crowd& crowd, const Group& group, swivel_field field, std::uint32_t first,
                std::uint32_t limb_count);

void copy_in(const RowSpan& rows, const swivel_in& values);
void copy_out(const RowSpan& rows, const swivel_out& values);

}  // namespace swivel
