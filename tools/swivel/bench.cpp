// SPDX-License-Identifier: MIT
//
// `swivel bench`: becomes swivel-race, the program beside it (tools/race/).
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/cli/command_error.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/report_file.h"

namespace swivel::tools {

void run_bench(const BenchOptions& options)
{
    require_html_name("--report", options.report);
    const std::filesystem::path race = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "swivel-race";
    const std::string seconds = fmt::format("{}", options.seconds);
    std::vector<const char*> words = {"swivel-race", seconds.c_str()};
    if (options.json) words.push_back("--json");
    if (options.quiet) words.push_back("--quiet");
    if (!options.report.empty()) words.insert(words.end(), {"--report", options.report.c_str()});
    words.push_back(nullptr);
    execv(race.c_str(), const_cast<char* const*>(words.data()));  // which changes none of them
    if (errno == ENOENT)
        throw CommandError(
            1,
            fmt::format("bench: {} is missing; build it with cmake --build BUILD --target swivel_race", race.string()));
    throw CommandError(1, fmt::format("bench: {} does not start: {}", race.string(), std::strerror(errno)));
}

}  // namespace swivel::tools
