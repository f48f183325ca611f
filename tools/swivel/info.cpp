// SPDX-License-Identifier: MIT
//
// `swivel info`: what this machine is and what the library was built with.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "bench/rivals/cpu_model.h"
#include "swivel/swivel.hpp"
#include "tools/cli/command_error.h"
#include "tools/cli/streams.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/report.h"

namespace swivel::tools {

namespace {

Json describe()
{
    const char* isa = swivel_isa_name();
    if (!isa) throw CommandError(1, swivel_last_error());
    Json out;
    const std::uint32_t version = swivel_version();
    out["swivel"] = fmt::format("{}.{}.{}", version / 10000, version / 100 % 100, version % 100);
    out["cpu"] = bench::cpu_model();
    out["cores"] = std::thread::hardware_concurrency();
    out["isa"] = isa;
    for (std::uint32_t n = 0; const char* name = swivel_isa_at(n); ++n)
        out["built"][name] = swivel_isa_runs(name) ? "runs here" : "does not run here";
    out["compiler"] = SWIVEL_COMPILER;
    out["build_type"] = SWIVEL_BUILD_TYPE;
    out["flags"] = SWIVEL_FLAGS_TEXT;
#ifdef SWIVEL_WITH_TBB
    out["threads"] = "oneTBB";
#else
    out["threads"] = "none";
#endif
    return out;
}

}  // namespace

void run_info(const InfoOptions& options)
{
    const Json info = describe();
    if (options.json) {
        print_json(info);
        return;
    }
    for (const auto& [key, value] : info.items())
        if (!value.is_object())
            say(stdout, "{:<12} {}\n", key, value.is_string() ? value.get<std::string>() : value.dump());
    for (const auto& [name, state] : info["built"].items())
        say(stdout, "{:<12} {}, {}\n", "built for", name, state.get<std::string>());
}

}  // namespace swivel::tools
