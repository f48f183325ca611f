// SPDX-License-Identifier: MIT
//
// swivel_bench measures swivel's kernels with each instruction set and in each level of memory, on one thread and on
// several. The same run measures textbook rivals. Before timing, it checks all results by forward kinematics: the
// wrists of ordinary arms must be on their targets.
//
//   cmake --preset dev && cmake --build --preset dev && bench/run
//
// bench/run starts it and keeps its result. `swivel lab bench` runs a few families of it. Repetitions are in random
// order, and medians are shown: of the CPU time, or of threads by the clock on the wall. It takes some minutes and 1
// GB. Google Benchmark's own flags come after: --benchmark_filter=P/, --benchmark_repetitions=...,
// --benchmark_out=result.json.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string_view>

#include "bench/progress.h"
#include "bench/rivals/cpu_model.h"
#include "bench/rivals/level.h"
#include "bench/suite.h"

namespace {

using namespace bench;

void note(const std::string& key, const std::string& value) { benchmark::AddCustomContext(key, value); }

// What a result file says beside its times.
void note_context(const Suite& suite)
{
    std::string isas;
    for (const std::string& isa : suite.isas) isas += (isas.empty() ? "" : " ") + isa;
    note("cpu", cpu_model());
    note("isas", isas);
    note("commit", SWIVEL_COMMIT);
    note("library_build", library_build());
    for (const Level* level : runnable_levels()) {
        note(std::string("rivals_build/") + level->name, level->flags);
        if (level->ozz_flags) note(std::string("ozz_build/") + level->name, level->ozz_flags);
        for (const Loop& loop : level->loops) note(std::string("how/") + loop.name + "/" + level->name, loop.how);
    }
}

int run(int argc, char** argv)
{
    const bool is_json = std::ranges::count(argv, argv + argc, std::string_view("--benchmark_format=json")) > 0;
    // Defaults first, so that the caller's flags win.
    std::vector<std::string> defaults{"swivel_bench", "--benchmark_repetitions=9", "--benchmark_min_time=0.05",
                                      "--benchmark_enable_random_interleaving=true",
                                      "--benchmark_report_aggregates_only=true"};
    std::vector<char*> args;
    for (std::string& text : defaults) args.push_back(text.data());
    args.insert(args.end(), argv + 1, argv + argc);
    int arg_count = static_cast<int>(args.size());
    args.push_back(nullptr);
    benchmark::Initialize(&arg_count, args.data());
    if (benchmark::ReportUnrecognizedArguments(arg_count, args.data())) return 2;

    Suite suite;
    note_context(suite);
    if (!is_json) std::printf("cpu      %s\nlibrary  %s\n", cpu_model().c_str(), library_build().c_str());
    add_bounds(suite);
    add_problem_p(suite);
    add_resident(suite);
    add_production(suite);
    add_bodies(suite);
    add_feet(suite);
    add_looks(suite);
    add_regions(suite);
    add_character(suite);
    add_frames(suite);
    add_threads(suite);

    Progress progress;
    benchmark::JSONReporter json;
    benchmark::RunSpecifiedBenchmarks(is_json ? static_cast<benchmark::BenchmarkReporter*>(&json) : &progress);
    benchmark::Shutdown();
    return 0;
}

}  // namespace

int main(int argc, char** argv)
{
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "swivel_bench: %s\n", error.what());
        return 1;
    }
}
