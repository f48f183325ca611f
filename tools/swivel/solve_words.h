// SPDX-License-Identifier: MIT
//
// What came out of a solve, in plain words for its report. run: what --json prints of the whole run.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tools/report/html.h"

namespace swivel::tools {

// A JSON string without its quotes.
std::string text_of(const nlohmann::ordered_json& string);

// A count, with commas between thousands.
std::string count_of(const nlohmann::ordered_json& number);

// How many limbs reached their targets, how far the others stay from them, and what to look at if most do.
std::string result_of(const nlohmann::ordered_json& run);

// The clip, the crowd, speed and files: rows of a name and a value.
std::vector<std::vector<Cell>> facts_of(const nlohmann::ordered_json& run);

}  // namespace swivel::tools
