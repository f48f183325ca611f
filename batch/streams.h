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

void copy_in(const RowSpan& rows, const swivel_in& values);
void copy_out(const RowSpan& rows, const swivel_out& values);

}  // namespace swivel
