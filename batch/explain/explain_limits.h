// SPDX-License-Identifier: MIT
//
// Says what joint limits and the step did to an elbow, in words and degrees.
#pragma once

#include "batch/explain/explain_probe.h"
#include "batch/explain/explain_text.h"

namespace swivel {

// flags_were: of the pose that the limb has. flags: of the next solve, whose pose the probe has.
void explain_limits(Probe& probe, std::uint32_t flags_were, std::uint32_t flags, Text& text);

}  // namespace swivel
