// SPDX-License-Identifier: MIT
//
// What `swivel solve` reads and writes, as its options name it: formats, standard streams, and files that are not to be
// lost.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

#include "tools/swivel/commands.h"
#include "tools/swivel/motion_file.h"

namespace swivel::tools {

enum class OutKind { none, motion, csv };

OutPlace out_place(const SolveOptions& options);

// Throws CommandError (bad usage) for a format that is not written, and for one that does not hold so many characters.
OutKind out_kind(const SolveOptions& options, std::uint32_t characters);

// Standard input can be read once. targets: "clip" or a file; throws CommandError.
void require_one_reader(const SolveOptions& options, const std::string& targets);

// Nothing that is read is written over, and nothing that is written. Throws CommandError.
void require_own_files(const SolveOptions& options, const MotionFile& clip, const std::string& targets);

bool writes_to_standard_output(const SolveOptions& options);

// While it lives, reports go to stderr, as stdout is for data. The GNU C Library lets its streams be set like other
// variables.
class ReportsToStderr {
public:
    ReportsToStderr() { stdout = stderr; }
    ReportsToStderr(const ReportsToStderr&) = delete;
    ReportsToStderr& operator=(const ReportsToStderr&) = delete;
    ~ReportsToStderr() { stdout = before_; }

private:
    std::FILE* before_ = stdout;
};

}  // namespace swivel::tools
