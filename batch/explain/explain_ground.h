// SPDX-License-Identifier: MIT
//
// Explains how the ground moves a planted foot, in words and numbers. Reads the rows of the last solve, and solves
// nothing.
#pragma once

#include <cstdint>

#include "batch/crowd/crowd.h"
#include "batch/explain/explain_text.h"

namespace swivel {

// How the ground lifts the foot of a limb WITH_GROUND, and how it turns it.
void explain_ground(const Group& group, std::uint32_t limb, Text& text);

}  // namespace swivel
