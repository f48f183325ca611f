// SPDX-License-Identifier: MIT
//
// Why one limb's result is as it is, in words and numbers, for people.
#pragma once

#include <cstdint>
#include <span>

#include "batch/crowd.h"

namespace swivel {

// What swivel_explain() promises. group: one of the crowd's; limb: counted within it; text: a byte at least.
void explain(const swivel_crowd& crowd, std::uint32_t group, std::uint32_t limb, std::span<char> text);

}  // namespace swivel
