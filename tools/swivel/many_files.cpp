// SPDX-License-Identifier: MIT
#include "tools/swivel/many_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tools/cli/command_error.h"
#include "tools/cli/progress.h"
#include "tools/cli/streams.h"
#include "tools/formats/output_file.h"
#include "tools/formats/printable.h"
#include "tools/swivel/crowd_job.h"
#include "tools/swivel/report.h"

namespace swivel::tools {

namespace {

namespace fs = std::filesystem;

const char* verdict_of(const FileOutcome& outcome)
{
    if (!outcome.error.empty()) return "failed";
    if (!outcome.garbage.empty()) return "garbage";
    return outcome.look.empty() ? "good" : "look";
}

// "a.bvh > out/a.bvh: the first thing that stands out, and 2 more", as one line.
std::string line_of(const FileOutcome& outcome)
{
    std::string line = shown_file(outcome.file);
    if (!outcome.out.empty()) line += " > " + shown_file(outcome.out);
    if (outcome.is_refused) line += " is not written";
    const std::vector<std::string>& told = outcome.garbage.empty() ? outcome.look : outcome.garbage;
    if (!told.empty()) line += ": " + told.front();
    if (told.size() > 1) line += fmt::format(", and {} more", told.size() - 1);
    return line;
}

void write_manifest(const std::string& folder, const std::vector<FileOutcome>& outcomes)
{
    nlohmann::ordered_json clips = nlohmann::ordered_json::array();
    for (const FileOutcome& outcome : outcomes) {
        nlohmann::ordered_json clip = {{"file", outcome.file}, {"verdict", verdict_of(outcome)}};
        if (!outcome.out.empty()) clip["out"] = outcome.out;
        if (!outcome.look.empty()) clip["look"] = outcome.look;
        if (!outcome.garbage.empty()) clip["garbage"] = outcome.garbage;
        if (!outcome.error.empty()) clip["error"] = outcome.error;
        clips.push_back(std::move(clip));
    }
    formats::OutputFile out(manifest_in(folder));
    const nlohmann::ordered_json manifest = {{"clips", std::move(clips)}};
    out.write(formats::printable_lines(manifest.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) +
                                       "\n"));
    out.commit();
}

}  // namespace

bool is_to_folder(const std::string& out, std::size_t file_count)
{
    std::error_code ignored;
    return !out.empty() && (file_count > 1 || fs::is_directory(out, ignored));
}

std::vector<std::string> outputs_of(const std::vector<std::string>& files, const std::string& out,
                                    const std::string& suffix)
{
    if (!is_to_folder(out, files.size())) return std::vector<std::string>(files.size(), out);
    std::vector<std::string> outputs;
    for (const std::string& file : files) {
        fs::path path = fs::path(out) / title_of(file);
        if (!suffix.empty()) path.replace_extension(suffix);
        outputs.push_back(path.string());
    }
    return outputs;
}

std::string manifest_in(const std::string& folder) { return (fs::path(folder) / "manifest.json").string(); }

std::size_t run_files(const std::vector<std::string>& files, const ManyFiles& run,
                      const std::function<FileOutcome(std::size_t)>& work)
{
    if (!run.folder.empty()) fs::create_directories(run.folder);
    std::vector<FileOutcome> outcomes;
    Progress progress("clips", files.size(), run.quiet || run.lines);
    for (std::size_t n = 0; n < files.size(); ++n) {
        progress.show(n);
        FileOutcome outcome;
        const int code = run_to_end([&] {
            try {
                outcome = work(n);
            } catch (const std::exception& error) {
                outcome.error = error.what();
                throw;
            }
        });
        outcome.file = files[n];
        if (code != 0 && outcome.error.empty()) outcome.error = "standard output could not be written in full";
        if (code == 0 && run.lines)
            say(run.lines, "{:<9} {}\n", verdict_of(outcome), line_of(outcome));
        else if (code == 0 && outcome.has_failed())
            fail(1, line_of(outcome));
        outcomes.push_back(std::move(outcome));
    }
    if (!run.folder.empty()) write_manifest(run.folder, outcomes);
    return static_cast<std::size_t>(std::ranges::count_if(outcomes, &FileOutcome::has_failed));
}

void require_none_failed(std::size_t failed, std::size_t file_count)
{
    if (failed > 0) throw CommandError(1, fmt::format("{} of {} clips failed", failed, file_count));
}

}  // namespace swivel::tools
