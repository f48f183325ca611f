// SPDX-License-Identifier: MIT
//
// The swivels that the limits of a limb allow.
#pragma once

#include "batch/crowd/crowd.h"

namespace swivel {

// Stores at most capacity arcs of a free limb, which is counted within its group. Returns how many there are
// (swivel_allowed_arcs).
std::uint32_t allowed_arcs(const Group& group, std::uint32_t limb, swivel_arc* arcs, std::uint32_t capacity);

}  // namespace swivel
