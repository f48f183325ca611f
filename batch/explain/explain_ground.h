// SPDX-License-Identifier: MIT
//
// Says what the ground does to a planted foot, in words and numbers. It reads what a solve left in rows, and solves
// nothing.
#pragma once

#include <cstdint>

#include "batch/crowd/crowd.h"
#include "batch/explain/explain_text.h"

namespace swivel {

// How the ground lifts the foot of a limb WITH_GROUND, and how it turns it.
void explain_ground(const Group& group, std::uint32_t limb, Text& text);

}  // namespace swivel
