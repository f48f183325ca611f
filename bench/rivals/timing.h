// SPDX-License-Identifier: MIT
//
// A stopwatch: nanoseconds of the clock on the wall, and medians of them.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

namespace bench {

inline double now_ns()
{
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// What a call of work takes, called often enough to take least_ns together.
template <class Work>
double ns_a_call(Work&& work, double least_ns)
{
    for (std::size_t calls = 1;;) {
        const double start = now_ns();
        for (std::size_t n = 0; n < calls; ++n) work();
        const double ns = now_ns() - start;
        if (ns >= least_ns) return ns / static_cast<double>(calls);
        // A clock that has not moved: ten times as many.
        const double wanted = static_cast<double>(calls) * std::min(10.0, 1.2 * least_ns / std::max(ns, 1.0));
        calls = std::max(calls + 1, static_cast<std::size_t>(wanted));
    }
}

// values: one or more.
inline double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

}  // namespace bench
