// SPDX-License-Identifier: MIT
//
// The arithmetic of a probe, and its table; compiled once for each instruction set. SWIVEL_PROBE_SCALAR: a register is
// one float.
#include "bench/rivals/probe.h"

#include <cmath>
#include <utility>

#if defined(__x86_64__)
#include <immintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

namespace bench::SWIVEL_ISA {

namespace {

#if defined(SWIVEL_PROBE_SCALAR) || !(defined(__x86_64__) || defined(__aarch64__))
using Wide = float;
inline Wide broadcast(float x) { return x; }
inline Wide root_of(Wide x) { return std::sqrt(x); }
#elif defined(__AVX512F__)
using Wide = __m512;
inline Wide broadcast(float x) { return _mm512_set1_ps(x); }
inline Wide root_of(Wide x) { return _mm512_sqrt_ps(x); }
#elif defined(__AVX2__)
using Wide = __m256;
inline Wide broadcast(float x) { return _mm256_set1_ps(x); }
inline Wide root_of(Wide x) { return _mm256_sqrt_ps(x); }
#elif defined(__x86_64__)
using Wide = __m128;
inline Wide broadcast(float x) { return _mm_set1_ps(x); }
inline Wide root_of(Wide x) { return _mm_sqrt_ps(x); }
#else
using Wide = float32x4_t;
inline Wide broadcast(float x) { return vdupq_n_f32(x); }
inline Wide root_of(Wide x) { return vsqrtq_f32(x); }
#endif

// The compiler may not know this value from here on, and has to have worked it out.
inline void keep(Wide& x)
{
#if defined(__x86_64__)
    asm volatile("" : "+v"(x));
#elif defined(__aarch64__)
    asm volatile("" : "+w"(x));
#else
    asm volatile("" : "+m"(x));
#endif
}

// Twelve values stay in registers on every instruction set, with two constants; in flight side by side they hide a
// latency of 4 for two multipliers and two adders.
constexpr std::size_t kStreams = 12;

// Calls step.operator()<n>(x) for each of the streams, with its operand, in turns until count results are there. No
// loop over n: only at constant places of an array do compilers keep it in registers.
template <class Step, std::size_t... N>
inline void run(std::size_t count, Step step, std::index_sequence<N...>)
{
    // Full mantissas: some dividers finish early on round numbers.
    Wide x[] = {broadcast(1.2345678f + 0.1234567f * N)...};
    for (std::size_t done = 0; done < count; done += sizeof...(N)) (step.template operator()<N>(x[N]), ...);
}
template <class Step>
inline void run(std::size_t count, Step step)
{
    run(count, step, std::make_index_sequence<kStreams>{});
}

// The operand is hidden and the result used, so that every one is worked out anew.
template <class Work>
inline void once(Wide& x, Work work)
{
    keep(x);
    Wide result = work(x);
    keep(result);
}

void multiply_add(std::size_t count)
{
    Wide factor = broadcast(1), term = broadcast(0);
    keep(factor), keep(term);
    run(count, [&]<std::size_t N>(Wide& x) {
        if constexpr (N % 2 == 0)
            x = x * factor;
        else
            x = x + term;
        keep(x);
    });
}

void divide(std::size_t count)
{
    Wide dividend = broadcast(1.7654321f);
    keep(dividend);
    run(count, [&]<std::size_t N>(Wide& x) { once(x, [&](Wide by) { return dividend / by; }); });
}

void root(std::size_t count)
{
    run(count, []<std::size_t N>(Wide& x) { once(x, [](Wide of) { return root_of(of); }); });
}

}  // namespace

extern const Probe probe;
const Probe probe{sizeof(Wide) / sizeof(float), multiply_add, divide, root};

}  // namespace bench::SWIVEL_ISA
