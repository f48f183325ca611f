// SPDX-License-Identifier: MIT
//
// Finds the bad inputs that only stages of bodies read, by the bounds that the table of fields has, and names them.
#pragma once

#include "batch/crowd/crowd.h"
#include "batch/explain/explain_text.h"

namespace swivel {

// Whether an input of a group of bodies is bad. A field that the group lacks, or that stages of free limbs read, too,
// is not.
bool is_bad_in_body(const Group& group, std::uint32_t limb, swivel_field field);
// Whether any is.
bool is_bad_in_body(const Group& group, std::uint32_t limb);
// Names all of them, with their values and ranges. Returns whether there are any.
bool explain_bad_in_body(const Group& group, std::uint32_t limb, Text& text);

}  // namespace swivel
