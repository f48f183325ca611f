// SPDX-License-Identifier: MIT
//
// Says what joint limits and the step did to an elbow, in words and degrees.
#pragma once

#include "batch/explain/explain_probe.h"
#include "batch/explain/explain_text.h"

namespace swivel {

// flags_were: of the limb's present pose. flags: of the probe's pose, the next solve's.
void explain_limits(Probe& probe, std::uint32_t flags_were, std::uint32_t flags, Text& text);

}  // namespace swivel
