// SPDX-License-Identifier: MIT
//
// Lanes: a few registers of floats, worked on side by side. They have core/num.h's list of operations, so every formula
// runs on them unchanged. This is the only file that names xsimd, which says what an instruction set's registers are.
// The operations are the compilers' own operators on vectors, or single instructions. xsimd's operators are ordinary
// functions, which g++ inlines late (core/isa.h). Some of them give other bits on other CPUs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include <xsimd/xsimd.hpp>

#include "core/num.h"

namespace swivel::inline SWIVEL_ISA {

// How many lanes a number has. lane_bits() has a bit for each of the most.
template <class T>
inline constexpr std::size_t lane_count = 1;
inline constexpr std::size_t kMaxLanes = 32;

// Lanes lie in memory side by side, aligned to a register. Those of more blocks than one lie in pieces of `lanes`, each
// `step` floats after the last one.
struct LaneBlocks {
    std::size_t lanes = kMaxLanes, step = 0;  // all in one piece
    SWIVEL_ALWAYS_INLINE constexpr std::size_t offset(std::size_t lane) const
    {
        return lane / lanes * step + lane % lanes;
    }
};

template <class T>
requires std::is_same_v<T, float> SWIVEL_ALWAYS_INLINE float load_lanes(const float* from, LaneBlocks = {})
{
    return *from;
}
template <class T>
requires std::is_same_v<T, float> SWIVEL_ALWAYS_INLINE std::uint32_t load_lane_word(const float* from)
{
    return bit_cast<std::uint32_t>(*from);
}
SWIVEL_ALWAYS_INLINE void store_lanes(float* to, float x, LaneBlocks = {}) { *to = x; }
SWIVEL_ALWAYS_INLINE void store_lanes(float* to, std::uint32_t word, LaneBlocks = {}) { *to = bit_cast<float>(word); }
// Stores some of the lanes. The places of the others keep what they hold.
template <class Value>
requires(std::is_same_v<Value, float> || std::is_same_v<Value, std::uint32_t>) SWIVEL_ALWAYS_INLINE
    void store_lanes(float* to, Value x, bool where, LaneBlocks = {})
{
    if (where) store_lanes(to, x);
}
// A bit for each lane, the first lane's lowest; and the mask that has these bits.
SWIVEL_ALWAYS_INLINE std::uint32_t lane_bits(bool mask) { return mask; }
template <class T>
requires std::is_same_v<T, float> SWIVEL_ALWAYS_INLINE bool lanes_where(std::uint32_t bits) { return bits & 1; }

// The number type of a kernel built for Arch: lanes, or plain float for the scalar build.
template <class Arch, int Count>
struct KernelNumber;
template <int Count>
struct KernelNumber<float, Count> {
    using type = float;
};

#ifndef XSIMD_NO_SUPPORTED_ARCHITECTURE  // other CPUs have the scalar build alone

// An instruction set's registers of floats and their operations. Words are the same registers as integers. A mask is
// words, too, with all bits of a lane set where a comparison holds. This holds what all instruction sets share;
// Registers<Arch> adds the rest.
template <class Arch>
struct VectorRegisters {
    using Float = typename xsimd::batch<float, Arch>::register_type;
    using Word = decltype(Float{} < Float{});
    using Mask = Word;
    static constexpr std::size_t width = sizeof(Float) / sizeof(float);

    template <std::size_t... N>
    SWIVEL_ALWAYS_INLINE static Float fill(float x, std::index_sequence<N...>)
    {
        return Float{(static_cast<void>(N), x)...};
    }
    SWIVEL_ALWAYS_INLINE static Float fill(float x) { return fill(x, std::make_index_sequence<width>{}); }
    SWIVEL_ALWAYS_INLINE static Word words(std::uint32_t word) { return (Word)fill(bit_cast<float>(word)); }
    // The mask of the lanes whose bits are set, the first lane's lowest. Higher bits may be anything.
    template <std::size_t... N>
    SWIVEL_ALWAYS_INLINE static Mask mask(std::uint32_t bits, std::index_sequence<N...>)
    {
        const Word own = {(1 << N)...};
        return (words(bits) & own) == own;
    }
    SWIVEL_ALWAYS_INLINE static Mask mask(std::uint32_t bits) { return mask(bits, std::make_index_sequence<width>{}); }
    SWIVEL_ALWAYS_INLINE static Float load(const float* from) { return *reinterpret_cast<const Float*>(from); }
    SWIVEL_ALWAYS_INLINE static void store(float* to, Float x) { *reinterpret_cast<Float*>(to) = x; }

    SWIVEL_ALWAYS_INLINE static Mask less(Float a, Float b) { return a < b; }
    SWIVEL_ALWAYS_INLINE static Mask less_equal(Float a, Float b) { return a <= b; }
    SWIVEL_ALWAYS_INLINE static Mask equal(Float a, Float b) { return a == b; }
    SWIVEL_ALWAYS_INLINE static Float select(Mask mask, Float a, Float b)
    {
        return (Float)((mask & (Word)a) | (~mask & (Word)b));
    }
    SWIVEL_ALWAYS_INLINE static Float bit_and(Float a, Float b) { return (Float)((Word)a & (Word)b); }
    SWIVEL_ALWAYS_INLINE static Float bit_xor(Float a, Float b) { return (Float)((Word)a ^ (Word)b); }
};

// x86 has bitwise instructions for floats, and g++ takes their constant operands from memory. It would build a constant
// of integers anew in every step, with two or three instructions.
template <class Arch>
struct Registers;
#if defined(__SSE2__)
template <>
struct Registers<xsimd::sse2> : VectorRegisters<xsimd::sse2> {
    SWIVEL_ALWAYS_INLINE static Float sqrt(Float a) { return _mm_sqrt_ps(a); }
    SWIVEL_ALWAYS_INLINE static Float lo(Float a, Float b) { return _mm_min_ps(a, b); }
    SWIVEL_ALWAYS_INLINE static Float hi(Float a, Float b) { return _mm_max_ps(a, b); }
    SWIVEL_ALWAYS_INLINE static Float bit_and(Float a, Float b) { return _mm_and_ps(a, b); }
    SWIVEL_ALWAYS_INLINE static Float bit_xor(Float a, Float b) { return _mm_xor_ps(a, b); }
    SWIVEL_ALWAYS_INLINE static std::uint32_t bits(Mask mask)
    {
        return static_cast<std::uint32_t>(_mm_movemask_ps((Float)mask));
    }
};
#endif
#if defined(__AVX2__)
template <>
struct Registers<xsimd::avx2> : VectorRegisters<xsimd::avx2> {
    SWIVEL_ALWAYS_INLINE static Float select(Mask mask, Float a, Float b)
    {
        return _mm256_blendv_ps(b, a, (Float)mask);
    }
    SWIVEL_ALWAYS_INLINE static Float sqrt(Float a) { return _mm256_sqrt_ps(a); }
    SWIVEL_ALWAYS_INLINE static Float lo(Float a, Float b) { return _mm256_min_ps(a, b); }
    SWIVEL_ALWAYS_INLINE static Float hi(Float a, Float b) { return _mm256_max_ps(a, b); }
    SWIVEL_ALWAYS_INLINE static Float bit_and(Float a, Float b) { return _mm256_and_ps(a, b); }
    SWIVEL_ALWAYS_INLINE static Float bit_xor(Float a, Float b) { return _mm256_xor_ps(a, b); }
    SWIVEL_ALWAYS_INLINE static std::uint32_t bits(Mask mask)
    {
        return static_cast<std::uint32_t>(_mm256_movemask_ps((Float)mask));
    }
};
#endif
#if defined(__AVX512BW__)
template <>
struct Registers<xsimd::avx512bw> : VectorRegisters<xsimd::avx512bw> {
    using Mask = __mmask16;  // a bit for each lane
    SWIVEL_ALWAYS_INLINE static Mask less(Float a, Float b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
    SWIVEL_ALWAYS_INLINE static Mask less_equal(Float a, Float b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
    SWIVEL_ALWAYS_INLINE static Mask equal(Float a, Float b) { return _mm512_cmp_ps_mask(a, b, _CMP_EQ_OQ); }
    SWIVEL_ALWAYS_INLINE static Float select(Mask mask, Float a, Float b) { return _mm512_mask_blend_ps(mask, b, a); }
    SWIVEL_ALWAYS_INLINE static Float sqrt(Float a) { return _mm512_sqrt_ps(a); }
    SWIVEL_ALWAYS_INLINE static Float lo(Float a, Float b) { return _mm512_min_ps(a, b); }
    SWIVEL_ALWAYS_INLINE static Float hi(Float a, Float b) { return _mm512_max_ps(a, b); }
    SWIVEL_ALWAYS_INLINE static Float bit_and(Float a, Float b) { return _mm512_and_ps(a, b); }
    SWIVEL_ALWAYS_INLINE static Float bit_xor(Float a, Float b) { return _mm512_xor_ps(a, b); }
    SWIVEL_ALWAYS_INLINE static Mask mask(std::uint32_t bits) { return static_cast<Mask>(bits); }
    SWIVEL_ALWAYS_INLINE static std::uint32_t bits(Mask mask) { return mask; }
};
#endif
#if defined(__aarch64__)
template <>
struct Registers<xsimd::neon64> : VectorRegisters<xsimd::neon64> {
    SWIVEL_ALWAYS_INLINE static Float select(Mask mask, Float a, Float b) { return vbslq_f32((uint32x4_t)mask, a, b); }
    SWIVEL_ALWAYS_INLINE static Float sqrt(Float a) { return vsqrtq_f32(a); }
    SWIVEL_ALWAYS_INLINE static std::uint32_t bits(Mask mask)
    {
        const uint32x4_t one_each = {1, 2, 4, 8};
        return vaddvq_u32(vandq_u32((uint32x4_t)mask, one_each));
    }
};
#endif

// Lanes, their masks and their words consist of a register for each N. Copies go register by register. g++ would copy
// the array as one piece of memory, through general registers.
#define SWIVEL_LANES_REGISTERS(Type, Register)                                           \
    Register r[sizeof...(N)];                                                            \
    Type() = default;                                                                    \
    template <class... Each>                                                             \
    requires(sizeof...(Each) == sizeof...(N) && (std::is_same_v<Each, Register> && ...)) \
        SWIVEL_ALWAYS_INLINE explicit Type(Each... each)                                 \
        : r{each...}                                                                     \
    {                                                                                    \
    }                                                                                    \
    SWIVEL_ALWAYS_INLINE Type(const Type& other) : r{other.r[N]...} {}                   \
    SWIVEL_ALWAYS_INLINE Type& operator=(const Type& other)                              \
    {                                                                                    \
        ((r[N] = other.r[N]), ...);                                                      \
        return *this;                                                                    \
    }

// N are the numbers of the registers: 0, or 0 and 1.
template <class Arch, std::size_t... N>
struct Lanes {
    using R = Registers<Arch>;
    using Register = typename R::Float;
    static constexpr std::size_t width = R::width, count = width * sizeof...(N);
    SWIVEL_LANES_REGISTERS(Lanes, Register)

    SWIVEL_ALWAYS_INLINE explicit Lanes(double x)
    {
        const Register all = R::fill(static_cast<float>(x));
        ((r[N] = all), ...);
    }
    SWIVEL_ALWAYS_INLINE static Lanes load(const float* from, LaneBlocks blocks)
    {
        return Lanes(R::load(from + blocks.offset(N * width))...);
    }
};

template <class Arch, std::size_t... N>
struct LanesMask {
    using R = Registers<Arch>;
    using Register = typename R::Mask;
    SWIVEL_LANES_REGISTERS(LanesMask, Register)

    SWIVEL_ALWAYS_INLINE static LanesMask where(std::uint32_t bits)
    {
        return LanesMask(R::mask(bits >> N * R::width)...);
    }
};
// 32-bit words, kept in registers of floats. They are only selected, or-ed and stored, and these operations keep the
// bits.
template <class Arch, std::size_t... N>
struct LanesWord {
    using R = Registers<Arch>;
    using Register = typename R::Float;
    SWIVEL_LANES_REGISTERS(LanesWord, Register)

    SWIVEL_ALWAYS_INLINE explicit LanesWord(std::uint32_t word)
    {
        const typename R::Float all = R::fill(bit_cast<float>(word));
        ((r[N] = all), ...);
    }
    SWIVEL_ALWAYS_INLINE static LanesWord load(const float* from) { return LanesWord(R::load(from + N * R::width)...); }
};

#undef SWIVEL_LANES_REGISTERS

template <class Arch, std::size_t... N>
struct NumberTraits<Lanes<Arch, N...>> {
    using Mask = LanesMask<Arch, N...>;
    using Word = LanesWord<Arch, N...>;
};

#define SWIVEL_LANES_BINARY(op)                                                                       \
    template <class A, std::size_t... N>                                                              \
    SWIVEL_ALWAYS_INLINE Lanes<A, N...> operator op(const Lanes<A, N...>& a, const Lanes<A, N...>& b) \
    {                                                                                                 \
        return Lanes<A, N...>((a.r[N] op b.r[N])...);                                                 \
    }
SWIVEL_LANES_BINARY(+)
SWIVEL_LANES_BINARY(-)
SWIVEL_LANES_BINARY(*)
SWIVEL_LANES_BINARY(/)
#undef SWIVEL_LANES_BINARY
// This is the compiler's own minus, which it may merge with its neighbours: x + (-y) z becomes x - y z, with the same
// bits.
template <class A, std::size_t... N>
SWIVEL_ALWAYS_INLINE Lanes<A, N...> operator-(const Lanes<A, N...>& a)
{
    return Lanes<A, N...>((-a.r[N])...);
}
template <class A, std::size_t... N>
SWIVEL_ALWAYS_INLINE Lanes<A, N...> sqrt(const Lanes<A, N...>& a)
{
    return Lanes<A, N...>(Registers<A>::sqrt(a.r[N])...);
}

// Signs and exponents are bits of the words.
template <class A, std::size_t... N>
SWIVEL_ALWAYS_INLINE Lanes<A, N...> masked(const Lanes<A, N...>& a, std::uint32_t word)
{
    using R = Registers<A>;
    const typename R::Float mask = R::fill(bit_cast<float>(word));
    return Lanes<A, N...>(R::bit_and(a.r[N], mask)...);
}
template <class A, std::size_t... N>
SWIVEL_ALWAYS_INLINE Lanes<A, N...> abs(const Lanes<A, N...>& a)
{
    return masked(a, 0x7fffffffu);
}
template <class A, std::size_t... N>
SWIVEL_ALWAYS_INLINE Lanes<A, N...> flip_sign(const Lanes<A, N...>& a, const Lanes<A, N...>& sign)
{
    const Lanes<A, N...> flips = masked(sign, 0x80000000u);
    return Lanes<A, N...>(Registers<A>::bit_xor(a.r[N], flips.r[N])...);
}
template <class A, std::size_t... N>
SWIVEL_ALWAYS_INLINE Lanes<A, N...> copysign(const Lanes<A, N...>& a, const Lanes<A, N...>& sign)
{
    return flip_sign(abs(a), sign);
}
template <class A, std::size_t... N>
SWIVEL_ALWAYS_INLINE Lanes<A, N...> power_of_two(const Lanes<A, N...>& a)
{
    return masked(a, 0x7f800000u);
}
template <class A, std::size_t... N>
SWIVEL_ALWAYS_INLINE Lanes<A, N...> per_power_of_two(const Lanes<A, N...>& a)
{
    using R = Registers<A>;
    const Lanes<A, N...> power = power_of_two(a);
    return Lanes<A, N...>((typename R::Float)(R::words(0x7e800000u) - (typename R::Word)power.r[N])...);
}

#define SWIVEL_LANES_COMPARE(op, compare, x, y)                                                           \
    template <class A, std::size_t... N>                                                                  \
    SWIVEL_ALWAYS_INLINE LanesMask<A, N...> operator op(const Lanes<A, N...>& a, const Lanes<A, N...>& b) \
    {                                                                                                     \
        return LanesMask<A, N...>(Registers<A>::compare(x.r[N], y.r[N])...);                              \
    }
SWIVEL_LANES_COMPARE(<, less, a, b)
SWIVEL_LANES_COMPARE(<=, less_equal, a, b)
SWIVEL_LANES_COMPARE(>, less, b, a)
SWIVEL_LANES_COMPARE(>=, less_equal, b, a)
SWIVEL_LANES_COMPARE(==, equal, a, b)
#undef SWIVEL_LANES_COMPARE

template <class A, std::size_t... N>
SWIVEL_ALWAYS_INLINE LanesMask<A, N...> operator&(const LanesMask<A, N...>& a, const LanesMask<A, N...>& b)
{
    return LanesMask<A, N...>(static_cast<typename Registers<A>::Mask>(a.r[N] & b.r[N])...);
}
template <class A, std::size_t... N>
SWIVEL_ALWAYS_INLINE LanesMask<A, N...> operator|(const LanesMask<A, N...>& a, const LanesMask<A, N...>& b)
{
    return LanesMask<A, N...>(static_cast<typename Registers<A>::Mask>(a.r[N] | b.r[N])...);
}
template <class A, std::size_t... N>
SWIVEL_ALWAYS_INLINE LanesMask<A, N...> operator!(const LanesMask<A, N...>& a)
{
    return LanesMask<A, N...>(static_cast<typename Registers<A>::Mask>(~a.r[N])...);
}
template <class A, std::size_t... N>
SWIVEL_ALWAYS_INLINE Lanes<A, N...> select(const LanesMask<A, N...>& mask, const Lanes<A, N...>& a,
                                           const Lanes<A, N...>& b)
{
    return Lanes<A, N...>(Registers<A>::select(mask.r[N], a.r[N], b.r[N])...);
}
#ifdef __x86_64__
// Here minps and maxps have the bits of num.h's selects: they give the second operand for NaN and for two zeros.
template <class A, std::size_t... N>
SWIVEL_ALWAYS_INLINE Lanes<A, N...> lo(const Lanes<A, N...>& a, const Lanes<A, N...>& b)
{
    return Lanes<A, N...>(Registers<A>::lo(a.r[N], b.r[N])...);
}
template <class A, std::size_t... N>
SWIVEL_ALWAYS_INLINE Lanes<A, N...> hi(const Lanes<A, N...>& a, const Lanes<A, N...>& b)
{
    return Lanes<A, N...>(Registers<A>::hi(a.r[N], b.r[N])...);
}
#endif

template <class A, std::size_t... N>
SWIVEL_ALWAYS_INLINE std::uint32_t lane_bits(const LanesMask<A, N...>& mask)
{
    static_assert(Lanes<A, N...>::count <= kMaxLanes);
    return ((Registers<A>::bits(mask.r[N]) << N * Registers<A>::width) | ...);
}
template <class A, std::size_t... N>
SWIVEL_ALWAYS_INLINE bool any(const LanesMask<A, N...>& mask)
{
    return Registers<A>::bits(static_cast<typename Registers<A>::Mask>((mask.r[N] | ...))) != 0;
}
template <class A, std::size_t... N>
SWIVEL_ALWAYS_INLINE bool all(const LanesMask<A, N...>& mask)
{
    constexpr std::uint32_t every = (1u << Registers<A>::width) - 1;
    return Registers<A>::bits(static_cast<typename Registers<A>::Mask>((mask.r[N] & ...))) == every;
}

template <class A, std::size_t... N>
SWIVEL_ALWAYS_INLINE LanesWord<A, N...> operator|(const LanesWord<A, N...>& a, const LanesWord<A, N...>& b)
{
    using R = Registers<A>;
    return LanesWord<A, N...>((typename R::Float)((typename R::Word)a.r[N] | (typename R::Word)b.r[N])...);
}
template <class A, std::size_t... N>
SWIVEL_ALWAYS_INLINE LanesWord<A, N...> select(const LanesMask<A, N...>& mask, const LanesWord<A, N...>& a,
                                               const LanesWord<A, N...>& b)
{
    return LanesWord<A, N...>(Registers<A>::select(mask.r[N], a.r[N], b.r[N])...);
}
template <class A, std::size_t... N>
SWIVEL_ALWAYS_INLINE LanesWord<A, N...> word_where(const LanesMask<A, N...>& mask, std::uint32_t word)
{
    return select(mask, LanesWord<A, N...>(word), LanesWord<A, N...>(0u));
}

template <class A, std::size_t... N>
inline constexpr std::size_t lane_count<Lanes<A, N...>> = Lanes<A, N...>::count;
template <class A, std::size_t... N>
inline constexpr std::size_t lane_count<LanesMask<A, N...>> = Lanes<A, N...>::count;

template <class T>
requires(lane_count<T> > 1) SWIVEL_ALWAYS_INLINE T load_lanes(const float* from, LaneBlocks blocks = {})
{
    return T::load(from, blocks);
}
template <class T>
requires(lane_count<T> > 1) SWIVEL_ALWAYS_INLINE Word<T> load_lane_word(const float* from)
{
    return Word<T>::load(from);
}
template <class T>
requires(lane_count<T> > 1) SWIVEL_ALWAYS_INLINE Mask<T> lanes_where(std::uint32_t bits)
{
    return Mask<T>::where(bits);
}
template <template <class, std::size_t...> class L, class A, std::size_t... N>
SWIVEL_ALWAYS_INLINE void store_lanes(float* to, const L<A, N...>& x, LaneBlocks blocks = {})
{
    using R = Registers<A>;
    (R::store(to + blocks.offset(N * R::width), x.r[N]), ...);
}
template <template <class, std::size_t...> class L, class A, std::size_t... N>
SWIVEL_ALWAYS_INLINE void store_lanes(float* to, const L<A, N...>& x, const LanesMask<A, N...>& where,
                                      LaneBlocks blocks = {})
{
    using R = Registers<A>;
    (R::store(to + blocks.offset(N * R::width),
              R::select(where.r[N], x.r[N], R::load(to + blocks.offset(N * R::width)))),
     ...);
}

template <class Arch, class Numbers>
struct LanesOf;
template <class Arch, std::size_t... N>
struct LanesOf<Arch, std::index_sequence<N...>> {
    using type = Lanes<Arch, N...>;
};
template <class Arch, int Count>
struct KernelNumber : LanesOf<Arch, std::make_index_sequence<Count>> {
};

#endif

}  // namespace swivel::inline SWIVEL_ISA
