// SPDX-License-Identifier: MIT
//
// The files that `swivel solve` reads and writes: their formats, standard streams, and the rule that no input is
// overwritten.
#pragma once

#include <cstdint>
#include <cstdio>
#include <span>
#include <string>

#include "tools/swivel/commands.h"
#include "tools/swivel/crowd_job.h"
#include "tools/swivel/motion_file.h"

namespace swivel::tools {

enum class OutKind { none, motion, csv };

// The format of the suffix; standard output is CSV. Throws CommandError (bad usage) for a format that is not written,
// or cannot hold this many characters, or agents of a table.
OutKind out_kind(const std::string& out, std::uint32_t characters, bool has_agents = false);

// Throws CommandError if two inputs are standard input. targets: "clip" or a file.
void require_one_reader(const SolveOptions& options, const std::string& targets);

// A file that a run reads, and its name in a message.
struct ReadFile {
    std::string name;
    const char* what;
};
// Refuses an output that is one of these files or another output. Empty names are ignored. Throws CommandError.
void require_own_outputs(std::span<const std::string> outputs, std::span<const ReadFile> read);
// Refuses an output that is a file beside the clip. Throws CommandError.
void require_not_beside(std::span<const std::string> outputs, const MotionFile& clip);

// Refuses outputs that would overwrite an input or another output. Throws CommandError.
void require_own_files(const SolveOptions& options, const MotionFile& clip, const CrowdJob& job);

// Where reports go: stderr, where stdout is for data.
std::FILE* report_stream(std::span<const std::string> outputs);
std::FILE* report_stream(const SolveOptions& options);

}  // namespace swivel::tools
