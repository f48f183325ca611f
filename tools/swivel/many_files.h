// SPDX-License-Identifier: MIT
//
// Runs over several files, into a folder. One line says what became of each, manifest.json in the folder says it to
// machines, and a file that fails keeps none from the others.
#pragma once

#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace swivel::tools {

// The result of one file.
struct FileOutcome {
    std::string file, out;                   // as the user wrote them; out: empty if nothing was written
    std::vector<std::string> look, garbage;  // what stands out, as reports say it
    bool is_refused = false;                 // it is garbage, and so is not written
    std::string error{};                     // why it failed; empty: it did not

    bool has_failed() const { return is_refused || !error.empty(); }
};

// Whether an output is a folder: of several files, or one that is there already.
bool is_to_folder(const std::string& out, std::size_t file_count);

// Where the results go, one for each file: `out` itself, or in that folder, with this suffix unless it is empty.
std::vector<std::string> outputs_of(const std::vector<std::string>& files, const std::string& out,
                                    const std::string& suffix = {});

// The name of the folder's manifest.
std::string manifest_in(const std::string& folder);

// How such a run speaks.
struct ManyFiles {
    std::string folder;          // "": there is none, so no lines and no manifest, and reports tell all
    bool quiet = false;          // no progress
    std::FILE* lines = nullptr;  // where the line of each file goes; null: only garbage is told, on standard error
};

// Makes the folder, does the work for each file, and writes the manifest. work: takes the file's number, and throws as
// a run of that file alone does. Returns how many have failed, for require_none_failed().
std::size_t run_files(const std::vector<std::string>& files, const ManyFiles& run,
                      const std::function<FileOutcome(std::size_t)>& work);

// Throws CommandError if some have.
void require_none_failed(std::size_t failed, std::size_t file_count);

}  // namespace swivel::tools
