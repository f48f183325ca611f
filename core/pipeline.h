// SPDX-License-Identifier: MIT
//
// The five steps of the lecture, line by line, over any number type: the rotors of a 7-DOF arm from its wrist, its
// swivel plane and its lengths. Source: D. Hildenbrand, Inverse Kinematics of a Virtual Character (TU Darmstadt, 2019).
//
// Read this algorithm first; solve_arm.h solves the same arm and is exact where these formulas lose digits. This is
// valid for a wrist within reach, an arm that is neither straight nor folded, and an upper arm that is not along e3 or
// -e3. Elsewhere it divides by zero.
#pragma once

#include "core/conformal.h"

namespace swivel::inline SWIVEL_ISA {

// The results of all steps, under the lecture's names. Each product has its own type.
template <class T>
struct PipelineSteps {
    using Origin = decltype(unit<T, kE0>());
    using Infinity = decltype(unit<T, kEinf>());
    // Step 1
    Point<T> p_w;
    Vector<T> pi_swivel;
    Sphere<T> s1;
    decltype(Origin{} + Infinity{}) s2;
    decltype(Sphere<T>{} ^ s2 ^ Vector<T>{}) pp;
    Point<T> p_e;
    // Step 2
    decltype(Origin{} ^ Point<T>{} ^ Infinity{}) line_se;
    decltype(Point<T>{} ^ Point<T>{} ^ Infinity{}) line_ew;
    T c4;
    Rotor<T> q_e;
    // Step 3
    Point<T> p_ze;
    Plane<T> pi_m;
    Vector<T> pi_e;
    CentralLine<T> l_m;
    // Step 4
    CentralLine<T> q12;
    // Step 5
    T c3;
    Rotor<T> q3, q_s;

    constexpr Vector<T> elbow() const { return part<Vector<T>::set>(p_e); }
};

// One of the two points of a point pair PP: (PP* +- sqrt(PP*.PP*)) / (einf.PP*), brought to weight -einf.P = 1.
// Dividing by a vector is multiplying by it and dividing by its square, which normalising the weight cancels.
template <class T, BladeSet S>
SWIVEL_INLINE constexpr Vector<T> pair_point(const Mv<T, S>& pp, const T& side)
{
    const auto pp_dual = dual(pp);
    const T root = sqrt(scalar_product(pp_dual, pp_dual));
    const auto p = (pp_dual + (side * root) * unit<T, kScalar>()) * dot(unit<T, kEinf>(), pp_dual);
    return (T(1) / p.template at<kE0>()) * part<Vector<T>::set>(p);
}

// wrist: relative to the shoulder. normal: that of the swivel plane, of unit length. The elbow is on the side of normal
// x wrist. upper, fore: bone lengths, > 0.
template <class T>
SWIVEL_INLINE constexpr PipelineSteps<T> solve_pipeline(const Vector<T>& wrist, const Vector<T>& normal, const T& upper,
                                                        const T& fore)
{
    PipelineSteps<T> m;
    const auto e0 = unit<T, kE0>();
    const auto einf = unit<T, kEinf>();
    const Vector<T> e3 = vector(T(0), T(0), T(1));
    m.p_w = point(wrist);
    m.pi_swivel = normal;

    // Step 1, the elbow point: S1 = p_w - L2^2/2 einf, S2 = e0 - L1^2/2 einf, PP = S1 ^ S2 ^ pi_swivel, choose one
    // point.
    m.s1 = sphere(m.p_w, fore);
    m.s2 = e0 - (T(0.5) * upper * upper) * einf;
    m.pp = m.s1 ^ m.s2 ^ m.pi_swivel;
    const Vector<T> one = pair_point(m.pp, T(1)), other = pair_point(m.pp, T(-1));
    const Vector<T> pole_side = cross(normal, wrist);
    m.p_e = point(Vector<T>(select(scalar_product(one, pole_side) > T(0), one, other)));

    // Step 2, the elbow quaternion: c4 = cos of the angle between line_se and line_ew, q_e = sqrt((1+c4)/2) -
    // sqrt((1-c4)/2) i.
    m.line_se = e0 ^ m.p_e ^ einf;
    m.line_ew = m.p_e ^ m.p_w ^ einf;
    m.c4 = scalar_product(m.line_se, m.line_ew) /
           (sqrt(scalar_product(m.line_se, m.line_se)) * sqrt(scalar_product(m.line_ew, m.line_ew)));
    m.q_e = rotor(-sqrt((T(1) - m.c4) * T(0.5)), T(0), T(0), sqrt((T(1) + m.c4) * T(0.5)));

    // Step 3, the middle line between p_ze and p_e: pi_M = p_ze - p_e, pi_e* = e0 ^ p_ze ^ p_e ^ einf, l_M = pi_e ^
    // pi_M.
    m.p_ze = point(upper * e3);
    m.pi_m = part<Plane<T>::set>(m.p_ze - m.p_e);
    m.pi_e = part<Vector<T>::set>(dual(e0 ^ m.p_ze ^ m.p_e ^ einf));
    m.l_m = part<CentralLine<T>::set>(m.pi_e ^ m.pi_m);

    // Step 4, rotate to the elbow by pi about the middle line: q12 = l_M / |l_M|.
    m.q12 = normalise(m.l_m);

    // Step 5, rotate to the wrist about k: pi_yz2 = q12 pi_yz ~q12.
    // c3 is the cosine of the angle from it to pi_swivel, measured here before the turn by q12.
    // q3 = sqrt((1+c3)/2) + s sqrt((1-c3)/2) k. Here s is the sign of the angle.
    // Rounding may carry c3 past 1 or -1, where a root has no value.
    const Vector<T> n = grade_part<1>(~m.q12 * m.pi_swivel * m.q12);
    const T s3 = n.template at<kE2>();
    m.c3 = hi(lo(n.template at<kE1>(), T(1)), T(-1));
    const T s = select(s3 < T(0), T(-1), T(1));
    m.q3 = rotor(T(0), T(0), s * sqrt((T(1) - m.c3) * T(0.5)), sqrt((T(1) + m.c3) * T(0.5)));
    m.q_s = m.q12 * m.q3;
    return m;
}

}  // namespace swivel::inline SWIVEL_ISA
