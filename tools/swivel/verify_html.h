// SPDX-License-Identifier: MIT
//
// The report of a verification as an HTML file: checks with their limits, errors by band of reach, digests.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "tools/report/html.h"

namespace swivel::tools {

// run: what --json prints of the whole run.
void put_verification(Report& report, const nlohmann::ordered_json& run);

}  // namespace swivel::tools
