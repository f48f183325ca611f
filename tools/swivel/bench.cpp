// SPDX-License-Identifier: MIT
//
// `swivel lab bench`: replaces itself by swivel-bench, the suite beside it (bench/), and runs the families that suit
// any machine. So the command itself builds without the rivals.
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/cli/command_error.h"
#include "tools/swivel/commands.h"

namespace swivel::tools {

namespace {

constexpr const char* kFamilies =
    "^(P/.*/(L2|memory)$|loop_|single_glm/|resident/.*/L2$|threads/.*/262144/|frame/.*/(in_one|apart)$|frame_glm/)";
constexpr double kTurns = 9 * 34 * 1.5;  // repetitions of so many rows; finding out how often to call takes time, too

}  // namespace

void run_bench(const BenchOptions& options)
{
    const std::filesystem::path suite = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "swivel-bench";
    const std::string families = fmt::format("--benchmark_filter={}", kFamilies),
                      time = fmt::format("--benchmark_min_time={:.6f}", options.seconds / kTurns);
    std::vector<const char*> words = {"swivel-bench", families.c_str(), time.c_str(),
                                      "--benchmark_enable_random_interleaving=false"};  // rows in order, as they come
    if (options.json) words.push_back("--benchmark_format=json");
    words.push_back(nullptr);
    execv(suite.c_str(), const_cast<char* const*>(words.data()));  // which changes none of them
    throw CommandError(1, fmt::format("bench: {} does not start: {}; configure with -DSWIVEL_BENCH=ON and build "
                                      "swivel_bench",
                                      suite.string(), std::strerror(errno)));
}

}  // namespace swivel::tools
