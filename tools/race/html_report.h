// SPDX-License-Identifier: MIT
//
// What `swivel bench` measured, as an HTML report: rivals, speed by the crowd's size, bounds, roofline.
#pragma once

#include "tools/race/measure.h"
#include "tools/report/html.h"

namespace swivel::tools {

// As tables and plots. The plot of sizes needs sizes that were timed.
void put_measured(Report& report, const Measured& measured);

}  // namespace swivel::tools
