// SPDX-License-Identifier: MIT
//
// Why a planted point stands or slides, and what a body's shift is, in words and numbers. It reads what a solve left in
// rows, and solves nothing.
#pragma once

#include <cstdint>

#include "batch/crowd/crowd.h"
#include "batch/explain/explain_text.h"

namespace swivel {

// Where the target of a planted limb comes from. flags: as the last solve left them.
void explain_plant(const Group& group, std::uint32_t limb, std::uint32_t flags, Text& text);

// A body's shift.
void explain_shift(const Group& group, std::uint32_t limb, Text& text);

}  // namespace swivel
