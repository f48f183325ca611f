// SPDX-License-Identifier: MIT
//
// What a result depends on: the machine's levels of memory, and the library's build.
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace bench {

// The levels of memory, nearest first, as names of benchmarks have them.
inline constexpr std::array<const char*, 4> kMemoryLevels{"L1", "L2", "L3", "memory"};

// Compiler and flags of the library.
std::string library_build();
// Bytes to work on that are at home in a level: half of a cache, by the operating system or else as usual; in memory
// four times the largest, within 256 MB to 1 GB.
std::array<std::size_t, 4> working_sets();

}  // namespace bench
