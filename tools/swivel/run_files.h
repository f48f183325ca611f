// SPDX-License-Identifier: MIT
//
// The files that runs read and write: their formats, standard streams, and the rule that no input is overwritten. A run
// over several files says in one line what became of each, and in the folder's manifest.json to machines. A file that
// fails keeps none from the others. With --json machines are told of each file, too, also of one that failed.
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tools/swivel/crowd_job.h"

namespace swivel::tools {

enum class OutKind { none, motion, csv };

// The format of the suffix; standard output is CSV. Throws CommandError (bad usage) for a format that is not written,
// or cannot hold this many characters, or agents of a table.
OutKind out_kind(const std::string& out, std::uint32_t characters, bool has_agents = false);

// Throws CommandError if two inputs are standard input. which: the inputs, for the message.
void require_one_reader(std::span<const std::string> inputs, const char* which);
// targets: "clip" or a file.
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

// Refuses outputs that would overwrite an input of the job or another output. Throws CommandError.
void require_own_files(std::span<const std::string> outputs, const SolveOptions& options, const MotionFile& clip,
                       const CrowdJob& job);

// Where reports go: stderr, where stdout is for data.
std::FILE* report_stream(std::span<const std::string> outputs);

// The result of one of several files.
struct FileOutcome {
    std::string file, out;                   // as the user wrote them; out: empty if nothing was written
    std::vector<std::string> look, garbage;  // what stands out, as reports say it
    bool is_refused = false;                 // it is garbage, and so nothing is written
    std::string error{};                     // why it failed; empty: it did not

    bool has_failed() const { return is_refused || !error.empty(); }
};

// Whether an output is a folder: of several files, or one that is there already.
bool is_to_folder(const std::string& out, std::size_t file_count);

// Where the results go, one for each file: `out` itself, or in that folder, with this suffix unless it is empty. Then
// the folder's manifest.
std::vector<std::string> outputs_of(const std::vector<std::string>& files, const std::string& out,
                                    const std::string& suffix = {});

// Throws CommandError for a run over several files, or to a folder, that reads standard input for each, and for one
// over several files with a table that is of one, or to a single file. kind: of the files, for the message. tables:
// options and what they name.
void require_many_files(std::span<const std::string> inputs, std::size_t file_count, const std::string& out,
                        const char* kind, std::initializer_list<std::pair<const char*, std::string>> tables);

// How a run over several files speaks.
struct ManyFiles {
    std::string out;             // as outputs_of() takes it
    bool quiet = false;          // no progress
    std::FILE* lines = nullptr;  // where the line of each file in a folder goes; null: only garbage is told, on
                                 // standard error
    std::FILE* json = nullptr;   // where the JSON of all files goes; null: there is none
};

// A file that failed, in JSON.
nlohmann::ordered_json failed_json(const std::string& file, const std::string& error);

// Makes the folder, removes the manifest of an earlier run, does the work for each file, and writes the manifest. work:
// takes the file's number and a list that it adds the file's JSON to, and throws as a run of that file alone does. A
// single file that goes to no folder is such a run.
std::vector<FileOutcome> run_files(const std::vector<std::string>& files, const ManyFiles& run,
                                   const std::function<FileOutcome(std::size_t, nlohmann::ordered_json&)>& work);

// Throws CommandError if some have failed.
void require_none_failed(const std::vector<FileOutcome>& outcomes);
// Throws CommandError if a single file is refused. name: of what is garbage. see: the command that says why. writes:
// whether an output was asked for.
void require_not_refused(const FileOutcome& outcome, const std::string& name, const char* see, bool writes);

}  // namespace swivel::tools
