// SPDX-License-Identifier: MIT
//
// The conformal geometric algebra G(4,1) at compile time. A multivector's type says which blades it has. The type of a
// product and its terms follow from the types of its factors. So S1 ^ S2 ^ plane costs its own multiplications and
// nothing else.
//
// Basis: e1 e2 e3, e0 (origin), einf (infinity) with e0^2 = einf^2 = 0, e0.einf = -1. Blades are ordered e1 e2 e3 einf
// e0, except that the Euclidean bivectors are the lecture's imaginary units i = e3^e2, j = e1^e3, k = e2^e1 themselves.
// This is the only file with component arithmetic.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "core/num.h"

namespace swivel::inline SWIVEL_ISA {

// A basis blade: the set of its basis vectors, one bit each.
using Blade = unsigned;
// A set of blades: bit b is set if it has blade b.
using BladeSet = std::uint32_t;

inline constexpr Blade kScalar = 0, kE1 = 1, kE2 = 2, kE3 = 4, kEinf = 8, kE0 = 16;
inline constexpr Blade kI = kE3 | kE2, kJ = kE1 | kE3, kK = kE2 | kE1;
inline constexpr Blade kEuclid = kE1 | kE2 | kE3, kPseudoscalar = 31;

template <class... B>
constexpr BladeSet blades(B... blade)
{
    return ((BladeSet{1} << blade) | ...);
}

constexpr int grade(Blade b) { return std::popcount(b); }

constexpr BladeSet blades_of_grade(BladeSet set, int wanted)
{
    BladeSet part = 0;
    for (Blade b = 0; b < 32; ++b)
        if ((set >> b & 1u) && grade(b) == wanted) part |= BladeSet{1} << b;
    return part;
}

namespace table {  // products of basis blades, worked out by the compiler

// Sign of bringing the basis vectors of a, then b, into ascending order.
constexpr int order_sign(Blade a, Blade b)
{
    int swaps = 0;
    for (Blade rest = a >> 1; rest != 0; rest >>= 1) swaps += std::popcount(rest & b);
    return swaps % 2 == 0 ? 1 : -1;
}

// i = e3^e2 and k = e2^e1 run against the ascending order, alone and as a factor of a larger blade.
constexpr int orientation(Blade b)
{
    const Blade euclid = b & kEuclid;
    return euclid == kI || euclid == kK ? -1 : 1;
}

// Coefficient of the null part `out` in the product of the null parts a and b. All consist of einf and e0 alone. With E
// = einf^e0, the products are einf e0 = E - 1, e0 einf = -E - 1, E einf = -einf, einf E = einf, E e0 = e0, e0 E = -e0,
// E E = 1.
constexpr int null_coefficient(Blade a, Blade b, Blade out)
{
    const Blade big = kEinf | kE0;
    if (a == kScalar) return out == b ? 1 : 0;
    if (b == kScalar) return out == a ? 1 : 0;
    if (a == big && b == big) return out == kScalar ? 1 : 0;
    if (a == big) return out == b ? (b == kE0 ? 1 : -1) : 0;
    if (b == big) return out == a ? (a == kE0 ? -1 : 1) : 0;
    if (a == b) return 0;
    if (out == kScalar) return -1;
    return out == big ? (a == kEinf ? 1 : -1) : 0;
}

// Coefficient of blade `out` in the geometric product of the blades a and b: -1, 0 or 1.
constexpr int geometric(Blade a, Blade b, Blade out)
{
    const Blade euclid_a = a & kEuclid, euclid_b = b & kEuclid, null_a = a & ~kEuclid, null_b = b & ~kEuclid;
    if ((euclid_a ^ euclid_b) != (out & kEuclid)) return 0;
    const int past =
        grade(null_a) * grade(euclid_b) % 2 == 0 ? 1 : -1;  // b's Euclidean part moves left past a's null part
    return past * order_sign(euclid_a, euclid_b) * null_coefficient(null_a, null_b, out & ~kEuclid) * orientation(a) *
           orientation(b) * orientation(out);
}

enum class Product { geometric, outer, inner };

constexpr int coefficient(Product kind, Blade a, Blade b, Blade out)
{
    const int r = grade(a), s = grade(b);
    if (kind == Product::outer && grade(out) != r + s) return 0;
    if (kind == Product::inner && grade(out) != (r > s ? r - s : s - r)) return 0;
    return geometric(a, b, out);
}

struct Term {
    Blade a, b;
    int sign;
};
struct Terms {
    Term term[64];
    std::size_t count;
};

// The products of components that add up to component `out`. A positive term comes first, if there is one, so that
// nothing has to be negated. The Euclidean parts of `out` and of one factor's blade determine the other factor's.
constexpr Terms terms(Product kind, BladeSet a, BladeSet b, Blade out)
{
    Terms list{};
    for (Blade x = 0; x < 32; ++x) {
        if (!(a >> x & 1u)) continue;
        for (const Blade null_y : {kScalar, kEinf, kE0, kEinf | kE0}) {
            const Blade y = ((x ^ out) & kEuclid) | null_y;
            if (!(b >> y & 1u)) continue;
            if (const int sign = coefficient(kind, x, y, out); sign != 0) list.term[list.count++] = {x, y, sign};
        }
    }
    for (std::size_t n = 1; n < list.count; ++n)
        if (list.term[0].sign < 0 && list.term[n].sign > 0) std::swap(list.term[0], list.term[n]);
    return list;
}

constexpr BladeSet product_blades(Product kind, BladeSet a, BladeSet b)
{
    BladeSet set = 0;
    for (Blade out = 0; out < 32; ++out)
        if (terms(kind, a, b, out).count != 0) set |= BladeSet{1} << out;
    return set;
}

constexpr Blade nth_blade(BladeSet set, std::size_t n)
{
    for (; n > 0; --n) set &= set - 1;
    return static_cast<Blade>(std::countr_zero(set));
}
constexpr std::size_t index_of(BladeSet set, Blade b)
{
    return static_cast<std::size_t>(std::popcount(set & ((BladeSet{1} << b) - 1u)));
}

template <BladeSet S>
using Components = std::make_index_sequence<std::popcount(S)>;

// Computed once for each pair of types, and not for each component.
template <Product Kind, BladeSet A, BladeSet B>
inline constexpr BladeSet kProductBlades = product_blades(Kind, A, B);
template <Product Kind, BladeSet A, BladeSet B, Blade Out>
inline constexpr Terms kTerms = terms(Kind, A, B, Out);

}  // namespace table

// A multivector with exactly the blades of set S, its components in ascending order of blade. Compilers need its copies
// always inlined (core/isa.h), so it defines its own copies.
template <class T, BladeSet S>
struct Mv {
    static_assert(S != 0, "this product is zero for every value");
    static constexpr BladeSet set = S;
    static constexpr std::size_t count = std::popcount(S);
    T c[count];

    Mv() = default;
    template <class... X>
    requires(sizeof...(X) == count && (std::is_same_v<X, T> && ...)) SWIVEL_ALWAYS_INLINE constexpr explicit(count == 1)
        Mv(const X&... x)
        : c{x...}
    {
    }
    SWIVEL_ALWAYS_INLINE constexpr Mv(const Mv& other) : Mv(other, table::Components<S>{}) {}
    SWIVEL_ALWAYS_INLINE constexpr Mv& operator=(const Mv& other)
    {
        assign(other, table::Components<S>{});
        return *this;
    }

    template <Blade B>
    static constexpr std::size_t index()
    {
        static_assert((S >> B & 1u) != 0, "this multivector does not have that blade");
        return table::index_of(S, B);
    }
    template <Blade B>
    SWIVEL_ALWAYS_INLINE constexpr const T& at() const
    {
        return c[index<B>()];
    }
    template <Blade B>
    SWIVEL_ALWAYS_INLINE constexpr T& at()
    {
        return c[index<B>()];
    }

private:
    template <std::size_t... N>
    SWIVEL_ALWAYS_INLINE constexpr Mv(const Mv& other, std::index_sequence<N...>) : c{other.c[N]...}
    {
    }
    template <std::size_t... N>
    SWIVEL_ALWAYS_INLINE constexpr void assign(const Mv& other, std::index_sequence<N...>)
    {
        ((c[N] = other.c[N]), ...);
    }
};

// Results as lists of their components. Closures would read better, but compile far more slowly (core/isa.h).
namespace by_component {

template <bool Minus, class T>
SWIVEL_ALWAYS_INLINE constexpr T with_sign(const T& x)
{
    if constexpr (Minus)
        return -x;
    else
        return x;
}
// Each component is one of m, or its negative. A rule says which.
struct Moved {
    Blade from;
    bool minus;
};
constexpr Moved same(Blade b) { return {b, false}; }
constexpr Moved negative(Blade b) { return {b, true}; }
constexpr Moved reversed(Blade b) { return {b, grade(b) % 4 >= 2}; }
template <Blade B, BladeSet S>
constexpr Moved times(Blade b)
{
    const table::Term term = table::terms(table::Product::geometric, S, blades(B), b).term[0];
    return {term.a, term.sign < 0};
}
template <Moved (*Rule)(Blade), BladeSet Out, class T, BladeSet S, std::size_t... N>
SWIVEL_ALWAYS_INLINE constexpr Mv<T, Out> moved(const Mv<T, S>& m, std::index_sequence<N...>)
{
    return Mv<T, Out>(
        with_sign<Rule(table::nth_blade(Out, N)).minus>(m.template at<Rule(table::nth_blade(Out, N)).from>())...);
}

template <bool Minus, Blade N, class T, BladeSet A, BladeSet B>
SWIVEL_ALWAYS_INLINE constexpr T sum(const Mv<T, A>& a, const Mv<T, B>& b)
{
    if constexpr (!(A >> N & 1u))
        return with_sign<Minus>(b.template at<N>());
    else if constexpr (!(B >> N & 1u))
        return a.template at<N>();
    else if constexpr (Minus)
        return a.template at<N>() - b.template at<N>();
    else
        return a.template at<N>() + b.template at<N>();
}
template <bool Minus, class T, BladeSet A, BladeSet B, std::size_t... N>
SWIVEL_ALWAYS_INLINE constexpr Mv<T, A | B> sums(const Mv<T, A>& a, const Mv<T, B>& b, std::index_sequence<N...>)
{
    return Mv<T, A | B>(sum<Minus, table::nth_blade(A | B, N)>(a, b)...);
}

// The first terms of a component of a product, up to number N.
template <const table::Terms& terms, std::size_t N, class T, BladeSet A, BladeSet B>
SWIVEL_ALWAYS_INLINE constexpr T add_up(const Mv<T, A>& a, const Mv<T, B>& b)
{
    constexpr table::Term term = terms.term[N];
    if constexpr (N == 0)
        return with_sign<(term.sign < 0)>(a.template at<term.a>() * b.template at<term.b>());
    else if constexpr (term.sign > 0)
        return add_up<terms, N - 1>(a, b) + a.template at<term.a>() * b.template at<term.b>();
    else
        return add_up<terms, N - 1>(a, b) - a.template at<term.a>() * b.template at<term.b>();
}
template <table::Product Kind, BladeSet Part, class T, BladeSet A, BladeSet B, std::size_t... N>
SWIVEL_ALWAYS_INLINE constexpr Mv<T, Part> products(const Mv<T, A>& a, const Mv<T, B>& b, std::index_sequence<N...>)
{
    return Mv<T, Part>(add_up<table::kTerms<Kind, A, B, table::nth_blade(Part, N)>,
                              table::kTerms<Kind, A, B, table::nth_blade(Part, N)>.count - 1>(a, b)...);
}

template <class T, BladeSet S, std::size_t... N>
SWIVEL_ALWAYS_INLINE constexpr Mv<T, S> multiples(const T& scalar, const Mv<T, S>& m, std::index_sequence<N...>)
{
    return Mv<T, S>((scalar * m.c[N])...);
}
template <class T, BladeSet S, std::size_t... N>
SWIVEL_ALWAYS_INLINE constexpr Mv<T, S> selected(const Mask<T>& mask, const Mv<T, S>& a, const Mv<T, S>& b,
                                                 std::index_sequence<N...>)
{
    return Mv<T, S>(select(mask, a.c[N], b.c[N])...);
}
template <class T, BladeSet S, std::size_t... N>
SWIVEL_ALWAYS_INLINE constexpr Mv<T, S> flipped(const Mv<T, S>& m, const T& sign, std::index_sequence<N...>)
{
    return Mv<T, S>(flip_sign(m.c[N], sign)...);
}

}  // namespace by_component

// A basis blade with coefficient 1.
template <class T, Blade B>
SWIVEL_ALWAYS_INLINE constexpr Mv<T, blades(B)> unit()
{
    return Mv<T, blades(B)>(T(1));
}

// The chosen blades of a multivector, which must have them all.
template <BladeSet Part, class T, BladeSet S>
SWIVEL_ALWAYS_INLINE constexpr Mv<T, Part> part(const Mv<T, S>& m)
{
    return by_component::moved<by_component::same, Part>(m, table::Components<Part>{});
}
// All blades of one grade.
template <int Grade, class T, BladeSet S>
SWIVEL_ALWAYS_INLINE constexpr auto grade_part(const Mv<T, S>& m)
{
    return part<blades_of_grade(S, Grade)>(m);
}

template <class T, BladeSet S>
SWIVEL_ALWAYS_INLINE constexpr Mv<T, S> operator-(const Mv<T, S>& m)
{
    return by_component::moved<by_component::negative, S>(m, table::Components<S>{});
}
template <class T, BladeSet A, BladeSet B>
SWIVEL_ALWAYS_INLINE constexpr Mv<T, A | B> operator+(const Mv<T, A>& a, const Mv<T, B>& b)
{
    return by_component::sums<false>(a, b, table::Components<A | B>{});
}
template <class T, BladeSet A, BladeSet B>
SWIVEL_ALWAYS_INLINE constexpr Mv<T, A | B> operator-(const Mv<T, A>& a, const Mv<T, B>& b)
{
    return by_component::sums<true>(a, b, table::Components<A | B>{});
}

template <class T, BladeSet S>
SWIVEL_ALWAYS_INLINE constexpr Mv<T, S> operator*(const T& scalar, const Mv<T, S>& m)
{
    return by_component::multiples(scalar, m, table::Components<S>{});
}

// The chosen blades of a product, which must have them all.
template <table::Product Kind, BladeSet Part, class T, BladeSet A, BladeSet B>
SWIVEL_ALWAYS_INLINE constexpr Mv<T, Part> product_part(const Mv<T, A>& a, const Mv<T, B>& b)
{
    return by_component::products<Kind, Part>(a, b, table::Components<Part>{});
}
// The whole product.
template <table::Product Kind, class T, BladeSet A, BladeSet B>
SWIVEL_ALWAYS_INLINE constexpr auto product(const Mv<T, A>& a, const Mv<T, B>& b)
{
    return product_part<Kind, table::kProductBlades<Kind, A, B>>(a, b);
}
// Geometric product.
template <class T, BladeSet A, BladeSet B>
SWIVEL_ALWAYS_INLINE constexpr auto operator*(const Mv<T, A>& a, const Mv<T, B>& b)
{
    return product<table::Product::geometric>(a, b);
}
// Outer product.
template <class T, BladeSet A, BladeSet B>
SWIVEL_ALWAYS_INLINE constexpr auto operator^(const Mv<T, A>& a, const Mv<T, B>& b)
{
    return product<table::Product::outer>(a, b);
}
// Inner product: of blades of grades r and s, the part of grade |r - s| of the geometric product.
template <class T, BladeSet A, BladeSet B>
SWIVEL_ALWAYS_INLINE constexpr auto dot(const Mv<T, A>& a, const Mv<T, B>& b)
{
    return product<table::Product::inner>(a, b);
}
// The scalar product <ab>, as a number.
template <class T, BladeSet A, BladeSet B>
SWIVEL_ALWAYS_INLINE constexpr T scalar_product(const Mv<T, A>& a, const Mv<T, B>& b)
{
    return product_part<table::Product::geometric, blades(kScalar)>(a, b).c[0];
}

// Reverse: the order of each blade's vectors turned round.
template <class T, BladeSet S>
SWIVEL_ALWAYS_INLINE constexpr Mv<T, S> operator~(const Mv<T, S>& m)
{
    return by_component::moved<by_component::reversed, S>(m, table::Components<S>{});
}

// The geometric product m * B with a basis blade that contains einf and e0 both, or neither. Components change places
// and signs, and nothing is multiplied.
template <Blade B, class T, BladeSet S>
SWIVEL_ALWAYS_INLINE constexpr auto times_blade(const Mv<T, S>& m)
{
    constexpr BladeSet set = table::kProductBlades<table::Product::geometric, S, blades(B)>;
    static_assert(((B & kEinf) != 0) == ((B & kE0) != 0), "components would add up");
    return by_component::moved<by_component::times<B, S>, set>(m, table::Components<set>{});
}

// dual(A) = A I^-1, where I = e1^e2^e3^einf^e0 and I^-1 = -I.
template <class T, BladeSet S>
SWIVEL_ALWAYS_INLINE constexpr auto dual(const Mv<T, S>& m)
{
    return -times_blade<kPseudoscalar>(m);
}

// Component by component, a where the mask holds, b elsewhere.
template <class T, BladeSet S>
SWIVEL_ALWAYS_INLINE constexpr Mv<T, S> select(const Mask<T>& mask, const Mv<T, S>& a, const Mv<T, S>& b)
{
    return by_component::selected(mask, a, b, table::Components<S>{});
}
// m, negated where the sign bit of `sign` is set.
template <class T, BladeSet S>
SWIVEL_ALWAYS_INLINE constexpr Mv<T, S> flip_sign(const Mv<T, S>& m, const T& sign)
{
    return by_component::flipped(m, sign, table::Components<S>{});
}

}  // namespace swivel::inline SWIVEL_ISA
