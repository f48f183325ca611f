// SPDX-License-Identifier: MIT
//
// Explains one limb's result, in words and numbers, for people.
#pragma once

#include <cstdint>

#include "batch/crowd/crowd.h"
#include "batch/explain/explain_text.h"
#include "include/swivel/swivel_explain.h"

namespace swivel {

// Adds what swivel_explain() promises. group: one of the crowd's; limb: counted within it.
void explain(const swivel_crowd& crowd, std::uint32_t group, std::uint32_t limb, Text& text);

}  // namespace swivel
