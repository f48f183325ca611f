// SPDX-License-Identifier: MIT
#include "tools/swivel/run_files.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "tools/cli/command_error.h"
#include "tools/cli/progress.h"
#include "tools/cli/streams.h"
#include "tools/formats/output_file.h"
#include "tools/formats/printable.h"
#include "tools/formats/text.h"
#include "tools/swivel/motion_keys.h"
#include "tools/swivel/report.h"

namespace swivel::tools {

namespace {

namespace fs = std::filesystem;
using formats::is_standard_stream;

// A key that is equal for two names if writing to one would replace the other. Empty for devices and other files that
// are never replaced.
std::string key_of(const struct stat& file)
{
    return S_ISREG(file.st_mode) ? fmt::format("{}:{}", file.st_dev, file.st_ino) : std::string();
}
std::string key_of(const fs::path& path)
{
    struct stat file;
    if (::stat(path.c_str(), &file) == 0) return key_of(file);
    std::error_code ignored;
    return fs::weakly_canonical(fs::absolute(path, ignored), ignored).string();
}

// The path of the file behind a name: standard input may be a file, as with `< FILE`.
std::string read_key(const std::string& name)
{
    struct stat input;
    if (!is_standard_stream(name)) return key_of(fs::path(name));
    return ::fstat(STDIN_FILENO, &input) == 0 ? key_of(input) : std::string();
}

void refuse_to_replace(const std::string& output, const char* what)
{
    throw CommandError(2, fmt::format("{}: is {}, too; name another file to write", output, what));
}

const char* verdict_of(const FileOutcome& outcome)
{
    if (!outcome.error.empty()) return "failed";
    return verdict_word(!outcome.look.empty(), !outcome.garbage.empty());
}

// "the first text, and 2 more". texts: one or more.
std::string first_and_more(const std::vector<std::string>& texts)
{
    return texts.front() + (texts.size() > 1 ? fmt::format(", and {} more", texts.size() - 1) : "");
}

// "a.bvh > out/a.bvh: the first thing that stands out, and 2 more", as one line. writes: an output was asked for.
std::string line_of(const FileOutcome& outcome, bool writes)
{
    std::string line = shown_file(outcome.file);
    if (!outcome.out.empty()) line += " > " + shown_file(outcome.out);
    if (outcome.is_refused) line += writes ? " is not written" : " is garbage";
    const std::vector<std::string>& told = outcome.garbage.empty() ? outcome.look : outcome.garbage;
    if (!told.empty()) line += ": " + first_and_more(told);
    return line;
}

std::string manifest_in(const std::string& folder) { return (fs::path(folder) / "manifest.json").string(); }

void write_manifest(const std::string& folder, const std::vector<FileOutcome>& outcomes)
{
    Json clips = Json::array();
    for (const FileOutcome& outcome : outcomes) {
        Json clip = {{"file", outcome.file}, {"verdict", verdict_of(outcome)}};
        if (!outcome.out.empty()) clip["out"] = outcome.out;
        if (!outcome.look.empty()) clip["look"] = outcome.look;
        if (!outcome.garbage.empty()) clip["garbage"] = outcome.garbage;
        if (!outcome.error.empty()) clip["error"] = outcome.error;
        clips.push_back(std::move(clip));
    }
    formats::OutputFile out(manifest_in(folder));
    out.write(formats::printable_lines(json_text({{"clips", std::move(clips)}})));
    out.commit();
}

// Makes the folder, and removes the manifest of an earlier run: this run may end before it writes its own. Refuses a
// manifest.json that swivel did not write.
void prepare_folder(const std::string& folder)
{
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        throw CommandError(
            1, fmt::format("--out {}: no folder can be made there ({}); name another", folder, error.message()));
    const std::string manifest = manifest_in(folder);
    if (!fs::exists(manifest, error)) return;
    const bool is_file = fs::is_regular_file(manifest, error);
    const Json old = is_file ? Json::parse(formats::read_text(manifest), nullptr, false) : Json();
    if (!old.is_object() || !old.contains("clips"))
        throw CommandError(2, fmt::format("{}: swivel did not write this file, and would replace it; move it, or name "
                                          "another folder",
                                          manifest));
    if (!fs::remove(manifest, error))
        throw CommandError(1, fmt::format("{}: cannot be replaced ({})", manifest, error.message()));
}

// Throws CommandError for an output that cannot be a folder.
void require_folder(const std::string& out)
{
    std::error_code ignored;
    const std::string suffix = formats::lower_suffix(out);
    const bool is_folder = !is_standard_stream(out) && fs::is_directory(out, ignored);
    if (!is_folder && (is_standard_stream(out) || is_bvh(suffix) || is_gltf(suffix) || fs::exists(out, ignored)))
        throw CommandError(2, fmt::format("--out {}: several files go into a folder; name one", out));
}

}  // namespace

OutKind out_kind(const std::string& out, std::uint32_t characters, bool has_agents)
{
    if (out.empty()) return OutKind::none;
    const std::string suffix = is_standard_stream(out) ? ".csv" : formats::lower_suffix(out);
    if (suffix == ".csv") return OutKind::csv;
    const auto refuse = [&](const std::string& cause) {
        throw CommandError(2, fmt::format("--out {}: {}", out, cause));
    };
    if (!is_bvh(suffix) && !is_gltf(suffix)) refuse("no writer for this suffix; use .bvh, .glb, .gltf, .vrm or .csv");
    const char* const advice = "write a .csv, or a .glb from a glTF file";
    if (characters > 1 && is_bvh(suffix))
        refuse(fmt::format("a BVH file holds one character, not {}; {}", characters, advice));
    if (has_agents && is_bvh(suffix))
        refuse(fmt::format("a BVH file holds a clip where it is, and no agent at its place; {}", advice));
    if (characters > kMaxInFile)
        refuse(fmt::format("a file holds {0} characters at most, not {1}; give --characters {0}, or write a .csv",
                           kMaxInFile, characters));
    return OutKind::motion;
}

void require_one_reader(std::span<const std::string> inputs, const char* which)
{
    if (std::ranges::count_if(inputs, is_standard_stream) > 1)
        throw CommandError(2, fmt::format("more than one of {} is -, standard input; name the others", which));
}

void require_one_reader(const SolveOptions& options, const std::string& targets)
{
    require_one_reader(std::array{options.file, options.crowd, targets}, "FILE, --crowd and --targets");
}

void require_own_outputs(std::span<const std::string> outputs, std::span<const ReadFile> read)
{
    std::map<std::string, const char*> taken;
    for (const ReadFile& each : read)
        if (!each.name.empty()) taken.emplace(read_key(each.name), each.what);
    taken.erase("");
    for (const std::string& output : outputs) {
        if (output.empty()) continue;
        const std::string key = is_standard_stream(output) ? output : key_of(fs::path(output));
        if (key.empty()) continue;
        const auto [other, is_own] = taken.emplace(key, "another output");
        if (!is_own) refuse_to_replace(output, other->second);
    }
}

void require_not_beside(std::span<const std::string> outputs, const MotionFile& clip)
{
    for (const fs::path& beside : clip.files_beside())
        for (const std::string& output : outputs)
            if (!output.empty() && !is_standard_stream(output) && !key_of(beside).empty() &&
                key_of(fs::path(output)) == key_of(beside))
                refuse_to_replace(output, "a buffer or image of the clip");
}

void require_own_files(std::span<const std::string> outputs, const SolveOptions& options, const MotionFile& clip,
                       const CrowdJob& job)
{
    std::vector<ReadFile> read{{options.file, "the clip"},
                               {job.targets == "clip" ? "" : job.targets, "the table of targets"},
                               {options.crowd, "the crowd file"},
                               {job.heights, "the picture of heights"},
                               {job.contacts, "the table of contacts"},
                               {job.agents, "the table of agents"}};
    for (const FurtherMotion& each : job.further) read.push_back({each.file.string(), "a clip"});
    require_own_outputs(outputs, read);
    require_not_beside(outputs, clip);
}

std::FILE* report_stream(std::span<const std::string> outputs)
{
    return std::ranges::any_of(outputs, is_standard_stream) ? stderr : stdout;
}

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
    outputs.push_back(manifest_in(out));
    return outputs;
}

void require_many_files(std::span<const std::string> inputs, std::size_t file_count, const std::string& out,
                        const char* kind, std::initializer_list<std::pair<const char*, std::string>> tables)
{
    if ((file_count > 1 || is_to_folder(out, file_count)) && std::ranges::any_of(inputs, is_standard_stream))
        throw CommandError(2, fmt::format("-, standard input, is read once and has no name; name files where there are "
                                          "several {}s, or a folder as --out",
                                          kind));
    for (const auto& [option, value] : tables)
        if (file_count > 1 && !value.empty())
            throw CommandError(
                2, fmt::format("{}: a table is of one {}, not of {}; run each by itself", option, kind, file_count));
    if (file_count > 1 && !out.empty()) require_folder(out);
}

Json failed_json(const std::string& file, const std::string& error)
{
    return {{"file", file}, {"verdict", "failed"}, {"error", error}};
}

std::vector<FileOutcome> run_files(const std::vector<std::string>& files, const ManyFiles& run,
                                   const std::function<FileOutcome(std::size_t, Json&)>& work)
{
    const bool to_folder = is_to_folder(run.out, files.size());
    Json clips = Json::array();
    const auto print_clips = [&] {
        if (run.json) print_json({{"clips", clips}}, run.json);
    };
    FileOutcome outcome;
    const auto run_one = [&](std::size_t n) {
        outcome = {};
        try {
            outcome = work(n, clips);
        } catch (const std::exception& error) {
            outcome.error = error.what();
            clips.push_back(failed_json(files[n], outcome.error));
            throw;
        }
    };
    if (files.size() == 1 && !to_folder) {
        try {
            run_one(0);
        } catch (...) {
            print_clips();
            throw;
        }
        print_clips();
        return {outcome};
    }
    if (to_folder) prepare_folder(run.out);
    std::FILE* const lines = to_folder ? run.lines : nullptr;
    std::vector<FileOutcome> outcomes;
    Progress progress("clips", files.size(), run.quiet || lines);
    for (std::size_t n = 0; n < files.size(); ++n) {
        progress.show(n);
        const int code = run_to_end([&] { run_one(n); });
        outcome.file = files[n];
        if (code != 0 && outcome.error.empty()) outcome.error = "standard output could not be written in full";
        if (code == 0 && lines)
            say(lines, "{:<9} {}\n", verdict_of(outcome), line_of(outcome, to_folder));
        else if (code == 0 && outcome.has_failed())
            fail(1, line_of(outcome, to_folder));
        outcomes.push_back(outcome);
    }
    print_clips();
    if (to_folder) write_manifest(run.out, outcomes);
    return outcomes;
}

void require_none_failed(const std::vector<FileOutcome>& outcomes)
{
    if (const auto failed = std::ranges::count_if(outcomes, &FileOutcome::has_failed); failed > 0)
        throw CommandError(1, fmt::format("{} of {} clips failed", failed, outcomes.size()));
}

void require_not_refused(const FileOutcome& outcome, const std::string& name, const char* see, bool writes)
{
    if (!outcome.is_refused) return;
    throw CommandError(1, fmt::format("{}: {}{}; see {}{}", name, first_and_more(outcome.garbage),
                                      writes ? "; nothing is written" : "", see, writes ? ", or give --force" : ""));
}

}  // namespace swivel::tools
