// SPDX-License-Identifier: MIT
//
// What a run measured, as lines for people or as JSON for machines.
#pragma once

#include <cstdio>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/crowd/statistics.h"
#include "tools/formats/clip.h"

namespace swivel::tools {

// What is wrong with the limbs of a run that went_wrong(), and what to look at: one line for people, without its end.
std::string what_went_wrong(const Statistics& statistics);

// The names of a word's flags, with commas between.
std::string flag_names(std::uint32_t word);

// Throughput, instruction set, threads, errors, differences from the clip, flags, and a note where went_wrong(), on
// stdout or stderr.
void print_statistics(std::FILE* to, const Statistics& statistics);
nlohmann::ordered_json json_of(const Statistics& statistics);

// Seconds from frame to frame; null where frames are uneven.
nlohmann::ordered_json frame_time_of(const formats::Clip& clip);

// Prints JSON; bytes of file and joint names that are not UTF-8 are replaced.
void print_json(const nlohmann::ordered_json& json, std::FILE* to = stdout);

}  // namespace swivel::tools
