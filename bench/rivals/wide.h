// SPDX-License-Identifier: MIT
//
// One register of the instruction set that this file is compiled for, and the few operations that probes, copies and
// the kernel by hand need of it. SWIVEL_PROBE_SCALAR: one float.
#pragma once

#include <cmath>

#if defined(__x86_64__)
#include <immintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

namespace bench::SWIVEL_ISA {

// stream(): a store past the caches, where the instruction set has one; to addresses aligned to the register.
#if defined(SWIVEL_PROBE_SCALAR) || !(defined(__x86_64__) || defined(__aarch64__))
using Wide = float;
inline Wide broadcast(float x) { return x; }
inline Wide root(Wide x) { return std::sqrt(x); }
inline Wide load(const float* from) { return *from; }
inline void store(float* to, Wide x) { *to = x; }
inline void stream(float* to, Wide x) { *to = x; }
#elif defined(__AVX512F__)
using Wide = __m512;
inline Wide broadcast(float x) { return _mm512_set1_ps(x); }
inline Wide root(Wide x) { return _mm512_sqrt_ps(x); }
inline Wide load(const float* from) { return _mm512_load_ps(from); }
inline void store(float* to, Wide x) { _mm512_store_ps(to, x); }
inline void stream(float* to, Wide x) { _mm512_stream_ps(to, x); }
#elif defined(__AVX2__)
using Wide = __m256;
inline Wide broadcast(float x) { return _mm256_set1_ps(x); }
inline Wide root(Wide x) { return _mm256_sqrt_ps(x); }
inline Wide load(const float* from) { return _mm256_load_ps(from); }
inline void store(float* to, Wide x) { _mm256_store_ps(to, x); }
inline void stream(float* to, Wide x) { _mm256_stream_ps(to, x); }
#elif defined(__x86_64__)
using Wide = __m128;
inline Wide broadcast(float x) { return _mm_set1_ps(x); }
inline Wide root(Wide x) { return _mm_sqrt_ps(x); }
inline Wide load(const float* from) { return _mm_load_ps(from); }
inline void store(float* to, Wide x) { _mm_store_ps(to, x); }
inline void stream(float* to, Wide x) { _mm_stream_ps(to, x); }
#else
using Wide = float32x4_t;
inline Wide broadcast(float x) { return vdupq_n_f32(x); }
inline Wide root(Wide x) { return vsqrtq_f32(x); }
inline Wide load(const float* from) { return vld1q_f32(from); }
inline void store(float* to, Wide x) { vst1q_f32(to, x); }
inline void stream(float* to, Wide x) { vst1q_f32(to, x); }
#endif

// What comparisons of registers give, and the bits of their numbers.
#if defined(SWIVEL_PROBE_SCALAR) || !(defined(__x86_64__) || defined(__aarch64__))
using Mask = bool;
inline Wide select(Mask mask, Wide a, Wide b) { return mask ? a : b; }
inline Mask less(Wide a, Wide b) { return a < b; }
inline Mask less_equal(Wide a, Wide b) { return a <= b; }
inline bool all(Mask mask) { return mask; }
inline Wide size_of(Wide x) { return std::fabs(x); }
inline Wide signed_as(Wide size, Wide sign) { return std::copysign(size, sign); }
inline Wide flipped_as(Wide x, Wide sign) { return std::signbit(sign) ? -x : x; }
inline Wide per_power_of_two(Wide x)
{
    return __builtin_bit_cast(float, 0x7e800000 - (__builtin_bit_cast(int, x) & 0x7f800000));
}
#elif defined(__AVX512F__)
using Mask = __mmask16;
inline Wide select(Mask mask, Wide a, Wide b) { return _mm512_mask_blend_ps(mask, b, a); }
inline Mask less(Wide a, Wide b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
inline Mask less_equal(Wide a, Wide b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
inline bool all(Mask mask) { return mask == 0xffff; }
inline Wide size_of(Wide x) { return _mm512_andnot_ps(broadcast(-0.0f), x); }
inline Wide flipped_as(Wide x, Wide sign) { return _mm512_xor_ps(x, _mm512_and_ps(broadcast(-0.0f), sign)); }
inline Wide signed_as(Wide size, Wide sign) { return _mm512_or_ps(size, _mm512_and_ps(broadcast(-0.0f), sign)); }
inline Wide per_power_of_two(Wide x)
{
    const __m512i exponent = _mm512_and_si512(_mm512_castps_si512(x), _mm512_set1_epi32(0x7f800000));
    return _mm512_castsi512_ps(_mm512_sub_epi32(_mm512_set1_epi32(0x7e800000), exponent));
}
#else
using Mask = decltype(Wide{} < Wide{});
inline Wide select(Mask mask, Wide a, Wide b) { return mask ? a : b; }
inline Mask less(Wide a, Wide b) { return a < b; }
inline Mask less_equal(Wide a, Wide b) { return a <= b; }
inline Mask sign_bits(Wide x) { return reinterpret_cast<Mask>(x) & reinterpret_cast<Mask>(broadcast(-0.0f)); }
inline Wide size_of(Wide x) { return reinterpret_cast<Wide>(reinterpret_cast<Mask>(x) ^ sign_bits(x)); }
inline Wide flipped_as(Wide x, Wide s) { return reinterpret_cast<Wide>(reinterpret_cast<Mask>(x) ^ sign_bits(s)); }
inline Wide signed_as(Wide x, Wide s) { return reinterpret_cast<Wide>(reinterpret_cast<Mask>(x) | sign_bits(s)); }
inline Wide per_power_of_two(Wide x)
{
    return reinterpret_cast<Wide>(0x7e800000 - (reinterpret_cast<Mask>(x) & 0x7f800000));
}
#if defined(__AVX2__)
inline bool all(Mask mask) { return _mm256_movemask_ps(reinterpret_cast<__m256>(mask)) == 0xff; }
#elif defined(__x86_64__)
inline bool all(Mask mask) { return _mm_movemask_ps(reinterpret_cast<__m128>(mask)) == 0xf; }
#else
inline bool all(Mask mask) { return vminvq_u32(reinterpret_cast<uint32x4_t>(mask)) != 0; }
#endif
#endif

inline constexpr unsigned kWide = sizeof(Wide) / sizeof(float);

// Streamed stores are in memory from here on.
inline void finish_streams()
{
#if defined(__x86_64__)
    _mm_sfence();
#endif
}

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

}  // namespace bench::SWIVEL_ISA
