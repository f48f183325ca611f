// SPDX-License-Identifier: MIT
//
// For tests that change the instruction set of the whole process.
#pragma once

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "swivel/swivel.h"

namespace swivel::test {

// Puts back the instruction set that was in use.
struct IsaScope {
    std::string before = swivel_isa_name();
    IsaScope() = default;
    ~IsaScope() { swivel_use_isa(before.c_str()); }
    IsaScope(const IsaScope&) = delete;
    IsaScope& operator=(const IsaScope&) = delete;
};

// Those this machine runs; the others are named as skipped.
inline std::vector<std::string> runnable_isas()
{
    std::vector<std::string> names;
    for (std::uint32_t n = 0; const char* name = swivel_isa_at(n); ++n) {
        if (swivel_isa_runs(name))
            names.push_back(name);
        else
            WARN("skipped: this CPU does not run " << name);
    }
    return names;
}

}  // namespace swivel::test
