// SPDX-License-Identifier: MIT
//
// Where a body looks, and what keeps its line of sight from the target, in words and numbers. It reads what a solve
// left in rows, and solves nothing.
#pragma once

#include <cstdint>

#include "batch/crowd.h"
#include "batch/explain_text.h"

namespace swivel {

// A body's look, of a group that is SWIVEL_LOOK.
void explain_look(const Group& group, std::uint32_t limb, Text& text);

}  // namespace swivel
