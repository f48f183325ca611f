// SPDX-License-Identifier: MIT
//
// The promise: dense.h is the algebra of D. Hildenbrand, "Inverse Kinematics of a Virtual Character" (TU Darmstadt,
// 2019). The axioms, and the identities of the lecture, numbered as there. (3.19, 3.20, 3.22) follow from the square of
// a line, (3.18). The arm's own steps, (7.1-7.4) and (7.6-7.9), are judged by swivel_verify(), in test_formulas.cpp.
// Rotations and cross products are judged by Eigen.

#include "core/dense.h"

#include <rapidcheck/catch.h>
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace {

using namespace swivel::dense;
using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;

// Rounding of a few products of numbers up to 10.
constexpr double kTolerance = 1e-11;

Multivector dense(const Vector3d& v) { return vector(v.x(), v.y(), v.z()); }
Multivector pure(const Vector3d& v) { return v.x() * i + v.y() * j + v.z() * k; }

double distance(const Multivector& A, const Multivector& B)
{
    double sum = 0;
    for (unsigned blade = 0; blade < 32; ++blade) sum += std::fabs(A.c[blade] - B.c[blade]);
    return sum;
}

bool same(const Multivector& A, const Multivector& B) { return distance(A, B) < kTolerance; }

// Even over [lo, hi] whatever size rapidcheck asks for; shrinks towards lo.
double uniform(double lo, double hi)
{
    const int steps = 1000000;
    const int step = *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, steps + 1));
    return lo + (hi - lo) * step / steps;
}

Multivector any_multivector()
{
    Multivector A;
    for (double& coefficient : A.c) coefficient = uniform(-1, 1);
    return A;
}

Multivector any_grade(int wanted) { return grade_part(any_multivector(), wanted); }

Vector3d any_vector()
{
    const double x = uniform(-3, 3), y = uniform(-3, 3), z = uniform(-3, 3);
    return {x, y, z};
}

Vector3d any_direction()
{
    const double azimuth = uniform(-kPi, kPi), height = uniform(-1, 1);
    const double radius = std::sqrt(1 - height * height);
    return {radius * std::cos(azimuth), radius * std::sin(azimuth), height};
}

}  // namespace

TEST_CASE("the dense basis has the metric of G(4,1)", "[dense]")
{
    for (const Multivector& e : {e1, e2, e3, eplus}) CHECK(distance(e * e, 1) == 0);
    CHECK(distance(eminus * eminus, -1) == 0);
    CHECK(distance(e0 * e0, 0) == 0);
    CHECK(distance(einf * einf, 0) == 0);
    CHECK(distance(dot(e0, einf), -1) == 0);
    for (const Multivector& e : {e1, e2, e3}) {
        CHECK(distance(dot(e, e0), 0) == 0);
        CHECK(distance(dot(e, einf), 0) == 0);
    }
    // Where the head comment of dense.h puts the coefficients.
    CHECK((e1 * e2).c[0b00011] == 1);
    CHECK((e1 * e2 * e3).c[0b00111] == 1);
    CHECK((eplus * eminus).c[0b11000] == 1);
    CHECK(distance(I * I, -1) == 0);
    CHECK(distance(dual(I), 1) == 0);
    // Table 3.2: quaternions are bivectors. (3.18) has the products of i, j and k.
    CHECK(distance(e1 ^ e2, -k) == 0);
    CHECK(distance(e1 ^ e3, j) == 0);
    CHECK(distance(e2 ^ e3, -i) == 0);
}

TEST_CASE("the products obey the axioms", "[dense]")
{
    rc::prop("the geometric and the outer product are associative", [] {
        const Multivector A = any_multivector(), B = any_multivector(), C = any_multivector();
        RC_ASSERT(same((A * B) * C, A * (B * C)));
        RC_ASSERT(same((A ^ B) ^ C, A ^ (B ^ C)));
    });
    rc::prop("products distribute over sums", [] {
        const Multivector A = any_multivector(), B = any_multivector(), C = any_multivector();
        RC_ASSERT(same(A * (B + C), A * B + A * C));
        RC_ASSERT(same(A ^ (B - C), (A ^ B) - (A ^ C)));
        RC_ASSERT(same(dot(A, B + C), dot(A, B) + dot(A, C)));
    });
    rc::prop("for vectors ab = a.b + a^b, the first symmetric, the second antisymmetric", [] {
        const Multivector a = any_grade(1), b = any_grade(1);
        RC_ASSERT(same(a * b, dot(a, b) + (a ^ b)));
        RC_ASSERT(same(dot(a, b), dot(b, a)));
        RC_ASSERT(same(a ^ b, -(b ^ a)));
    });
    rc::prop("reverse is an anti-automorphism and an involution, and leaves vectors alone", [] {
        const Multivector A = any_multivector(), B = any_multivector(), a = any_grade(1);
        RC_ASSERT(same(~(A * B), ~B * ~A));
        RC_ASSERT(same(~(A ^ B), ~B ^ ~A));
        RC_ASSERT(same(~~A, A));
        RC_ASSERT(same(~a, a));
    });
    rc::prop("inner and outer product are the lowest and the highest grade of the product", [] {
        const int r = *rc::gen::inRange(0, 6), s = *rc::gen::inRange(0, 6);
        const Multivector A = any_grade(r), B = any_grade(s);
        RC_ASSERT(same(dot(A, B), grade_part(A * B, std::abs(r - s))));
        RC_ASSERT(same(A ^ B, grade_part(A * B, r + s)));
    });
    rc::prop("the dual of an outer product is an inner product with the dual", [] {
        const Multivector a = any_grade(1), B = any_grade(2);
        RC_ASSERT(same(dual(a ^ B), dot(a, dual(B))));
        RC_ASSERT(same(dual(dual(B)), -B));
    });
}

TEST_CASE("points, spheres and planes", "[dense]")
{
    rc::prop("(3.9) a point is null and P . Q = -|p - q|^2 / 2", [] {
        const Vector3d p = any_vector(), q = any_vector();
        const Multivector P = point(dense(p)), Q = point(dense(q));
        RC_ASSERT(same(P, dense(p) + 0.5 * p.squaredNorm() * einf + e0));
        RC_ASSERT(same(P * P, 0));
        RC_ASSERT(same(dot(P, Q), -0.5 * (p - q).squaredNorm()));
    });
    rc::prop("P . S is zero on the sphere, positive inside, negative outside", [] {
        const Vector3d centre = any_vector(), n = any_direction();
        const double r = uniform(0.5, 2), t = uniform(0, 4);
        const Multivector S = sphere(point(dense(centre)), r);
        RC_ASSERT(same(dot(point(dense(centre + r * n)), S), 0));
        RC_ASSERT(same(dot(point(dense(centre + t * n)), S), 0.5 * (r * r - t * t)));
        RC_ASSERT(same(S * S, r * r));
    });
    rc::prop("P . plane is the signed distance n . p - d", [] {
        const Vector3d p = any_vector(), n = any_direction();
        const double d = uniform(-2, 2);
        const Multivector pi = plane(dense(n), d);
        RC_ASSERT(same(dot(point(dense(p)), pi), n.dot(p) - d));
        RC_ASSERT(same(pi * pi, 1));
    });
}

TEST_CASE("lines and planes through the origin", "[dense]")
{
    rc::prop("(3.10-3.12, Figure 3.1) the dual line is v1 i + v2 j + v3 k", [] {
        const Vector3d v = any_vector();
        const Multivector L_dual = e0 ^ point(dense(v)) ^ einf;
        RC_ASSERT(same(L_dual, dense(v) * (einf ^ e0)));  // v1 e145 + v2 e245 + v3 e345
        RC_ASSERT(same(dual(L_dual), pure(v)));
    });
    rc::prop("the plane through the origin, P2 and P1 has the normal p1 x p2", [] {
        const Vector3d p1 = any_vector(), p2 = any_vector();
        RC_ASSERT(same(dual(e0 ^ point(dense(p2)) ^ point(dense(p1)) ^ einf), dense(p1.cross(p2))));
    });
    rc::prop("(3.18) the product of pure quaternions is -dot + cross", [] {
        const Vector3d a = any_vector(), b = any_vector();
        RC_ASSERT(same(pure(a) * pure(b), -a.dot(b) + pure(a.cross(b))));
        RC_ASSERT(same(pure(a) * pure(b) + dense(a.cross(b)) * (e1 ^ e2 ^ e3), -a.dot(b)));  // Maple's Test2
        RC_ASSERT(same(pure(a) * pure(a), -a.squaredNorm()));
    });
}

TEST_CASE("rotations by unit quaternions", "[dense]")
{
    rc::prop("(3.21, 3.23) Q o ~Q rotates vectors, points and planes as Eigen does, a b applying b first", [] {
        const Vector3d axis = any_direction(), axis2 = any_direction(), x = any_vector();
        const double phi = uniform(-kPi, kPi), phi2 = uniform(-kPi, kPi), d = uniform(-2, 2);
        const Multivector Q = std::cos(phi / 2) + pure(axis) * std::sin(phi / 2);
        const Multivector Q2 = std::cos(phi2 / 2) + pure(axis2) * std::sin(phi2 / 2);
        const Vector3d turned = Eigen::AngleAxisd(phi, axis) * x;
        RC_ASSERT(same(Q * dense(x) * ~Q, dense(turned)));
        RC_ASSERT(same(Q * point(dense(x)) * ~Q, point(dense(turned))));
        RC_ASSERT(same(Q * plane(dense(x), d) * ~Q, plane(dense(turned), d)));
        RC_ASSERT(same((Q2 * Q) * dense(x) * ~(Q2 * Q), dense(Eigen::AngleAxisd(phi2, axis2) * turned)));
    });
}

TEST_CASE("angles", "[dense]")
{
    rc::prop("(7.5) the angle between lines, and between planes, from o1 . o2", [] {
        const Vector3d a = any_direction(), b = any_direction(), p = any_vector(), q = any_vector();
        const Multivector L1_dual = point(dense(p)) ^ point(dense(p + a)) ^ einf;
        const Multivector L2_dual = point(dense(q)) ^ point(dense(q + b)) ^ einf;
        RC_ASSERT(same(dot(L1_dual, L2_dual) / (norm(L1_dual) * norm(L2_dual)), a.dot(b)));

        const Multivector pi1 = plane(dense(2 * a), uniform(-2, 2)), pi2 = plane(dense(3 * b), uniform(-2, 2));
        RC_ASSERT(same(dot(pi1, pi2) / (norm(pi1) * norm(pi2)), a.dot(b)));
        // Duals of planes meet with the other sign, I^2 = -1: why reference.cpp takes c3 from the planes themselves.
        RC_ASSERT(same(dot(dual(pi1), dual(pi2)) / (norm(dual(pi1)) * norm(dual(pi2))), -a.dot(b)));
    });
}

TEST_CASE("point pairs", "[dense]")
{
    rc::prop("the extraction formula gives back both points of A ^ B", [] {
        const Vector3d a = any_vector(), b = any_vector();
        RC_PRE((a - b).norm() > 0.1);
        const Multivector A = point(dense(a)), B = point(dense(b));
        const Multivector PP = dual(A ^ B);
        const Multivector plus = point_of_pair(PP, +1), minus = point_of_pair(PP, -1);
        // The formula divides by the distance of the points, and so does its rounding. Measured: at most 2.3e-11.
        const double worst =
            std::min(std::max(distance(plus, A), distance(minus, B)), std::max(distance(plus, B), distance(minus, A)));
        RC_ASSERT(worst * (a - b).norm() < 1e-10);
    });
}
