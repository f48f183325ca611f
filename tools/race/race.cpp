// SPDX-License-Identifier: MIT
#include "tools/race/race.h"

#include <algorithm>
#include <random>
#include <stdexcept>

#include "bench/rivals/timing.h"
#include "tools/cli/progress.h"

namespace swivel::tools {

namespace {

constexpr std::size_t kRounds = 9;

}  // namespace

void Race::add(std::string name, std::size_t arm_count, std::function<void()> work)
{
    runners_.push_back({std::move(name), static_cast<double>(arm_count), std::move(work), {}});
}

void Race::run(double seconds, bool quiet)
{
    const std::size_t turns = kRounds * runners_.size();
    const double share_ns = seconds * 1e9 / static_cast<double>(turns);
    std::vector<Runner*> order;
    for (Runner& runner : runners_) order.push_back(&runner);
    std::mt19937 random(1);
    Progress progress("turns", turns, quiet);
    for (std::size_t turn = 0; turn < turns; ++turn) {
        progress.show(turn);
        const std::size_t place = turn % order.size();
        if (place == 0) std::shuffle(order.begin(), order.end(), random);
        // Finding out how often to call takes about as long as calling.
        order[place]->rounds.push_back(bench::ns_a_call(order[place]->work, share_ns / 2));
    }
}

double Race::ns(const std::string& name) const
{
    for (const Runner& runner : runners_)
        if (runner.name == name) return bench::median(runner.rounds) / runner.arm_count;
    throw std::out_of_range("nobody called " + name + " was timed");
}

}  // namespace swivel::tools
