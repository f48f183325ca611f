// SPDX-License-Identifier: MIT
//
// The promise: the compile-time algebra is the dense algebra, which shares no code with it, in every product, sum and
// entity. So it has every identity of the lecture, which test_dense.cpp proves. The type of a product has exactly the
// blades that it can have.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <type_traits>

#include "core/conformal.h"
#include "core/dense.h"
#include "tests/test_random.h"

namespace {

using namespace swivel;
using swivel::test::Random;
using Dense = swivel::dense::Multivector;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kTolerance = 1e-12;  // a few products of numbers of size 1; larger ones say so
constexpr int kRounds = 200;

constexpr auto e1 = unit<double, kE1>();
constexpr auto e0 = unit<double, kE0>();
constexpr auto einf = unit<double, kEinf>();
constexpr auto i = unit<double, kI>();
constexpr auto j = unit<double, kJ>();
constexpr auto k = unit<double, kK>();
constexpr auto one = unit<double, kScalar>();

// A basis blade on the dense algebra's own vectors, as algebra.h's head comment defines it.
Dense dense_blade(Blade b)
{
    namespace d = swivel::dense;
    const Blade euclid = b & kEuclid;
    Dense m = 1.0;
    if (euclid == kI)
        m = d::i;
    else if (euclid == kJ)
        m = d::j;
    else if (euclid == kK)
        m = d::k;
    else {
        if (euclid & kE1) m = m ^ d::e1;
        if (euclid & kE2) m = m ^ d::e2;
        if (euclid & kE3) m = m ^ d::e3;
    }
    if (b & kEinf) m = m ^ d::einf;
    if (b & kE0) m = m ^ d::e0;
    return m;
}

template <BladeSet S>
Dense dense_of(const Mv<double, S>& m)
{
    Dense sum;
    std::size_t n = 0;
    for (Blade b = 0; b < 32; ++b)
        if (S >> b & 1u) sum = sum + Dense(m.c[n++]) * dense_blade(b);
    return sum;
}

double distance(const Dense& a, const Dense& b)
{
    double sum = 0;
    for (unsigned blade = 0; blade < 32; ++blade) sum += std::fabs(a.c[blade] - b.c[blade]);
    return sum;
}
template <BladeSet A, BladeSet B>
double distance(const Mv<double, A>& a, const Mv<double, B>& b)
{
    return distance(dense_of(a), dense_of(b));
}

template <BladeSet S>
Mv<double, S> random_mv(Random& random)
{
    Mv<double, S> m;
    for (double& c : m.c) c = random.between(-1, 1);
    return m;
}
// Components base, base^2, base^3 and so on.
template <BladeSet S>
Mv<double, S> powers(double base)
{
    Mv<double, S> m;
    double power = 1;
    for (double& c : m.c) c = power *= base;
    return m;
}

Vector<double> mv(const Vector3d& v) { return vector(v.x(), v.y(), v.z()); }
Rotor<double> mv(const Quaterniond& q) { return rotor(q.x(), q.y(), q.z(), q.w()); }
Vector3d any_vector(Random& random) { return random.vector(0.1, 3); }

// ---- what the compiler must know

template <class A, class B>
constexpr bool has_blades_of = std::remove_cvref_t<A>::set == std::remove_cvref_t<B>::set;

constexpr std::size_t count_terms(table::Product kind, BladeSet a, BladeSet b)
{
    std::size_t count = 0;
    for (Blade out = 0; out < 32; ++out) count += table::terms(kind, a, b, out).count;
    return count;
}

constexpr Point<double> p1 = point(vector(1.0, 2.0, 3.0));
constexpr auto s1 = sphere(p1, 2.0);
constexpr auto s2 = e0 - 0.5 * einf;
constexpr auto pp_half = s1 ^ s2;
constexpr auto pp = pp_half ^ vector(0.0, 1.0, 0.0);

static_assert(decltype(p1)::set == blades(kE1, kE2, kE3, kEinf, kE0) && sizeof p1 == 5 * sizeof(double));
static_assert(decltype(s2)::set == blades(kE0, kEinf));
static_assert(decltype(pp_half)::set ==
              blades(kE1 | kEinf, kE2 | kEinf, kE3 | kEinf, kE1 | kE0, kE2 | kE0, kE3 | kE0, kEinf | kE0));
static_assert(count_terms(table::Product::outer, s1.set, s2.set) == 8);  // 3 + 3, and e0 with einf twice
static_assert(decltype(pp)::count == 9);                                 // i j k with einf, with e0; e1 e2 e3 with both
static_assert(count_terms(table::Product::outer, pp_half.set, Vector<double>::set) ==
              15);  // two each but for the last three
static_assert(count_terms(table::Product::geometric, Rotor<double>::set, Rotor<double>::set) == 16);
static_assert(count_terms(table::Product::geometric, ~0u, ~0u) == 1024);
static_assert(has_blades_of<decltype(std::declval<Rotor<double>>() * std::declval<Rotor<double>>()), Rotor<double>>);
static_assert(has_blades_of<decltype(i * j), decltype(k)>);
static_assert(has_blades_of<decltype(e1 * e1), decltype(one)>);
static_assert(decltype(einf * e0)::set == blades(kScalar, kEinf | kE0));
static_assert(decltype(einf ^ e0)::set == blades(kEinf | kE0));
static_assert(has_blades_of<decltype(dot(einf, e0)), decltype(one)>);
static_assert(has_blades_of<decltype(dual(e0 ^ p1 ^ einf)), CentralLine<double>>);
static_assert(has_blades_of<decltype(cross(vector(1.0, 0.0, 0.0), vector(0.0, 1.0, 0.0))), Vector<double>>);
static_assert(blades_of_grade(~0u, 2) == (blades(kI, kJ, kK, kEinf | kE0) | blades(9, 10, 12, 17, 18, 20)));
// Whole computations are constants: 3 * 1 + 0 - ... without a run-time instruction.
static_assert((i * i).c[0] == -1 && (j * j).c[0] == -1 && (k * k).c[0] == -1 && (i * j * k).c[0] == -1);
static_assert(dot(e0, einf).c[0] == -1 && dot(einf, e0).c[0] == -1);

}  // namespace

// ---- beside products

TEST_CASE("points, spheres, lines and rotors are the dense algebra's; what has no such counterpart is Eigen's")
{
    Random random{8};
    for (int n = 0; n < kRounds; ++n) {
        const Vector3d a = any_vector(random), b = any_vector(random);
        const Dense p = swivel::dense::point(dense_of(mv(a)));
        CHECK(distance(dense_of(point(mv(a))), p) < kTolerance);
        CHECK(distance(dense_of(sphere(point(mv(a)), b.norm())), swivel::dense::sphere(p, b.norm())) < 1e-11);
        CHECK(distance(dense_of(central_line(mv(a))), swivel::dense::dual(dense_of(e0) ^ p ^ dense_of(einf))) <
              kTolerance);
        CHECK(distance(cross(mv(a), mv(b)), mv(Vector3d(a.cross(b)))) < 1e-11);
        CHECK(std::fabs(scalar_product(mv(a), mv(b)) - a.dot(b)) < 1e-11);
        CHECK(std::fabs(len2(mv(a)) - a.squaredNorm()) < 1e-11);
        CHECK(distance(normalise(mv(a)), mv(Vector3d(a.normalized()))) < kTolerance);
        // A rotor of another length lengthens, too.
        const Quaterniond turn = random.rotation();
        const Rotor<double> q = mv(turn);
        CHECK(distance(sandwich(3.0 * q, mv(a)), 9.0 * mv(Vector3d(turn * a))) < 1e-11);
        CHECK(distance(normalise(3.0 * q), q) < kTolerance);
        CHECK((q.at<kI>() == turn.x() && q.at<kJ>() == turn.y() && q.at<kK>() == turn.z()));
        CHECK(q.at<kScalar>() == turn.w());
    }
}

TEST_CASE("components are chosen, read and selected by blade")
{
    const Point<double> p = point(vector(1.0, 2.0, 2.0));
    CHECK(p.at<kE2>() == 2);
    CHECK(p.at<kEinf>() == 4.5);
    CHECK(p.at<kE0>() == 1);
    CHECK(distance(part<blades(kE1, kEinf)>(p), e1 + 4.5 * einf) == 0);
    const auto mixed = p * vector(0.5, 1.0, 1.5);
    CHECK(distance(dense_of(grade_part<2>(mixed)), dense_of(p ^ vector(0.5, 1.0, 1.5))) == 0);
    const Vector<double> a = vector(1.0, 2.0, 3.0), b = vector(4.0, 5.0, 6.0);
    CHECK(distance(select(true, a, b), a) == 0);
    CHECK(distance(select(false, a, b), b) == 0);
}

// ---- against the dense algebra

namespace {

constexpr BladeSet kSets[] = {
    blades(kScalar),
    blades(kE2),
    Vector<double>::set,
    Plane<double>::set,
    Point<double>::set,
    CentralLine<double>::set,
    Rotor<double>::set,
    blades(kEinf | kE0),
    blades(kE0, kE1 | kEinf, kJ | kE0, kPseudoscalar),  // no grade in particular
    blades_of_grade(~0u, 2),
    blades_of_grade(~0u, 3),
    blades_of_grade(~0u, 4),
    blades(kPseudoscalar),
    blades_of_grade(~0u, 0) | blades_of_grade(~0u, 2) | blades_of_grade(~0u, 4),
};

// Not templates themselves, so that Catch2's part of them is compiled once.
void check_near(const char* what, BladeSet a, BladeSet b, const Dense& got, const Dense& want, double tolerance)
{
    INFO(what << " of " << std::hex << a << " and " << b);
    CHECK(distance(got, want) <= tolerance);
}
void check_no_zero(const char* what, BladeSet a, BladeSet b, const double* first, std::size_t count)
{
    INFO(what << " of " << std::hex << a << " and " << b);
    for (std::size_t n = 0; n < count; ++n) CHECK(first[n] != 0);
}

template <table::Product Kind, BladeSet A, BladeSet B>
void check_product(Random& random)
{
    using table::Product;
    const auto a = random_mv<A>(random);
    const auto b = random_mv<B>(random);
    const Dense da = dense_of(a), db = dense_of(b);
    const Dense want = Kind == Product::geometric ? da * db
                       : Kind == Product::outer   ? (da ^ db)
                                                  : swivel::dense::dot(da, db);
    constexpr const char* what = Kind == Product::geometric ? "geometric product"
                                 : Kind == Product::outer   ? "outer product"
                                                            : "inner product";
    if constexpr (table::product_blades(Kind, A, B) != 0) {
        check_near(what, A, B, dense_of(product<Kind>(a, b)), want, kTolerance);
        // No blade too many: with coefficients that do not cancel, each component is there.
        const auto each = product<Kind>(powers<A>(1.7), powers<B>(1.9));
        check_no_zero(what, A, B, &each.c[0], each.count);
    } else {
        check_near(what, A, B, 0.0, want, 0);
    }
}

template <BladeSet A, BladeSet B>
void check_pair(Random& random)
{
    check_product<table::Product::geometric, A, B>(random);
    check_product<table::Product::outer, A, B>(random);
    check_product<table::Product::inner, A, B>(random);
}

template <BladeSet S>
void check_one(Random& random)
{
    const auto a = random_mv<S>(random), same = random_mv<S>(random);
    const auto other = random_mv<Point<double>::set>(random);
    check_near("sum", S, S, dense_of(a + same), dense_of(a) + dense_of(same), kTolerance);
    check_near("sum", S, other.set, dense_of(a + other), dense_of(a) + dense_of(other), kTolerance);
    check_near("difference", S, other.set, dense_of(a - other), dense_of(a) - dense_of(other), kTolerance);
    check_near("negative", S, S, dense_of(-a), -dense_of(a), 0);
    check_near("reverse", S, S, dense_of(~a), ~dense_of(a), kTolerance);
    check_near("dual", S, S, dense_of(dual(a)), swivel::dense::dual(dense_of(a)), kTolerance);
    check_near("multiple", S, S, dense_of(2.5 * a), Dense(2.5) * dense_of(a), kTolerance);
    check_near("product with i", S, S, dense_of(times_blade<kI>(a)), dense_of(a) * swivel::dense::i, kTolerance);
    if constexpr (table::product_blades(table::Product::geometric, S, S) & 1u)
        check_near("scalar product", S, S, scalar_product(a, a), (dense_of(a) * dense_of(a)).c[0], kTolerance);
}

template <std::size_t... N>
void check_all_pairs(Random& random, std::index_sequence<N...>)
{
    constexpr std::size_t count = std::size(kSets);
    (check_pair<kSets[N / count], kSets[N % count]>(random), ...);
}
template <std::size_t... N>
void check_all_sets(Random& random, std::index_sequence<N...>)
{
    (check_one<kSets[N]>(random), ...);
}

}  // namespace

TEST_CASE("products of every pair of blade sets are the dense algebra's")
{
    Random random{9};
    for (int n = 0; n < 5; ++n)
        check_all_pairs(random, std::make_index_sequence<std::size(kSets) * std::size(kSets)>{});
}

TEST_CASE("sum, reverse, dual, negative and multiples of every blade set are the dense algebra's")
{
    Random random{10};
    for (int n = 0; n < 20; ++n) check_all_sets(random, std::make_index_sequence<std::size(kSets)>{});
    for (int n = 0; n < 20; ++n) check_one<0xffffffffu>(random);
}
