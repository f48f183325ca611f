// SPDX-License-Identifier: MIT
//
// The machine's limits, measured: what its arithmetic and its memory can do at most, to hold solvers against.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace bench {

struct IsaLimits {
    std::string isa;
    double lanes;           // floats in a register
    double flops_per_ns;    // multiplications and additions, half and half, none fused
    double division_ns;     // of a register, one after the other
    double root_ns;         // the same
    double divide_root_ns;  // of a division and a root together
};

// The levels of memory, nearest first, as names of benchmarks have them.
inline constexpr std::array<const char*, 4> kMemoryLevels{"L1", "L2", "L3", "memory"};

struct Machine {
    std::string cpu;
    std::array<std::size_t, 3> cache_bytes;  // as the operating system tells, or what is usual
    std::vector<IsaLimits> isas;             // those that run here, best first
    // Bytes a nanosecond that a copy reads and writes, within each level, on one thread with the best instruction set.
    // The second number is for a copy in memory that writes past the caches.
    std::array<double, 4> copy_bytes_per_ns;
    double streamed_bytes_per_ns;
};

// Compiler and flags of the library.
std::string library_build();
// Bytes to work on that are at home in a level: half of a cache; in memory four times the largest, within 256 MB to 1
// GB.
std::array<std::size_t, 4> working_sets();
// Takes about a second.
Machine measure_machine();

// Of machine.isas.
const IsaLimits& limits_of(const Machine& machine, const std::string& isa);

}  // namespace bench
