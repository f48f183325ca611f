// SPDX-License-Identifier: MIT
//
// Explains a hand's link and a prop's place, in words and numbers. Reads the rows of the last solve, and solves single
// limbs only.
#pragma once

#include <cstdint>

#include "batch/crowd/crowd.h"
#include "batch/explain/explain_text.h"

namespace swivel {

// Whether the limb or prop that a limb is linked to has bad input.
bool holds_bad(const swivel_crowd& crowd, const Group& group, std::uint32_t limb);

// Explains a linked limb's hold.
void explain_link(const swivel_crowd& crowd, const Group& group, std::uint32_t limb, Text& text);

// Explains a prop's place.
void explain_prop(const swivel_crowd& crowd, const Group& group, std::uint32_t limb, Text& text);

}  // namespace swivel
