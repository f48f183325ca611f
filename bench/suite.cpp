// SPDX-License-Identifier: MIT
#include "bench/suite.h"

#include <benchmark/benchmark.h>

#include <stdexcept>

#include "bench/rivals/check.h"

namespace bench {

swivel::Crowd& Crowds::get(swivel_features features, std::size_t arm_count)
{
    const std::pair key(features, arm_count);
    const auto at = crowds_.find(key);
    if (at != crowds_.end()) return at->second;
    return crowds_.emplace(key, make_crowd(features, arm_count, limbs_)).first->second;
}

void add(const std::string& name, std::size_t arm_count, Clock clock, std::function<Work()> prepare, Notes notes)
{
    auto* timed = benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
        const Work work = prepare();
        work();
        for (auto _ : state) {
            work();
            benchmark::ClobberMemory();
        }
        const auto arms = static_cast<double>(arm_count);
        // The inverted rate of arms: seconds an arm, shown with their unit ("2.8ns").
        state.counters["time/arm"] = {arms,
                                      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert};
        state.counters["arms"] = arms;
        for (const auto& [note, value] : notes) state.counters[note] = value;
    });
    if (clock == Clock::wall) timed->UseRealTime();
}

Notes checked(const std::string& name, double worst_error)
{
    if (worst_error < kRightWithin) return {{"error", worst_error}};
    throw std::runtime_error(name + " does not solve these arms; nothing is measured");
}

namespace {

Work solve_here(swivel::Crowd& crowd, const std::string& isa)
{
    swivel::check(swivel_use_isa(isa.c_str()));
    swivel_job job = swivel_default_job();
    job.on_this_thread = 1;
    return [&crowd, job] { swivel::check(swivel_solve(crowd.get(), &job)); };
}

}  // namespace

void add_solve(Suite& suite, const std::string& name, const std::string& isa, swivel_features features,
               std::size_t arm_count, Notes notes)
{
    const auto prepare = [&suite, isa, features, arm_count] {
        return solve_here(suite.crowds.get(features, arm_count), isa);
    };
    add(name, arm_count, Clock::cpu, prepare, std::move(notes));
}

void add_solve(const std::string& name, const std::string& isa, std::shared_ptr<swivel::Crowd> crowd, Notes notes)
{
    const std::size_t arm_count = swivel_group_limb_count(crowd->get(), 0);
    add(
        name, arm_count, Clock::cpu, [isa, crowd] { return solve_here(*crowd, isa); }, std::move(notes));
}

}  // namespace bench
