// SPDX-License-Identifier: MIT
//
// Finds and names the bad inputs that only stages of bodies read, by the bounds in the table of fields.
#pragma once

#include "batch/crowd/crowd.h"
#include "batch/explain/explain_text.h"

namespace swivel {

// Whether an input that only stages of bodies read is bad. Other fields, and those that the group lacks, count as good.
bool is_bad_in_body(const Group& group, std::uint32_t limb, swivel_field field);
// Whether any such input is bad.
bool is_bad_in_body(const Group& group, std::uint32_t limb);
// Names all bad inputs with their values and ranges. Returns whether there are any.
bool explain_bad_in_body(const Group& group, std::uint32_t limb, Text& text);

}  // namespace swivel
