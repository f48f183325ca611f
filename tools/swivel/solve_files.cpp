// SPDX-License-Identifier: MIT
#include "tools/swivel/solve_files.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "tools/cli/command_error.h"
#include "tools/formats/text.h"

namespace swivel::tools {

namespace {

using formats::is_standard_stream;

// Whether what is written to the one would replace the other.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b)
{
    std::error_code ignored;
    if (std::filesystem::exists(a, ignored)) {
        const bool loses = std::filesystem::is_regular_file(a, ignored);
        return loses && std::filesystem::equivalent(a, b, ignored);
    }
    const auto whole = [&](const std::filesystem::path& path) {
        return std::filesystem::weakly_canonical(std::filesystem::absolute(path, ignored), ignored);
    };
    return !whole(a).empty() && whole(a) == whole(b);
}

// Whether standard input is that file, as with `< FILE`.
bool is_standard_input(const std::string& file)
{
    struct stat named, input;
    return ::stat(file.c_str(), &named) == 0 && ::fstat(STDIN_FILENO, &input) == 0 && S_ISREG(named.st_mode) &&
           named.st_dev == input.st_dev && named.st_ino == input.st_ino;
}

}  // namespace

OutKind out_kind(const std::string& out, std::uint32_t characters)
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
    return OutKind::motion;
}

bool would_be_lost(const std::string& file, const std::string& name)
{
    return is_standard_stream(name) ? is_standard_input(file) : is_same_file(file, name);
}

void require_one_reader(const SolveOptions& options, const std::string& targets)
{
    if (std::ranges::count_if(std::array{options.file, options.crowd, targets}, is_standard_stream) > 1)
        throw CommandError(2, "more than one of FILE, --crowd and --targets is -, standard input; name the others");
}

void require_own_outputs(std::span<const std::string> outputs, std::span<const ReadFile> read, const MotionFile& clip)
{
    for (std::size_t n = 0; n < outputs.size(); ++n) {
        const std::string& file = outputs[n];
        if (file.empty()) continue;
        const auto refuse_if = [&](bool is_lost, const char* what) {
            if (is_lost) throw CommandError(2, fmt::format("{}: is {}, too; name another file to write", file, what));
        };
        for (std::size_t other = 0; other < n; ++other)
            refuse_if(!outputs[other].empty() && is_same_file(file, outputs[other]), "another output");
        if (is_standard_stream(file)) continue;  // reading from - is something else
        for (const ReadFile& each : read) refuse_if(!each.name.empty() && would_be_lost(file, each.name), each.what);
        for (const std::filesystem::path& beside : clip.files_beside())
            refuse_if(is_same_file(file, beside), "a buffer or image of the clip");
    }
}

void require_own_files(const SolveOptions& options, const MotionFile& clip, const std::string& targets)
{
    const std::string outputs[] = {options.out, options.export_targets, options.view};
    const ReadFile read[] = {{options.file, "the clip"},
                             {targets == "clip" ? "" : targets, "the table of targets"},
                             {options.crowd, "the crowd file"}};
    require_own_outputs(outputs, read, clip);
}

std::FILE* report_stream(const SolveOptions& options)
{
    const auto outputs = {options.out, options.export_targets, options.view};
    return std::ranges::any_of(outputs, is_standard_stream) ? stderr : stdout;
}

}  // namespace swivel::tools
