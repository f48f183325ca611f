// SPDX-License-Identifier: MIT
//
// Explains where a body's shift is and where it goes, in words and numbers. Reads the rows of the last solve, and
// solves nothing.
#pragma once

#include <cstdint>

#include "batch/crowd/crowd.h"
#include "batch/explain/explain_text.h"

namespace swivel {

// Explains a body's shift.
void explain_shift(const swivel_crowd& crowd, const Group& group, std::uint32_t limb, Text& text);

// Says how far the body's shift still goes, for a limb of a group that fits and is out of reach. Says nothing where
// that is not known, or where the limb does not count for the shift.
void explain_coming_shift(const swivel_crowd& crowd, const Group& fits, std::uint32_t limb, Text& text);

}  // namespace swivel
