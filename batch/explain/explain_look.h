// SPDX-License-Identifier: MIT
//
// Explains whether a look meets its target, in words and numbers. Reads the rows of the last solve, and solves nothing.
#pragma once

#include <cstdint>

#include "batch/crowd/crowd.h"
#include "batch/explain/explain_text.h"

namespace swivel {

// Explains a look.
void explain_look(const swivel_crowd& crowd, const Group& group, std::uint32_t limb, Text& text);

}  // namespace swivel
