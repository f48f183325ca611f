// SPDX-License-Identifier: MIT
//
// A floating-point environment as a caller may have it: another rounding, and where there is such a thing denormals
// that are flushed.
#pragma once

#include <cfenv>

#ifdef __x86_64__
#include <xmmintrin.h>
#endif

namespace swivel::test {

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
