// SPDX-License-Identifier: MIT
//
// What `swivel bench` measures, in one run, as numbers.
#pragma once

#include <string>
#include <vector>

#include "bench/rivals/machine.h"
#include "bench/rivals/op_counts.h"

namespace swivel::tools {

// Two that do the same work beside each other, in nanoseconds an arm.
struct Pair {
    std::string work;  // "P in cache"
    std::string isa;   // swivel's
    std::string own, other;
    std::string note;  // on the other
    double own_ns, other_ns;
};

struct Bound {
    std::string isa;
    bench::PortBound bound;
    double measured_ns;  // of problem P in cache
};

// Problem P on one thread, by the size of its crowd.
struct Size {
    std::size_t arms;
    double plain_ns, resident_ns;  // an arm
};

struct Measured {
    bench::Machine machine;
    bench::OpCounts ops;
    std::size_t row_bytes;  // of an arm in problem P
    double memory_ns;       // of an arm in problem P, out of cache
    std::string isa;        // that the process uses
    std::vector<Pair> pairs;
    std::vector<Size> sizes{};  // empty unless they were wanted
    std::vector<Bound> bounds;  // one for each instruction set that runs here, best first
};

// Takes about that many seconds and two more. with_sizes: times crowds of many sizes, too, which leaves less time for
// each of the others. quiet: shows no progress. Throws CommandError if someone's results are wrong.
Measured measure(double seconds, bool with_sizes, bool quiet);

}  // namespace swivel::tools
