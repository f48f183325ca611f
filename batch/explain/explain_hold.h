// SPDX-License-Identifier: MIT
//
// Says what a hand holds, and why a prop lies where it does, in words and numbers. It reads what a solve left in rows,
// and solves nothing but single limbs.
#pragma once

#include <cstdint>

#include "batch/crowd/crowd.h"
#include "batch/explain/explain_text.h"

namespace swivel {

// Whether a limb is linked to what has bad input.
bool holds_bad(const swivel_crowd& crowd, const Group& group, std::uint32_t limb);

// Says what a linked limb holds.
void explain_link(const swivel_crowd& crowd, const Group& group, std::uint32_t limb, Text& text);

// A prop.
void explain_prop(const swivel_crowd& crowd, const Group& group, std::uint32_t limb, Text& text);

}  // namespace swivel
