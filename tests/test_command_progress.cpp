// SPDX-License-Identifier: MIT
//
// The promise: a bar shows how far a run is, on a terminal alone, within its width, and is wiped.
#include <rapidcheck/catch.h>
#include <catch2/catch.hpp>

#include <algorithm>

#include "tests/run_command.h"
#include "tests/test_data.h"
#include "tools/cli/progress.h"

using namespace swivel::test;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;
using swivel::tools::progress_line;

namespace {

const Surroundings kTerminal{{"TERM=xterm"}, true};
// Long enough for bars, 0.1 s apart, on a machine ten times faster than today's.
const Words kLongRun = {"demo", "--characters", "20000", "--frames", "100"};

}  // namespace

TEST_CASE("progress: the bar is for terminals alone, and wiped")
{
    const TempFolder folder;
    const Outcome piped = spawn_command(folder.path, kLongRun, {{"TERM=xterm"}});
    CHECK(piped.exit_code == 0);
    CHECK(piped.err.empty());
    Surroundings dumb = kTerminal;
    dumb.environment = {"TERM=dumb"};
    CHECK(spawn_command(folder.path, kLongRun, dumb).err.empty());
    const Outcome watched = spawn_command(folder.path, kLongRun, kTerminal);
    CHECK(watched.exit_code == 0);
    CHECK_THAT(watched.err, StartsWith("\r[") && Contains(" of 100 frames") && EndsWith("\r\x1b[K"));
    CHECK_THAT(watched.err, !Contains("\n"));
    CHECK_THAT(watched.out, Contains("million arms/s") && !Contains("\x1b"));
    Words quiet = kLongRun;
    quiet.push_back("--quiet");
    const Outcome silent = spawn_command(folder.path, quiet, kTerminal);
    CHECK(silent.err.empty());
    CHECK_THAT(silent.out, Contains("million arms/s"));
}

TEST_CASE("progress: the bar is narrower than the terminal, as wide as that says it is")
{
    const TempFolder folder;
    const Outcome outcome = spawn_command(folder.path, kLongRun, {{"TERM=xterm"}, true, 24});
    CHECK_THAT(outcome.err, Contains(" %"));
    for (std::size_t at = 0; at < outcome.err.size();) {
        const std::size_t end = outcome.err.find("\x1b[K", at);
        REQUIRE(end != std::string::npos);
        CHECK(outcome.err[at] == '\r');
        CHECK(end - at - 1 < 24);
        at = end + 3;
    }
}

TEST_CASE("progress: a line fits, and says as much as fits")
{
    rc::prop("narrower than the terminal, with all figures where there is room", [] {
        const auto total = *rc::gen::inRange<std::uint64_t>(2, 1'000'000'000'000);
        const auto done = *rc::gen::inRange<std::uint64_t>(0, total + 1);
        const auto columns = *rc::gen::inRange<std::size_t>(0, 200);
        const double seconds = *rc::gen::inRange(0, 1'000'000);
        const std::string line = progress_line(done, total, "frames", seconds, columns);
        RC_ASSERT(line.size() < std::max<std::size_t>(columns, 1));
        RC_ASSERT(line.find_first_of("\r\n") == std::string::npos);
        if (columns > 5) RC_ASSERT(line.find(std::to_string(100 * done / total) + " %") != std::string::npos);
        const std::string wide = progress_line(done, total, "frames", seconds, 200);
        RC_ASSERT(wide.find(std::to_string(done) + " of " + std::to_string(total) + " frames, ") != std::string::npos);
        RC_ASSERT(std::count(wide.begin(), wide.end(), '#') == static_cast<long>(30 * done / total));
        if (wide.size() < columns) RC_ASSERT(line == wide);
    });
}
