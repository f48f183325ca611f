// SPDX-License-Identifier: MIT
//
// Lanes<Arch, Registers>: a few xsimd batches of floats, worked on side by side. It has core/num.h's list of
// operations, so every formula runs on it unchanged. This is the only file that names xsimd. It makes xsimd's
// operations equal on all CPUs: unary minus flips the sign bit, lo and hi do as selects do, and NEON's root and
// quotient are the exact instructions.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

#include <xsimd/xsimd.hpp>

#include "core/num.h"

namespace swivel::inline SWIVEL_ISA {

// How many lanes a number has, and how they move in and out of rows. address(lane) gives the place of a lane. The lanes
// of one register lie side by side there, aligned to the register.
template <class T>
inline constexpr std::size_t lane_count = 1;

template <class T, class Address>
requires std::is_same_v<T, float> SWIVEL_INLINE float load_lanes(Address address) { return *address(0); }
template <class T, class Address>
requires std::is_same_v<T, float> SWIVEL_INLINE std::uint32_t load_lane_bits(Address address)
{
    return bit_cast<std::uint32_t>(*address(0));
}
template <class Address>
SWIVEL_INLINE void store_lanes(Address address, float x)
{
    *address(0) = x;
}
template <class Address>
SWIVEL_INLINE void store_lanes(Address address, std::uint32_t bits)
{
    *address(0) = bit_cast<float>(bits);
}
// Stores some of the lanes. The places of the others keep what they hold.
template <class Address, class Value>
requires(std::is_same_v<Value, float> || std::is_same_v<Value, std::uint32_t>) SWIVEL_INLINE
    void store_lanes(Address address, Value x, bool where)
{
    if (where) store_lanes(address, x);
}
// A bit for each lane, the first lane's lowest; and the mask that has these bits.
SWIVEL_INLINE std::uint32_t lane_bits(bool mask) { return mask; }
template <class T>
requires std::is_same_v<T, float> SWIVEL_INLINE bool lanes_where(std::uint32_t bits) { return bits & 1; }

// The number type of a kernel built for Arch: lanes, or plain float for the scalar build.
template <class Arch, int Registers>
struct KernelNumber;
template <int Registers>
struct KernelNumber<float, Registers> {
    using type = float;
};

#ifndef XSIMD_NO_SUPPORTED_ARCHITECTURE  // other CPUs have the scalar build alone

template <class Arch, int Registers>
struct Lanes {
    using Batch = xsimd::batch<float, Arch>;
    static constexpr std::size_t width = Batch::size, count = width * Registers;
    Batch r[Registers];

    Lanes() = default;
    // Copies register by register. g++ would copy arrays of these as one piece of memory, through general registers.
    SWIVEL_INLINE Lanes(const Lanes& other) { *this = other; }
    SWIVEL_INLINE Lanes& operator=(const Lanes& other)
    {
        set([&](std::size_t n) SWIVEL_INLINE_LAMBDA { return other.r[n].data; });
        return *this;
    }
    explicit Lanes(double x)
    {
        set([&](std::size_t) SWIVEL_INLINE_LAMBDA { return Batch(static_cast<float>(x)).data; });
    }
    template <class F>
    SWIVEL_INLINE void set(F f)
    {
        [&]<std::size_t... N>(std::index_sequence<N...>) SWIVEL_INLINE_LAMBDA { ((r[N].data = f(N)), ...); }
        (std::make_index_sequence<Registers>{});
    }
};

template <class Arch, int Registers>
struct LanesMask {
    typename xsimd::batch<float, Arch>::batch_bool_type r[Registers];
};
// 32-bit words, kept in registers of floats. They are only selected, or-ed and stored, and these operations keep the
// bits.
template <class Arch, int Registers>
struct LanesBits {
    using Batch = xsimd::batch<float, Arch>;
    Batch r[Registers];

    LanesBits() = default;
    explicit LanesBits(std::uint32_t word)
    {
        for (Batch& b : r) b = Batch(bit_cast<float>(word));
    }
};

template <class Arch, int Registers>
struct NumberTraits<Lanes<Arch, Registers>> {
    using Mask = LanesMask<Arch, Registers>;
    using Bits = LanesBits<Arch, Registers>;
};

// {f(0), f(1), ...}: one result for each register.
template <class Out, class F>
SWIVEL_INLINE Out each_register(F f)
{
    const auto gather = [&]<std::size_t... N>(std::index_sequence<N...>) SWIVEL_INLINE_LAMBDA
    {
        Out out;
        ((out.r[N] = f(N)), ...);
        return out;
    };
    return gather(std::make_index_sequence<std::extent_v<decltype(Out::r)>>{});
}

#define SWIVEL_LANES_BINARY(op, Out)                                                                           \
    template <class A, int R>                                                                                  \
    SWIVEL_INLINE Out<A, R> operator op(const Lanes<A, R>& a, const Lanes<A, R>& b)                            \
    {                                                                                                          \
        return each_register<Out<A, R>>([&](std::size_t n) SWIVEL_INLINE_LAMBDA { return a.r[n] op b.r[n]; }); \
    }
SWIVEL_LANES_BINARY(+, Lanes)
SWIVEL_LANES_BINARY(-, Lanes)
SWIVEL_LANES_BINARY(*, Lanes)
SWIVEL_LANES_BINARY(<, LanesMask)
SWIVEL_LANES_BINARY(<=, LanesMask)
SWIVEL_LANES_BINARY(>, LanesMask)
SWIVEL_LANES_BINARY(>=, LanesMask)
SWIVEL_LANES_BINARY(==, LanesMask)
#undef SWIVEL_LANES_BINARY

template <class A, int R>
SWIVEL_INLINE Lanes<A, R> operator/(const Lanes<A, R>& a, const Lanes<A, R>& b)
{
#ifdef __aarch64__  // xsimd divides by an estimate there
    return each_register<Lanes<A, R>>(
        [&](std::size_t n) SWIVEL_INLINE_LAMBDA { return xsimd::batch<float, A>(vdivq_f32(a.r[n], b.r[n])); });
#else
    return each_register<Lanes<A, R>>([&](std::size_t n) SWIVEL_INLINE_LAMBDA { return a.r[n] / b.r[n]; });
#endif
}
template <class A, int R>
SWIVEL_INLINE Lanes<A, R> sqrt(const Lanes<A, R>& a)
{
#ifdef __aarch64__
    return each_register<Lanes<A, R>>([&](std::size_t n)
                                          SWIVEL_INLINE_LAMBDA { return xsimd::batch<float, A>(vsqrtq_f32(a.r[n])); });
#else
    return each_register<Lanes<A, R>>([&](std::size_t n) SWIVEL_INLINE_LAMBDA { return xsimd::sqrt(a.r[n]); });
#endif
}
template <class A, int R>
SWIVEL_INLINE Lanes<A, R> operator-(const Lanes<A, R>& a)
{
    // This is the compilers' own minus of registers. So they may turn x + (-y) z into x - y z.
    return each_register<Lanes<A, R>>([&](std::size_t n)
                                          SWIVEL_INLINE_LAMBDA { return xsimd::batch<float, A>(-a.r[n].data); });
}
template <class A, int R>
SWIVEL_INLINE Lanes<A, R> abs(const Lanes<A, R>& a)
{
    return each_register<Lanes<A, R>>([&](std::size_t n) SWIVEL_INLINE_LAMBDA { return xsimd::abs(a.r[n]); });
}
template <class A, int R>
SWIVEL_INLINE Lanes<A, R> copysign(const Lanes<A, R>& a, const Lanes<A, R>& sign)
{
    return each_register<Lanes<A, R>>([&](std::size_t n)
                                          SWIVEL_INLINE_LAMBDA { return xsimd::copysign(a.r[n], sign.r[n]); });
}
template <class A, int R>
SWIVEL_INLINE Lanes<A, R> flip_sign(const Lanes<A, R>& a, const Lanes<A, R>& sign)
{
    using Batch = xsimd::batch<float, A>;
    return each_register<Lanes<A, R>>([&](std::size_t n)
                                          SWIVEL_INLINE_LAMBDA { return a.r[n] ^ (sign.r[n] & Batch(-0.0f)); });
}

template <class A, int R>
SWIVEL_INLINE Lanes<A, R> power_of_two(const Lanes<A, R>& a)
{
    using Batch = xsimd::batch<float, A>;
    const Batch exponent(bit_cast<float>(0x7f800000u));
    return each_register<Lanes<A, R>>([&](std::size_t n) SWIVEL_INLINE_LAMBDA { return a.r[n] & exponent; });
}
template <class A, int R>
SWIVEL_INLINE Lanes<A, R> per_power_of_two(const Lanes<A, R>& a)
{
    using Words = xsimd::batch<std::int32_t, A>;
    return each_register<Lanes<A, R>>([&](std::size_t n) SWIVEL_INLINE_LAMBDA {
        const Words exponent = xsimd::bitwise_cast<Words>(a.r[n]) & Words(0x7f800000);
        return xsimd::bitwise_cast<xsimd::batch<float, A>>(Words(0x7e800000) - exponent);
    });
}

template <class A, int R>
SWIVEL_INLINE LanesMask<A, R> operator&(const LanesMask<A, R>& a, const LanesMask<A, R>& b)
{
    return each_register<LanesMask<A, R>>([&](std::size_t n) SWIVEL_INLINE_LAMBDA { return a.r[n] & b.r[n]; });
}
template <class A, int R>
SWIVEL_INLINE LanesMask<A, R> operator|(const LanesMask<A, R>& a, const LanesMask<A, R>& b)
{
    return each_register<LanesMask<A, R>>([&](std::size_t n) SWIVEL_INLINE_LAMBDA { return a.r[n] | b.r[n]; });
}
template <class A, int R>
SWIVEL_INLINE LanesMask<A, R> operator!(const LanesMask<A, R>& a)
{
    return each_register<LanesMask<A, R>>([&](std::size_t n) SWIVEL_INLINE_LAMBDA { return ~a.r[n]; });
}
template <class A, int R>
SWIVEL_INLINE Lanes<A, R> select(const LanesMask<A, R>& mask, const Lanes<A, R>& a, const Lanes<A, R>& b)
{
    return each_register<Lanes<A, R>>([&](std::size_t n)
                                          SWIVEL_INLINE_LAMBDA { return xsimd::select(mask.r[n], a.r[n], b.r[n]); });
}

template <class A, int R>
SWIVEL_INLINE bool any(const LanesMask<A, R>& mask)
{
    auto either = mask.r[0];
    for (int n = 1; n < R; ++n) either = either | mask.r[n];
    return xsimd::any(either);
}
template <class A, int R>
SWIVEL_INLINE bool all(const LanesMask<A, R>& mask)
{
    auto both = mask.r[0];
    for (int n = 1; n < R; ++n) both = both & mask.r[n];
    return xsimd::all(both);
}
template <class A, int R>
SWIVEL_INLINE std::uint32_t lane_bits(const LanesMask<A, R>& mask)
{
    static_assert(Lanes<A, R>::count <= 32);
    const auto of_register = [](const auto& lanes) SWIVEL_INLINE_LAMBDA {
#ifdef __aarch64__
        const uint32x4_t one_each = {1, 2, 4, 8};
        return vaddvq_u32(vandq_u32(lanes, one_each));
#else
        if constexpr (Lanes<A, R>::width == 16)
            return std::uint32_t{lanes.data};
        else if constexpr (Lanes<A, R>::width == 8)
            return static_cast<std::uint32_t>(_mm256_movemask_ps(lanes));
        else
            return static_cast<std::uint32_t>(_mm_movemask_ps(lanes));
#endif
    };
    std::uint32_t bits = 0;
    for (std::size_t n = 0; n < R; ++n) bits |= of_register(mask.r[n]) << n * Lanes<A, R>::width;
    return bits;
}
#ifdef __x86_64__
// Here minps and maxps have the bits of num.h's selects: they give the second operand for NaN and for two zeros.
template <class A, int R>
SWIVEL_INLINE Lanes<A, R> lo(const Lanes<A, R>& a, const Lanes<A, R>& b)
{
    return each_register<Lanes<A, R>>([&](std::size_t n) SWIVEL_INLINE_LAMBDA { return xsimd::min(a.r[n], b.r[n]); });
}
template <class A, int R>
SWIVEL_INLINE Lanes<A, R> hi(const Lanes<A, R>& a, const Lanes<A, R>& b)
{
    return each_register<Lanes<A, R>>([&](std::size_t n) SWIVEL_INLINE_LAMBDA { return xsimd::max(a.r[n], b.r[n]); });
}
#endif

template <class A, int R>
SWIVEL_INLINE LanesBits<A, R> operator|(const LanesBits<A, R>& a, const LanesBits<A, R>& b)
{
    return each_register<LanesBits<A, R>>([&](std::size_t n) SWIVEL_INLINE_LAMBDA { return a.r[n] | b.r[n]; });
}
template <class A, int R>
SWIVEL_INLINE LanesBits<A, R> select(const LanesMask<A, R>& mask, const LanesBits<A, R>& a, const LanesBits<A, R>& b)
{
    return each_register<LanesBits<A, R>>(
        [&](std::size_t n) SWIVEL_INLINE_LAMBDA { return xsimd::select(mask.r[n], a.r[n], b.r[n]); });
}
template <class A, int R>
SWIVEL_INLINE LanesBits<A, R> bits_where(const LanesMask<A, R>& mask, std::uint32_t word)
{
    return select(mask, LanesBits<A, R>(word), LanesBits<A, R>(0u));
}

template <class A, int R>
inline constexpr std::size_t lane_count<Lanes<A, R>> = Lanes<A, R>::count;
template <class A, int R>
inline constexpr std::size_t lane_count<LanesMask<A, R>> = Lanes<A, R>::count;

template <class T, class Address>
requires(lane_count<T> > 1) SWIVEL_INLINE T load_lanes(Address address)
{
    return each_register<T>([&](std::size_t n)
                                SWIVEL_INLINE_LAMBDA { return T::Batch::load_aligned(address(n * T::width)); });
}
template <class T, class Address>
requires(lane_count<T> > 1) SWIVEL_INLINE Bits<T> load_lane_bits(Address address)
{
    return each_register<Bits<T>>([&](std::size_t n)
                                      SWIVEL_INLINE_LAMBDA { return T::Batch::load_aligned(address(n * T::width)); });
}
template <class Address, template <class, int> class L, class A, int R>
SWIVEL_INLINE void store_lanes(Address address, const L<A, R>& x)
{
    for (std::size_t n = 0; n < R; ++n) x.r[n].store_aligned(address(n * Lanes<A, R>::width));
}

template <class Address, template <class, int> class L, class A, int R>
SWIVEL_INLINE void store_lanes(Address address, const L<A, R>& x, const LanesMask<A, R>& where)
{
    for (std::size_t n = 0; n < R; ++n) {
        float* const to = address(n * Lanes<A, R>::width);
        xsimd::select(where.r[n], x.r[n], xsimd::batch<float, A>::load_aligned(to)).store_aligned(to);
    }
}
// The bits of one register's lanes, as floats. They are denormals, which the environment of every kernel keeps.
template <class T>
requires(lane_count<T> > 1) SWIVEL_INLINE Mask<T> lanes_where(std::uint32_t bits)
{
    using Batch = typename T::Batch;
    alignas(64) static constexpr std::uint32_t bit[16] = {1u << 0,  1u << 1,  1u << 2,  1u << 3, 1u << 4,  1u << 5,
                                                          1u << 6,  1u << 7,  1u << 8,  1u << 9, 1u << 10, 1u << 11,
                                                          1u << 12, 1u << 13, 1u << 14, 1u << 15};
    const Batch each = Batch::load_aligned(reinterpret_cast<const float*>(bit));
    return each_register<Mask<T>>([&](std::size_t n) SWIVEL_INLINE_LAMBDA {
        const std::uint32_t of_register = bits >> n * T::width & ((1u << T::width) - 1);
        return (Batch(bit_cast<float>(of_register)) & each) > Batch(0.0f);
    });
}

template <class Arch, int Registers>
struct KernelNumber {
    using type = Lanes<Arch, Registers>;
};

#endif

}  // namespace swivel::inline SWIVEL_ISA
