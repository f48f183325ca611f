// SPDX-License-Identifier: MIT
//
// What `swivel solve` says of its work before the figures: the clip, the limbs bound, the crowd.
#pragma once

#include <cstdio>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/swivel/crowd_job.h"

namespace swivel::tools {

// A file's name as one line shows it.
std::string shown_file(const std::string& name);

// Lines for people, on stdout or stderr.
void print_clip(std::FILE* to, const SolveOptions& options, const MotionFile& file, const CrowdJob& job);
nlohmann::ordered_json json_of_clip(const SolveOptions& options, const MotionFile& file, const CrowdJob& job);

}  // namespace swivel::tools
