// SPDX-License-Identifier: MIT
//
// swivel-race SECONDS [--json] [--quiet], which `swivel bench` runs: how fast this machine solves, beside textbook
// rivals in the same run, and how far that is from what the machine can do. The short version of bench/. A program of
// its own, so that the command needs no rivals to build.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>

#include "tools/cli/command_error.h"
#include "tools/cli/process.h"
#include "tools/race/report.h"
#include "tools/swivel/report.h"

namespace {

void race(int argc, char** argv)
{
    using namespace swivel::tools;
    const double seconds = argc > 1 ? std::strtod(argv[1], nullptr) : 0;
    const auto has = [&](const char* word) {
        return std::any_of(argv + std::min(argc, 2), argv + argc,
                           [&](const char* each) { return std::strcmp(each, word) == 0; });
    };
    const bool json = has("--json"), quiet = has("--quiet");
    if (!(seconds > 0) || argc != 2 + json + quiet)
        throw CommandError(2, "usage: swivel-race SECONDS [--json] [--quiet]");
    const Measured measured = measure(seconds, quiet);
    if (json)
        print_json(json_of(measured));
    else
        print_measured(measured);
}

}  // namespace

int main(int argc, char** argv)
{
    using namespace swivel::tools;
    return run_process([&] { return run_to_end([&] { race(argc, argv); }); });
}
