// SPDX-License-Identifier: MIT
//
// Explains why a planted point stands or slides, in words and numbers. Reads the rows of the last solve, and solves
// nothing.
#pragma once

#include <cstdint>

#include "batch/crowd/crowd.h"
#include "batch/explain/explain_text.h"

namespace swivel {

// Explains a planted limb's target. flags: of the last solve.
void explain_plant(const Group& group, std::uint32_t limb, std::uint32_t flags, Text& text);

}  // namespace swivel
