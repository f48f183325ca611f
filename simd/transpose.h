// SPDX-License-Identifier: MIT
//
// Copies values of 1 to 4 components, as callers keep them, to rows and back. It takes four limbs at a time through
// 128-bit registers, and the last ones one at a time. It copies 32-bit words bit for bit, so a NaN keeps its payload
// and a flag word its bits. Values may have any alignment and lie any number of bytes apart. No byte beside them is
// read or written. On CPUs without such registers, four limbs are copied one by one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

#include "simd/fields.h"

namespace swivel {

// One limb's value of C components to or from its lane; components are a row, kLanes floats, apart.
template <std::size_t C>
void value_to_rows(const char* value, float* lane)
{
    for (std::size_t c = 0; c < C; ++c) std::memcpy(lane + c * kLanes, value + c * sizeof(float), sizeof(float));
}
template <std::size_t C>
void value_from_rows(const float* lane, char* value)
{
    for (std::size_t c = 0; c < C; ++c) std::memcpy(value + c * sizeof(float), lane + c * kLanes, sizeof(float));
}

// ---- four words in a register; zip_low is a0 b0 a1 b1, zip_high a2 b2 a3 b3

#if defined(__SSE2__)

using Words = __m128i;
inline Words load4(const void* from) { return _mm_loadu_si128(static_cast<const Words*>(from)); }
inline Words load1(const void* from)
{
    int word;
    std::memcpy(&word, from, sizeof word);
    return _mm_cvtsi32_si128(word);
}
inline Words load2(const void* from) { return _mm_loadl_epi64(static_cast<const Words*>(from)); }
inline void store4(void* to, Words w) { _mm_storeu_si128(static_cast<Words*>(to), w); }
inline void store_low(void* to, Words w) { _mm_storel_epi64(static_cast<Words*>(to), w); }
inline void store_high(void* to, Words w) { store_low(to, _mm_unpackhi_epi64(w, w)); }
inline Words zip_low(Words a, Words b) { return _mm_unpacklo_epi32(a, b); }
inline Words zip_high(Words a, Words b) { return _mm_unpackhi_epi32(a, b); }

#elif defined(__aarch64__)

using Words = uint32x4_t;  // loaded and stored as bytes, which may have any alignment
inline Words load4(const void* from) { return vreinterpretq_u32_u8(vld1q_u8(static_cast<const std::uint8_t*>(from))); }
inline Words load1(const void* from)
{
    std::uint32_t word;
    std::memcpy(&word, from, sizeof word);
    return vdupq_n_u32(word);
}
inline Words load2(const void* from)
{
    const uint8x8_t low = vld1_u8(static_cast<const std::uint8_t*>(from));
    return vreinterpretq_u32_u8(vcombine_u8(low, low));
}
inline void store4(void* to, Words w) { vst1q_u8(static_cast<std::uint8_t*>(to), vreinterpretq_u8_u32(w)); }
inline void store_low(void* to, Words w)
{
    vst1_u8(static_cast<std::uint8_t*>(to), vget_low_u8(vreinterpretq_u8_u32(w)));
}
inline void store_high(void* to, Words w)
{
    vst1_u8(static_cast<std::uint8_t*>(to), vget_high_u8(vreinterpretq_u8_u32(w)));
}
inline Words zip_low(Words a, Words b) { return vzip1q_u32(a, b); }
inline Words zip_high(Words a, Words b) { return vzip2q_u32(a, b); }

#endif

// ---- four limbs, the first one's lane a multiple of four

#if defined(__SSE2__) || defined(__aarch64__)

template <std::size_t C>
void four_values_to_rows(const char* values, std::size_t stride, float* lanes)
{
    const char *const v0 = values, *const v1 = v0 + stride, *const v2 = v1 + stride, *const v3 = v2 + stride;
    if constexpr (C == 4) {
        const Words a = load4(v0), b = load4(v1), c = load4(v2), d = load4(v3);
        const Words ac = zip_low(a, c), bd = zip_low(b, d);
        store4(lanes, zip_low(ac, bd));
        store4(lanes + kLanes, zip_high(ac, bd));
        const Words ac_high = zip_high(a, c), bd_high = zip_high(b, d);
        store4(lanes + 2 * kLanes, zip_low(ac_high, bd_high));
        store4(lanes + 3 * kLanes, zip_high(ac_high, bd_high));
    } else if constexpr (C >= 2) {
        const Words ac = zip_low(load2(v0), load2(v2)), bd = zip_low(load2(v1), load2(v3));
        store4(lanes, zip_low(ac, bd));
        store4(lanes + kLanes, zip_high(ac, bd));
    }
    if constexpr (C % 2 == 1) {  // the last of one or three components
        constexpr std::size_t byte = (C - 1) * sizeof(float);
        const Words ac = zip_low(load1(v0 + byte), load1(v2 + byte)), bd = zip_low(load1(v1 + byte), load1(v3 + byte));
        store4(lanes + (C - 1) * kLanes, zip_low(ac, bd));
    }
}

template <std::size_t C>
void four_values_from_rows(const float* lanes, char* values, std::size_t stride)
{
    char *const v0 = values, *const v1 = v0 + stride, *const v2 = v1 + stride, *const v3 = v2 + stride;
    if constexpr (C == 4) {
        const Words a = load4(lanes), b = load4(lanes + kLanes), c = load4(lanes + 2 * kLanes),
                    d = load4(lanes + 3 * kLanes);
        const Words ac = zip_low(a, c), bd = zip_low(b, d);
        store4(v0, zip_low(ac, bd));
        store4(v1, zip_high(ac, bd));
        const Words ac_high = zip_high(a, c), bd_high = zip_high(b, d);
        store4(v2, zip_low(ac_high, bd_high));
        store4(v3, zip_high(ac_high, bd_high));
    } else if constexpr (C >= 2) {
        const Words a = load4(lanes), b = load4(lanes + kLanes);
        const Words low = zip_low(a, b), high = zip_high(a, b);
        store_low(v0, low);
        store_high(v1, low);
        store_low(v2, high);
        store_high(v3, high);
    }
    if constexpr (C % 2 == 1) {
        constexpr std::size_t c = C - 1;
        char* const last[] = {v0, v1, v2, v3};
        for (int n = 0; n < 4; ++n) value_from_rows<1>(lanes + c * kLanes + n, last[n] + c * sizeof(float));
    }
}

#else

template <std::size_t C>
void four_values_to_rows(const char* values, std::size_t stride, float* lanes)
{
    for (std::size_t n = 0; n < 4; ++n) value_to_rows<C>(values + n * stride, lanes + n);
}
template <std::size_t C>
void four_values_from_rows(const float* lanes, char* values, std::size_t stride)
{
    for (std::size_t n = 0; n < 4; ++n) value_from_rows<C>(lanes + n, values + n * stride);
}

#endif

}  // namespace swivel
