// SPDX-License-Identifier: MIT
#include "tools/swivel/solve_files.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>

#include "tools/cli/command_error.h"
#include "tools/formats/text.h"
#include "tools/swivel/motion_keys.h"

namespace swivel::tools {

namespace {

using formats::is_standard_stream;

// A key that is equal for two names if writing to one would replace the other. Empty for devices and other files that
// are never replaced.
std::string key_of(const struct stat& file)
{
    return S_ISREG(file.st_mode) ? fmt::format("{}:{}", file.st_dev, file.st_ino) : std::string();
}
std::string key_of(const std::filesystem::path& path)
{
    struct stat file;
    if (::stat(path.c_str(), &file) == 0) return key_of(file);
    std::error_code ignored;
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path, ignored), ignored).string();
}

// The path of the file behind a name: standard input may be a file, as with `< FILE`.
std::string read_key(const std::string& name)
{
    struct stat input;
    if (!is_standard_stream(name)) return key_of(std::filesystem::path(name));
    return ::fstat(STDIN_FILENO, &input) == 0 ? key_of(input) : std::string();
}

void refuse(const std::string& output, const char* what)
{
    throw CommandError(2, fmt::format("{}: is {}, too; name another file to write", output, what));
}

}  // namespace

OutKind out_kind(const std::string& out, std::uint32_t characters, bool has_agents)
{
    if (out.empty()) return OutKind::none;
    const std::string suffix = is_standard_stream(out) ? ".csv" : formats::lower_suffix(out);
    if (suffix == ".csv") return OutKind::csv;
    if (!is_bvh(suffix) && !is_gltf(suffix))
        throw CommandError(
            2, fmt::format("--out {}: no writer for this suffix; use .bvh, .glb, .gltf, .vrm or .csv", out));
    if (characters > 1 && is_bvh(suffix))
        throw CommandError(2, fmt::format("--out {}: a BVH file holds one character, not {}; write a .csv, or a .glb "
                                          "from a glTF file",
                                          out, characters));
    if (has_agents && is_bvh(suffix))
        throw CommandError(2, fmt::format("--out {}: a BVH file holds a clip where it is, and no agent at its place; "
                                          "write a .csv, or a .glb from a glTF file",
                                          out));
    if (characters > kMaxInFile)
        throw CommandError(2, fmt::format("--out {}: a file holds {} characters at most, not {}; give --characters "
                                          "{}, or write a .csv",
                                          out, kMaxInFile, characters, kMaxInFile));
    return OutKind::motion;
}

void require_one_reader(const SolveOptions& options, const std::string& targets)
{
    if (std::ranges::count_if(std::array{options.file, options.crowd, targets}, is_standard_stream) > 1)
        throw CommandError(2, "more than one of FILE, --crowd and --targets is -, standard input; name the others");
}

void require_own_outputs(std::span<const std::string> outputs, std::span<const ReadFile> read)
{
    std::map<std::string, const char*> taken;
    for (const ReadFile& each : read)
        if (!each.name.empty()) taken.emplace(read_key(each.name), each.what);
    taken.erase("");
    for (const std::string& output : outputs) {
        if (output.empty()) continue;
        const std::string key = is_standard_stream(output) ? output : key_of(std::filesystem::path(output));
        if (key.empty()) continue;
        const auto [other, is_own] = taken.emplace(key, "another output");
        if (!is_own) refuse(output, other->second);
    }
}

void require_not_beside(std::span<const std::string> outputs, const MotionFile& clip)
{
    for (const std::filesystem::path& beside : clip.files_beside())
        for (const std::string& output : outputs)
            if (!output.empty() && !is_standard_stream(output) && !key_of(beside).empty() &&
                key_of(std::filesystem::path(output)) == key_of(beside))
                refuse(output, "a buffer or image of the clip");
}

void require_own_files(const SolveOptions& options, const MotionFile& clip, const CrowdJob& job)
{
    const std::string outputs[] = {options.out, options.export_targets, options.view};
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

std::FILE* report_stream(const SolveOptions& options)
{
    return report_stream(std::array{options.out, options.export_targets, options.view});
}

}  // namespace swivel::tools
