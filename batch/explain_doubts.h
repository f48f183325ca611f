// SPDX-License-Identifier: MIT
//
// Warnings of what no solve refuses, and hardly anybody means: another unit, another origin, a pose that is solved
// twice. They come first in an explanation. Bars are far beyond what games have.
#pragma once

#include <cstdint>

#include "batch/crowd.h"
#include "batch/explain_probe.h"
#include "batch/explain_text.h"

namespace swivel {

// Of the crowd's last solve: its time, and whether it wrote its results over the pose. Returns whether it warns.
bool doubt_solve(const swivel_crowd& crowd, Text& text);

// Of a body's limb with a record. solved: the same limb.
void doubt_limb(const Group& group, std::uint32_t limb, const Probe& solved, Text& text);

}  // namespace swivel
