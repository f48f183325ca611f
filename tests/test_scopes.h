// SPDX-License-Identifier: MIT
//
// For tests that change the whole process or thread, and put back how it was: another instruction set; or another
// floating-point environment, as a caller may have it.
#pragma once

#include <catch2/catch.hpp>
#include <cfenv>
#include <string>
#include <vector>

#ifdef __x86_64__
#include <xmmintrin.h>
#endif

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

// Another rounding, and where there is such a thing denormals that are flushed.
struct OtherEnvironment {
    OtherEnvironment()
    {
        std::feclearexcept(FE_ALL_EXCEPT);
        std::fesetround(FE_UPWARD);
        flush(true);
    }
    ~OtherEnvironment()
    {
        flush(false);
        std::fesetround(FE_TONEAREST);
        std::feclearexcept(FE_ALL_EXCEPT);
    }
    OtherEnvironment(const OtherEnvironment&) = delete;
    static bool is()
    {
#ifdef __x86_64__
        if ((_mm_getcsr() & kFlushes) != kFlushes) return false;
#endif
        return std::fegetround() == FE_UPWARD;
    }

private:
#ifdef __x86_64__
    static constexpr unsigned kFlushes = 0x8040;
    static void flush(bool does) { _mm_setcsr(does ? _mm_getcsr() | kFlushes : _mm_getcsr() & ~kFlushes); }
#else
    static void flush(bool) {}
#endif
};

}  // namespace swivel::test
