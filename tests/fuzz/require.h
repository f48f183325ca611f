#pragma once
// SPDX-License-Identifier: MIT
// What must hold whatever the input. A fuzzer takes the abort for a finding and keeps the input; fuzz_seeds fails.

#include <cstdio>
#include <cstdlib>

namespace swivel::fuzz {

[[noreturn]] inline void report(const char* condition, const char* file, int line)
{
    std::fprintf(stderr, "%s:%d: does not hold: %s\n", file, line, condition);
    std::abort();
}

}  // namespace swivel::fuzz

#define SWIVEL_REQUIRE(condition) \
    ((condition) ? static_cast<void>(0) : ::swivel::fuzz::report(#condition, __FILE__, __LINE__))
