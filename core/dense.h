// SPDX-License-Identifier: MIT
//
// Conformal geometric algebra G(4,1) with all 32 coefficients of a multivector, in double: slow and obviously right.
// The oracle and its tests stand on this file alone, so it shares no code with algebra.h. Conventions are those of
// D. Hildenbrand, "Inverse Kinematics of a Virtual Character" (TU Darmstadt, 2019); numbers (3.9) are its equations.
// Coefficients stand on the orthonormal basis e1 e2 e3 e+ e-. Bit n of an index says that the n-th of these is a
// factor of the blade, so c[0b00011] belongs to e1 e2. Degenerate input (a zero inverse) gives inf or NaN.
#pragma once

#include <cmath>

namespace swivel::dense {

struct Multivector {
    double c[32] = {};
    constexpr Multivector() = default;
    constexpr Multivector(double scalar) : c{scalar} {}  // implicit: the algebra contains its numbers
};

// Number of basis vectors in a blade.
constexpr int grade(unsigned blade)
{
    int count = 0;
    for (; blade != 0; blade >>= 1) count += int(blade & 1);
    return count;
}

// Sign of the product of two basis blades. To sort the factors, each factor of `left` moves past every lower factor of
// `right`, with one swap each. Then each shared factor squares to 1, except (e-)^2 = -1.
constexpr double blade_sign(unsigned left, unsigned right)
{
    int swaps = 0;
    for (unsigned higher = left >> 1; higher != 0; higher >>= 1) swaps += grade(higher & right);
    const int negative_squares = grade(left & right & 0b10000);
    return (swaps + negative_squares) % 2 == 0 ? 1.0 : -1.0;
}

// Sum of the blade products whose grades (left, right, result) are kept. Zeros of A are skipped for speed alone.
template <class Keep>
constexpr Multivector product(const Multivector& A, const Multivector& B, Keep keep)
{
    Multivector sum;
    for (unsigned a = 0; a < 32; ++a) {
        if (A.c[a] == 0) continue;
        for (unsigned b = 0; b < 32; ++b)
            if (keep(grade(a), grade(b), grade(a ^ b))) sum.c[a ^ b] += blade_sign(a, b) * A.c[a] * B.c[b];
    }
    return sum;
}

// Geometric product.
constexpr Multivector operator*(const Multivector& A, const Multivector& B)
{
    return product(A, B, [](int, int, int) { return true; });
}

// Outer product: the part of grade r + s. C++ binds ^ weaker than + - * and ==: bracket it beside them.
constexpr Multivector operator^(const Multivector& A, const Multivector& B)
{
    return product(A, B, [](int r, int s, int t) { return t == r + s; });
}

// Inner product, the lecture's dot: the part of grade |r - s|. A scalar factor just multiplies.
constexpr Multivector dot(const Multivector& A, const Multivector& B)
{
    return product(A, B, [](int r, int s, int t) { return t == (r > s ? r - s : s - r); });
}

constexpr Multivector operator+(const Multivector& A, const Multivector& B)
{
    Multivector sum;
    for (unsigned a = 0; a < 32; ++a) sum.c[a] = A.c[a] + B.c[a];
    return sum;
}

constexpr Multivector operator-(const Multivector& A) { return -1.0 * A; }
constexpr Multivector operator-(const Multivector& A, const Multivector& B) { return A + (-B); }
constexpr Multivector operator/(const Multivector& A, double s) { return (1.0 / s) * A; }

// The part of one grade.
constexpr Multivector grade_part(const Multivector& A, int wanted)
{
    Multivector part;
    for (unsigned a = 0; a < 32; ++a)
        if (grade(a) == wanted) part.c[a] = A.c[a];
    return part;
}

constexpr double scalar(const Multivector& A) { return A.c[0]; }

// Reverse: the factors of every blade in opposite order, r (r - 1) / 2 swaps.
constexpr Multivector operator~(const Multivector& A)
{
    Multivector reversed;
    for (unsigned a = 0; a < 32; ++a) reversed.c[a] = grade(a) * (grade(a) - 1) / 2 % 2 == 0 ? A.c[a] : -A.c[a];
    return reversed;
}

// |A|, and the inverse; both only where A ~A is a scalar, as for blades and rotors.
inline double norm(const Multivector& A) { return std::sqrt(std::fabs(scalar(A * ~A))); }
constexpr Multivector inverse(const Multivector& A) { return ~A / scalar(A * ~A); }

// Basis vector number n.
constexpr Multivector basis(unsigned n)
{
    Multivector e;
    e.c[1u << n] = 1;
    return e;
}

inline constexpr Multivector e1 = basis(0), e2 = basis(1), e3 = basis(2);
inline constexpr Multivector eplus = basis(3), eminus = basis(4);
inline constexpr Multivector e0 = (eminus - eplus) / 2;  // origin: e0^2 = 0, e0 . einf = -1
inline constexpr Multivector einf = eminus + eplus;      // infinity: einf^2 = 0

// Table 3.2: the quaternion units.
inline constexpr Multivector i = e3 ^ e2, j = e1 ^ e3, k = e2 ^ e1;

// The pseudoscalar, and dual(A) = A I^-1: from o* (outer product of points) to o (intersection of spheres and planes).
inline constexpr Multivector I = e1 ^ e2 ^ e3 ^ einf ^ e0;
constexpr Multivector dual(const Multivector& A) { return A * inverse(I); }

// Euclidean vector; point (3.9) P = x + x^2/2 einf + e0; sphere S = P - r^2/2 einf; plane n + d einf.
constexpr Multivector vector(double x, double y, double z) { return x * e1 + y * e2 + z * e3; }
constexpr Multivector point(const Multivector& x) { return x + 0.5 * x * x * einf + e0; }
constexpr Multivector sphere(const Multivector& P, double r) { return P - 0.5 * r * r * einf; }
constexpr Multivector plane(const Multivector& n, double d) { return n + d * einf; }

// A point of the point pair PP: (PP* + side sqrt(PP* . PP*)) / (einf . PP*), side = +1 or -1, with e0 coefficient 1.
inline Multivector point_of_pair(const Multivector& PP, double side)
{
    const Multivector PP_dual = dual(PP);
    const double root = std::sqrt(scalar(dot(PP_dual, PP_dual)));
    const Multivector P = (PP_dual + side * root) * inverse(dot(einf, PP_dual));
    return grade_part(P, 1) / -scalar(dot(einf, P));
}

}  // namespace swivel::dense
