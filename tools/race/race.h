// SPDX-License-Identifier: MIT
//
// Times several pieces of work in turns, so that a machine that slows down for a while does so for all of them.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace swivel::tools {

class Race {
public:
    // work solves, or stands for, that many arms.
    void add(std::string name, std::size_t arm_count, std::function<void()> work);

    // Shares about that many seconds among all, in rounds of random order; a piece that takes longer than its share
    // runs once a round. Shows progress unless quiet.
    void run(double seconds, bool quiet);

    // Nanoseconds an arm: the median of the rounds. Only names that were added, after run().
    double ns(const std::string& name) const;

private:
    struct Runner {
        std::string name;
        double arm_count;
        std::function<void()> work;
        std::vector<double> rounds;  // nanoseconds a call
    };
    std::vector<Runner> runners_;
};

}  // namespace swivel::tools
