// SPDX-License-Identifier: MIT
//
// What `swivel bench` measured, as tables for people or as JSON for machines.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "tools/race/measure.h"

namespace swivel::tools {

nlohmann::ordered_json json_of(const Measured& measured);
void print_measured(const Measured& measured);

}  // namespace swivel::tools
