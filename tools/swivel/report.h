// SPDX-License-Identifier: MIT
//
// Reports of a run, as lines for people or as JSON: the clip, the bound limbs, the crowd, and the measurements.
#pragma once

#include <cstdint>
#include <cstdio>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

#include "tools/crowd/statistics.h"
#include "tools/formats/clip.h"
#include "tools/rig/plain_units.h"
#include "tools/swivel/crowd_job.h"

namespace swivel::tools {

using Json = nlohmann::ordered_json;

// A run's verdict, throughput, errors, differences from the clip and flags, on stdout or stderr. unit: of the clip.
void print_statistics(std::FILE* to, const Statistics& statistics, const LengthUnit& unit);
Json json_of(const Statistics& statistics);
// Throws CommandError if the run of a file went_wrong(), with what is wrong and what to check.
void require_went_well(const Statistics& statistics, const std::string& file);

// Seconds from frame to frame; null where frames are uneven.
Json frame_time_of(const formats::Clip& clip);

// JSON as text; bytes of file and joint names that are not UTF-8 are replaced.
std::string json_text(const Json& json);
void print_json(const Json& json, std::FILE* to = stdout);

// The names of these joints.
Json names_json(const formats::Clip& clip, std::span<const int> joints);

// A clip's verdict: "good", "look" or "garbage".
const char* verdict_word(bool has_doubts, bool is_garbage);

// "1 frame", "152 frames"
std::string counted(std::uint64_t count, std::string_view what);

// A file's name as one line shows it.
std::string shown_file(const std::string& name);

// Lines for people, on stdout or stderr: a clip and the notes on it; limbs that are missing, and the same in JSON; the
// files that were written, of those that are named.
void print_motion_file(std::FILE* to, const std::string& name, const MotionFile& file, std::size_t frame_count);
void print_missing(std::FILE* to, const std::vector<LimbFinding>& missing);
void add_missing(Json& json, const std::vector<LimbFinding>& missing);
void print_written(std::FILE* to, std::initializer_list<std::string> outputs, std::size_t width = 9);

// Lines for people on a crowd's clip.
void print_clip(std::FILE* to, const SolveOptions& options, const MotionFile& file, const CrowdJob& job);
Json json_of_clip(const SolveOptions& options, const MotionFile& file, const CrowdJob& job);

}  // namespace swivel::tools
