// SPDX-License-Identifier: MIT
//
// Why a look does or does not meet its target, in words and numbers. It reads what a solve left in rows, and solves
// nothing.
#pragma once

#include <cstdint>

#include "batch/crowd/crowd.h"
#include "batch/explain/explain_text.h"

namespace swivel {

// A look.
void explain_look(const swivel_crowd& crowd, const Group& group, std::uint32_t limb, Text& text);

}  // namespace swivel
