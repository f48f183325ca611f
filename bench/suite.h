// SPDX-License-Identifier: MIT
//
// What the suite's files share: the instruction sets, the crowds that several benchmarks solve, and how one is added.
// Names have slashes, so that --benchmark_filter picks families: P/, resident/, frame/, production/, threads/...
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/rivals/limbs.h"
#include "bench/rivals/machine.h"

namespace bench {

// Crowds are made when first asked for and kept: filling the largest takes longer than solving it.
class Crowds {
public:
    swivel::Crowd& get(swivel_features features, std::size_t arm_count);

private:
    std::vector<Limb> limbs_ = random_limbs(65536);
    std::map<std::pair<swivel_features, std::size_t>, swivel::Crowd> crowds_;
};

struct Suite {
    std::vector<std::string> isas = runnable_isas();  // best first
    Crowds crowds;

    const std::string& best_isa() const { return isas.front(); }
};

enum class Clock { cpu, wall };  // of the one thread that works; of several threads together
using Work = std::function<void()>;
using Notes = std::vector<std::pair<std::string, double>>;  // shown beside a time: "limited", 0.22

// prepare is called at the start of every repetition; what it returns is timed.
void add(const std::string& name, std::size_t arm_count, Clock clock, std::function<Work()> prepare, Notes notes = {});
// The note of a solver's worst error, in arm lengths, for add(). Throws if it is too large to be timed.
Notes checked(const std::string& name, double worst_error);
// A crowd solved by that instruction set on one thread: one of the suite's, or one's own.
void add_solve(Suite& suite, const std::string& name, const std::string& isa, swivel_features features,
               std::size_t arm_count, Notes notes = {});
void add_solve(const std::string& name, const std::string& isa, std::shared_ptr<swivel::Crowd> crowd, Notes notes = {});
// A solve of all blocks on that many threads: in an arena of oneTBB, or without oneTBB as own jobs. These take a
// workspace of the crowd each.
Work solve_on(int threads, swivel::Crowd& crowd, const swivel::Job& job);

// Cores that this process may run on.
int core_count();

// One for each family. They also check what they are going to time, and throw if someone's results are wrong.
void add_bounds(Suite& suite);
void add_problem_p(Suite& suite);
void add_resident(Suite& suite);
void add_regions(Suite& suite);
void add_production(Suite& suite);
void add_bodies(Suite& suite);
void add_feet(Suite& suite);
void add_looks(Suite& suite);
void add_character(Suite& suite);
void add_frames(Suite& suite);
void add_threads(Suite& suite);

}  // namespace bench
