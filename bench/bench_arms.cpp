// SPDX-License-Identifier: MIT
//
// Times problem P (targets, poles and bone lengths in; shoulder rotors, half flexions and flags out) by swivel, by the
// textbook rivals on the same arms, and as a bare copy of the same rows. Before timing, forward kinematics of
// everyone's results must put the wrists of ordinary arms within 1e-3 of their targets.
//
//   cmake -B build -DSWIVEL_BENCH=ON -DCMAKE_BUILD_TYPE=Release && cmake --build build && build/bench/swivel_bench
//
// Nine repetitions in random order, medians shown (of the CPU time; threads/ by the clock on the wall), and at the end
// the ratios that README.md quotes. Google Benchmark's own flags come after: --benchmark_filter=cache/,
// --benchmark_repetitions=..., --benchmark_out=result.json. Debian's libbenchmark says that it "was built as DEBUG";
// that is its own build and does not touch what is measured.
#include <benchmark/benchmark.h>
#include <oneapi/tbb/task_arena.h>
#include <swivel/swivel.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "rivals.h"

namespace {

using namespace bench;

constexpr std::size_t kCachedArms = 1024;   // 60 KB of rows: within a level 2 cache
constexpr std::size_t kThreadArms = 65536;  // 4 MB: enough chunks for the threads, within level 3
constexpr std::size_t kManyArms = (std::size_t{256} << 20) / 60 / 16 * 16 + 16;  // 256 MB of rows

swivel::Crowd make_crowd(std::size_t arm_count)
{
    const swivel_group_def group{static_cast<std::uint32_t>(arm_count), {}};
    return swivel::Crowd(0, {&group, 1});
}

// Arms repeat where the crowd is larger than they are.
swivel::Crowd fill(std::size_t arm_count, const Arms& arms)
{
    swivel::Crowd crowd = make_crowd(arm_count);
    const swivel_rows rows = swivel_input_rows(crowd.get());
    for (std::size_t n = 0; n < arm_count; ++n)
        for (std::size_t row = 0; row < 8; ++row)
            rows.base[(n / 16 * rows.row_count + row) * 16 + n % 16] = arms[row][n % arms.count()];
    return crowd;
}

// ---- are the results right?

struct Vec {
    double x, y, z;
};
Vec turn(const double (&q)[4], Vec v)
{
    const auto [x, y, z] = v;
    const double tx = 2 * (q[1] * z - q[2] * y), ty = 2 * (q[2] * x - q[0] * z), tz = 2 * (q[0] * y - q[1] * x);
    return {x + q[3] * tx + q[1] * tz - q[2] * ty, y + q[3] * ty + q[2] * tx - q[0] * tz,
            z + q[3] * tz + q[0] * ty - q[1] * tx};
}

// The worst wrist error of the ordinary arms, in arm lengths; infinite if an elbow is off its pole's side.
double worst_error(const Crowd& crowd, const Poses& poses)
{
    double worst = 0;
    for (std::size_t n = 0; n < crowd.arms.count(); ++n) {
        if (!crowd.ordinary[n]) continue;
        const Arms& a = crowd.arms;
        const double q[4] = {poses[0][n], poses[1][n], poses[2][n], poses[3][n]}, c = poses[4][n], s = poses[5][n];
        const double upper = a[6][n], fore = a[7][n];
        const Vec elbow = turn(q, {0, 0, upper}),
                  wrist = turn(q, {0, 2 * c * s * fore, upper + (c * c - s * s) * fore});
        const Vec t{a[0][n], a[1][n], a[2][n]}, p{a[3][n], a[4][n], a[5][n]};
        const double error = std::hypot(wrist.x - t.x, wrist.y - t.y, wrist.z - t.z) / (upper + fore);
        const double t2 = t.x * t.x + t.y * t.y + t.z * t.z, tp = t.x * p.x + t.y * p.y + t.z * p.z;
        const double te = t.x * elbow.x + t.y * elbow.y + t.z * elbow.z,
                     ep = elbow.x * p.x + elbow.y * p.y + elbow.z * p.z;
        const bool right_side = ep - te * tp / t2 > 0;
        worst = std::fmax(worst, right_side ? error : INFINITY);
        if (!std::isfinite(error)) worst = INFINITY;
    }
    return worst;
}

Poses results_of(swivel::Crowd& crowd, std::size_t arm_count)
{
    const swivel_rows rows = swivel_result_rows(crowd.get());
    Poses poses(arm_count);
    for (std::size_t n = 0; n < arm_count; ++n)
        for (std::size_t row = 0; row < 7; ++row)
            poses[row][n] = rows.base[(n / 16 * rows.row_count + row) * 16 + n % 16];
    return poses;
}

bool check(const char* name, const Crowd& crowd, const Poses& poses)
{
    const double worst = worst_error(crowd, poses);
    std::fprintf(stderr, "%-12s worst wrist error of ordinary arms %.1e\n", name, worst);
    if (worst < 1e-3) return true;
    std::fprintf(stderr, "swivel_bench: %s does not solve these arms; nothing is measured\n", name);
    return false;
}

// ---- what is measured

enum class Clock { cpu, wall };  // of the one thread that works; of several threads together

void add(const std::string& name, std::size_t arm_count, Clock clock, std::function<void()> solve)
{
    auto* timed = benchmark::RegisterBenchmark(name.c_str(), [arm_count, solve](benchmark::State& state) {
        solve();
        for (auto _ : state) {
            solve();
            benchmark::ClobberMemory();
        }
        state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(arm_count));
        // The inverted rate of arms: seconds an arm, shown with their unit ("2.8ns").
        state.counters["time/arm"] = {static_cast<double>(arm_count),
                                      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert};
    });
    if (clock == Clock::wall) timed->UseRealTime();
}

// Shows the console's table, and keeps the medians.
class Medians : public benchmark::ConsoleReporter {
public:
    Medians() : ConsoleReporter(OO_Tabular) {}
    void ReportRuns(const std::vector<Run>& runs) override
    {
        for (const Run& run : runs)
            if (run.aggregate_name == "median") ns_[run.run_name.function_name] = run.counters.at("time/arm") * 1e9;
        ConsoleReporter::ReportRuns(runs);
    }
    void ratio(const std::string& slow, const std::string& fast) const
    {
        const auto a = ns_.find(slow), b = ns_.find(fast);
        if (a == ns_.end() || b == ns_.end()) return;
        std::printf("%-28s %7.2f ns   %-28s %7.2f ns   ratio %.2f\n", slow.c_str(), a->second, fast.c_str(), b->second,
                    a->second / b->second);
    }

private:
    std::map<std::string, double> ns_;
};

std::string cpu_model()
{
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown";
}

std::vector<std::string> runnable_isas()
{
    std::vector<std::string> names;
    for (std::uint32_t n = 0; const char* name = swivel_isa_at(n); ++n)
        if (swivel_isa_runs(name)) names.emplace_back(name);
    return names;
}

int run(int argc, char** argv)
{
    // Defaults first, so that the caller's flags win.
    std::vector<std::string> defaults{argv[0], "--benchmark_repetitions=9", "--benchmark_min_time=0.05",
                                      "--benchmark_enable_random_interleaving=true",
                                      "--benchmark_display_aggregates_only=true"};
    std::vector<char*> args;
    for (std::string& text : defaults) args.push_back(text.data());
    args.insert(args.end(), argv + 1, argv + argc);
    int arg_count = static_cast<int>(args.size());
    args.push_back(nullptr);
    benchmark::Initialize(&arg_count, args.data());
    if (benchmark::ReportUnrecognizedArguments(arg_count, args.data())) return 2;

    const std::vector<std::string> isas = runnable_isas();
    std::string isa_list;
    for (const std::string& isa : isas) isa_list += (isa_list.empty() ? "" : " ") + isa;
    benchmark::AddCustomContext("cpu", cpu_model());
    benchmark::AddCustomContext("isas, best first", isa_list);
    benchmark::AddCustomContext("swivel built by", SWIVEL_BENCH_COMPILER);
    benchmark::AddCustomContext("rivals built by", rival_compiler());

    const Crowd cached = random_crowd(kCachedArms);
    swivel::Crowd small = fill(kCachedArms, cached.arms);
    swivel::Crowd medium = fill(kThreadArms, random_crowd(kThreadArms).arms);
    swivel::Crowd large = fill(kManyArms, random_crowd(kThreadArms).arms);
    Poses poses(kCachedArms);
    const std::unique_ptr<SingleCrowd, void (*)(SingleCrowd*)> single(make_single(cached.arms), free_single);

    bool right = true;
    for (const std::string& isa : isas) {
        swivel::check(swivel_use_isa(isa.c_str()));
        small.solve();
        right = right && check(isa.c_str(), cached, results_of(small, kCachedArms));
    }
    solve_single(*single);
    read_single(*single, poses);
    right = right && check("single glm", cached, poses);
    solve_loop_trig(cached.arms, poses);
    right = right && check("loop trig", cached, poses);
    solve_loop_light(cached.arms, poses);
    right = right && check("loop light", cached, poses);
    solve_loop_roots(cached.arms, poses);
    right = right && check("loop roots", cached, poses);
    if (!right) return 1;

    const auto solve_all_blocks = [](swivel::Crowd& crowd, const std::string& isa) {
        swivel::check(swivel_use_isa(isa.c_str()));
        crowd.solve_blocks(0, swivel_block_count(crowd.get()));
    };
    for (const std::string& isa : isas)
        add("cache/swivel_" + isa, kCachedArms, Clock::cpu, [&, isa] { solve_all_blocks(small, isa); });
    add("cache/loop_trig", kCachedArms, Clock::cpu, [&] { solve_loop_trig(cached.arms, poses); });
    add("cache/loop_light", kCachedArms, Clock::cpu, [&] { solve_loop_light(cached.arms, poses); });
    add("cache/loop_roots", kCachedArms, Clock::cpu, [&] { solve_loop_roots(cached.arms, poses); });
    add("cache/single_glm", kCachedArms, Clock::cpu, [&] { solve_single(*single); });
    for (const std::string& isa : isas)
        add("memory/swivel_" + isa, kManyArms, Clock::cpu, [&, isa] { solve_all_blocks(large, isa); });
    add("memory/copy", kManyArms, Clock::cpu, [&] {
        const swivel_rows in = swivel_input_rows(large.get()), out = swivel_result_rows(large.get());
        copy_rows(in.base, out.base, in.block_count);
    });
    for (const int threads : {1, 2})
        add("threads/" + std::to_string(threads), kThreadArms, Clock::wall,
            [&, arena = std::make_shared<oneapi::tbb::task_arena>(threads)] {
                swivel::check(swivel_use_isa(isas.front().c_str()));
                arena->execute([&] { medium.solve(); });
            });

    Medians medians;
    benchmark::RunSpecifiedBenchmarks(&medians);
    benchmark::Shutdown();
    std::puts("\nMedians, nanoseconds an arm:");
    const std::string best = "cache/swivel_" + isas.front();
    medians.ratio("cache/loop_trig", best);
    medians.ratio("cache/loop_light", best);
    medians.ratio("cache/loop_roots", best);
    medians.ratio("cache/single_glm", best);
    for (const std::string& isa : isas) medians.ratio("cache/swivel_" + isa, best);
    for (const std::string& isa : isas) medians.ratio("memory/swivel_" + isa, "memory/copy");
    medians.ratio("threads/1", "threads/2");
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
