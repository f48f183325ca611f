// SPDX-License-Identifier: MIT
//
// The suite's progress, a line for each benchmark, and its medians for the tables that follow.
#pragma once

#include <benchmark/benchmark.h>

#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace bench {

class Medians : public benchmark::ConsoleReporter {
public:
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
            const double ns = run.counters.at("time/arm") * 1e9;
            ns_[run.run_name.function_name] = ns;
            std::printf("%-40s %10.2f ns an arm, +- %.1f %%", run.run_name.function_name.c_str(), ns, spread);
            if (const auto bytes = run.counters.find("bytes/arm"); bytes != run.counters.end())
                std::printf(", %.0f bytes an arm", bytes->second.value);
            std::puts("");
        }
        std::fflush(stdout);
    }

    // Nanoseconds an arm; nothing for a benchmark that did not run.
    std::optional<double> ns(const std::string& name) const
    {
        const auto at = ns_.find(name);
        if (at == ns_.end()) return std::nullopt;
        return at->second;
    }

private:
    std::map<std::string, double> ns_;
};

}  // namespace bench
