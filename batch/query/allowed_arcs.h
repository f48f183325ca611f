// SPDX-License-Identifier: MIT
//
// The swivels that a limb's limits allow.
#pragma once

#include <cstdint>

#include "batch/crowd/crowd.h"
#include "simd/kernels.h"

namespace swivel {

// Stores the arcs that swivel_allowed_arcs() promises of a free limb or one with a record, and returns how many there
// are.
std::uint32_t allowed_arcs(const Group& group, std::uint32_t limb, ArcEnds (&arcs)[kMaxArcs]);

}  // namespace swivel
