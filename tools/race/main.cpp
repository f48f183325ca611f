// SPDX-License-Identifier: MIT
//
// swivel-race SECONDS [--json] [--quiet] [--report FILE], which `swivel bench` runs: how fast this machine solves,
// beside textbook rivals in the same run, and how far that is from what the machine can do. The short version of
// bench/. A program of its own, so that the command needs no rivals to build.
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "tools/cli/command_error.h"
#include "tools/cli/process.h"
#include "tools/cli/streams.h"
#include "tools/race/html_report.h"
#include "tools/race/report.h"
#include "tools/swivel/report.h"
#include "tools/swivel/report_file.h"

namespace {

void race(int argc, char** argv)
{
    using namespace swivel::tools;
    const double seconds = argc > 1 ? std::strtod(argv[1], nullptr) : 0;
    bool json = false, quiet = false, is_right = seconds > 0;
    std::string place;
    for (int n = 2; n < argc; ++n) {
        const std::string_view word = argv[n];
        if (word == "--json")
            json = true;
        else if (word == "--quiet")
            quiet = true;
        else if (word == "--report" && n + 1 < argc)
            place = argv[++n];
        else
            is_right = false;
    }
    if (!is_right) throw CommandError(2, "usage: swivel-race SECONDS [--json] [--quiet] [--report FILE]");
    require_report_file(place);
    const Measured measured = measure(seconds, !place.empty(), quiet);  // only a report shows sizes
    if (!place.empty()) write_report(place, "swivel bench", [&](Report& report) { put_measured(report, measured); });
    if (json)
        print_json(json_of(measured));
    else
        print_measured(measured);
    if (!place.empty() && !json) say(stdout, "\nwritten  {}\n", place);
}

}  // namespace

int main(int argc, char** argv)
{
    using namespace swivel::tools;
    return run_process([&] { return run_to_end([&] { race(argc, argv); }); });
}
