// SPDX-License-Identifier: MIT
//
// The suite's progress: a line for each benchmark with its median and notes.
#pragma once

#include <benchmark/benchmark.h>

#include <cstdio>
#include <string>
#include <vector>

namespace bench {

class Progress : public benchmark::ConsoleReporter {
public:
    bool ReportContext(const Context&) override { return true; }  // it would say how Debian's library was built

    void ReportRuns(const std::vector<Run>& runs) override
    {
        double spread = 0;
        for (const Run& run : runs)
            if (run.error_occurred) {
                std::printf("%-40s %s\n", run.benchmark_name().c_str(), run.error_message.c_str());
                return;
            } else if (run.aggregate_name == "cv") {
                spread = 100 * run.counters.at("time/arm");
            }
        for (const Run& run : runs) {
            const bool alone = run.run_type == Run::RT_Iteration && run.repetitions <= 1;
            if (!alone && run.aggregate_name != "median") continue;
            const std::string& name = run.run_name.function_name;
            const auto is_of = [&](const char* row) { return name.starts_with(row); };
            const bool is_body = is_of("bodies") || is_of("character") || is_of("feet") || is_of("looks");
            std::printf("%-40s %10.2f ns %s, +- %.1f %%", name.c_str(), run.counters.at("time/arm") * 1e9,
                        is_body ? "a body" : "an arm", spread);
            for (const auto& [note, value] : run.counters)
                if (note != "time/arm" && note != "arms") std::printf(", %s %.3g", note.c_str(), value.value);
            std::puts("");
        }
        std::fflush(stdout);
    }
};

}  // namespace bench
