// SPDX-License-Identifier: MIT
//
// The bits of a result depend on the floating-point environment. While it lives, this object sets it: round to nearest,
// keep denormals, mask exceptions. Then it restores the caller's environment, sticky flags included. WebAssembly has no
// other environment than this one.
//
// Each function of swivel.h that computes or judges floats does so while one of these lives, mostly from its first line
// on, messages included. The caller's own callbacks run outside it.
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
    // registers: the numbers that the caller has by value. Compilers take the environment for constant, so they would
    // compute with these before it is set. Memory is read after that, and results are written before the end.
    template <class... Numbers>
    explicit FloatEnv(Numbers&... registers)
    {
        enter();
        asm volatile("" : : : "memory");
        (pin(registers), ...);
    }
    ~FloatEnv()
    {
        asm volatile("" : : : "memory");
        leave();
    }
    FloatEnv(const FloatEnv&) = delete;
    FloatEnv& operator=(const FloatEnv&) = delete;

    // While this lives, the environment is the caller's.
    class Outside {
    public:
        explicit Outside(FloatEnv& env) : env_(env)
        {
            asm volatile("" : : : "memory");
            env_.leave();
        }
        ~Outside()
        {
            env_.enter();
            asm volatile("" : : : "memory");
        }
        Outside(const Outside&) = delete;
        Outside& operator=(const Outside&) = delete;

    private:
        FloatEnv& env_;
    };

private:
    template <class Number>
    static void pin(Number& number)
    {
        asm volatile("" : "+m"(number));
    }

#if defined(__x86_64__)
    // glibc's printf rounds decimals as the control word of the x87 unit says, which computes nothing here.
    static constexpr std::uint16_t kRounding = 0x0c00, kMasks = 0x003f;
    void enter()
    {
        saved_ = _mm_getcsr();
        asm volatile("fnstcw %0" : "=m"(saved_word_));
        set_word(static_cast<std::uint16_t>((saved_word_ & ~kRounding) | kMasks));
        _mm_setcsr(0x1f80);  // the reset value: all exceptions masked, no flags
    }
    void leave() const
    {
        _mm_setcsr(saved_);
        set_word(saved_word_);
    }
    void set_word(std::uint16_t word) const
    {
        if ((saved_word_ & (kRounding | kMasks)) == kMasks) return;  // as usual
        asm volatile("fldcw %0" : : "m"(word));
    }

    std::uint32_t saved_;
    std::uint16_t saved_word_;
#elif defined(__aarch64__)
    void enter()
    {
        asm volatile("mrs %0, fpcr\n\tmrs %1, fpsr" : "=r"(saved_), "=r"(saved_flags_));
        asm volatile("msr fpcr, xzr");
    }
    void leave() const { asm volatile("msr fpcr, %0\n\tmsr fpsr, %1" : : "r"(saved_), "r"(saved_flags_)); }

    std::uint64_t saved_, saved_flags_;
#elif defined(__wasm__)
    void enter() {}
    void leave() const {}
#else
    void enter()
    {
        std::fegetenv(&saved_);
        std::fesetenv(FE_DFL_ENV);
    }
    void leave() const { std::fesetenv(&saved_); }

    std::fenv_t saved_;
#endif
};

}  // namespace swivel
