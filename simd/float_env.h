// SPDX-License-Identifier: MIT
//
// The bits of a result depend on the floating-point environment. While it lives, this object sets it: round to nearest,
// keep denormals, mask exceptions. Then it restores the caller's environment, sticky flags included. WebAssembly has no
// other environment than this one.
#pragma once

#include <cstdint>

#if defined(__x86_64__)
#include <xmmintrin.h>
#elif !defined(__aarch64__) && !defined(__wasm__)
#include <cfenv>
#endif

namespace swivel {

class FloatEnv {
public:
#if defined(__x86_64__)
    FloatEnv() : saved_(_mm_getcsr()) { _mm_setcsr(0x1f80); }  // the reset value: all exceptions masked, no flags
    ~FloatEnv() { _mm_setcsr(saved_); }
#elif defined(__aarch64__)
    FloatEnv()
    {
        asm volatile("mrs %0, fpcr\n\tmrs %1, fpsr" : "=r"(saved_), "=r"(saved_flags_));
        asm volatile("msr fpcr, xzr");
    }
    ~FloatEnv() { asm volatile("msr fpcr, %0\n\tmsr fpsr, %1" : : "r"(saved_), "r"(saved_flags_)); }
#elif defined(__wasm__)
    FloatEnv() {}  // not defaulted: a variable of a type that does nothing would be unused
    ~FloatEnv() {}
#else
    FloatEnv()
    {
        std::fegetenv(&saved_);
        std::fesetenv(FE_DFL_ENV);
    }
    ~FloatEnv() { std::fesetenv(&saved_); }
#endif
    FloatEnv(const FloatEnv&) = delete;
    FloatEnv& operator=(const FloatEnv&) = delete;

private:
#if defined(__x86_64__)
    std::uint32_t saved_;
#elif defined(__aarch64__)
    std::uint64_t saved_, saved_flags_;
#elif !defined(__wasm__)
    std::fenv_t saved_;
#endif
};

}  // namespace swivel
