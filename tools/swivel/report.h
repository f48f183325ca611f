// SPDX-License-Identifier: MIT
//
// Reports of a run, as lines for people or as JSON: the clip, the bound limbs, the crowd, and the measurements.
#pragma once

#include <cstdio>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/crowd/statistics.h"
#include "tools/formats/clip.h"
#include "tools/swivel/crowd_job.h"

namespace swivel::tools {

// Throughput, instruction set, threads, errors, differences from the clip, flags, and a note where went_wrong(), on
// stdout or stderr.
void print_statistics(std::FILE* to, const Statistics& statistics);
nlohmann::ordered_json json_of(const Statistics& statistics);

// Seconds from frame to frame; null where frames are uneven.
nlohmann::ordered_json frame_time_of(const formats::Clip& clip);

// Prints JSON; bytes of file and joint names that are not UTF-8 are replaced.
void print_json(const nlohmann::ordered_json& json, std::FILE* to = stdout);

// A file's name as one line shows it.
std::string shown_file(const std::string& name);

// Lines for people, on stdout or stderr.
void print_clip(std::FILE* to, const SolveOptions& options, const MotionFile& file, const CrowdJob& job);
nlohmann::ordered_json json_of_clip(const SolveOptions& options, const MotionFile& file, const CrowdJob& job);

}  // namespace swivel::tools
