// SPDX-License-Identifier: MIT
//
// Warnings of what no solve refuses, and hardly anybody means: another unit, another origin, a pose that is solved
// twice. They stand before the explanation of what they are about.
#pragma once

#include <cstdint>

#include "batch/crowd/crowd.h"
#include "batch/explain/explain_probe.h"
#include "batch/explain/explain_text.h"

namespace swivel {

// A length that is so many times another one, or less than its inverse, is doubted to be in its unit: nearly twice.
inline constexpr double kOtherUnit = 1.9;

// Adds a warning of the crowd's last solve. Returns whether there is one.
bool doubt_solve(const swivel_crowd& crowd, Text& text);

// Adds warnings of a body's limb that has a record. solved: the limb, solved.
void doubt_limb(const Group& group, std::uint32_t limb, const Probe& solved, Text& text);

}  // namespace swivel
