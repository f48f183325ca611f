// SPDX-License-Identifier: MIT
//
// Turns the words of a compact group's results into floats again, one value at a time. The floating-point environment
// is the caller's; unpack_out() sets its own.
#pragma once

#include <array>

#include "batch/crowd.h"

namespace swivel {

// A field whose rows are words.
bool is_packed(const Group& group, swivel_field field);

// x, y, z, w, from three words that lie word_stride words apart.
std::array<float, 4> unpack_rotation(const std::uint16_t* words, std::size_t word_stride);
float unpack_half(std::uint16_t word);

// The value of a packed field of a limb of the group, as the same field of other groups has it in its rows.
std::array<float, 4> unpack_value(const Group& group, swivel_field field, std::size_t limb);
// Values of limbs first ... first + limb_count - 1 of the group; data is limb first's.
void unpack_out(const Group& group, swivel_field field, std::size_t first, std::size_t limb_count, swivel_out values);

}  // namespace swivel
