// SPDX-License-Identifier: MIT
//
// Warnings of valid input that hardly anybody intends: another unit, another origin, a pose solved twice. A warning
// comes before the explanation of the limb.
#pragma once

#include <cstdint>

#include "batch/crowd/crowd.h"
#include "batch/explain/explain_probe.h"
#include "batch/explain/explain_text.h"

namespace swivel {

// Lengths that differ by more than this factor, nearly 2, are suspected to be in different units.
inline constexpr double kOtherUnit = 1.9;

// Adds a warning of the crowd's last solve. Returns whether there is one.
bool doubt_solve(const swivel_crowd& crowd, Text& text);

// Adds warnings of a body's limb that has a record. solved: the limb, solved.
void doubt_limb(const Group& group, std::uint32_t limb, const Probe& solved, Text& text);

}  // namespace swivel
