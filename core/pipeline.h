// SPDX-License-Identifier: MIT
//
// The five steps of the lecture, line by line, over any number type: the rotors of a 7-DOF arm from its wrist, its
// swivel plane and its lengths. Source: D. Hildenbrand, Inverse Kinematics of a Virtual Character (TU Darmstadt, 2019).
//
// Read this algorithm first; solve_arm.h solves the same arm and is exact where these formulas lose digits. This is
// valid for a wrist within reach, an arm that is neither straight nor folded, and an upper arm that is not along -e3.
// Elsewhere it divides by zero.
#pragma once

#include "core/conformal.h"

namespace swivel::inline SWIVEL_ISA {

template <class T>
struct PipelinePose {
    Vector<T> elbow;
    T cos_flexion;
    Rotor<T> elbow_rotor;
    CentralLine<T> middle_rotor;
    Rotor<T> twist_rotor, shoulder_rotor;
};

// One of the two points of a point pair PP: (PP* +- sqrt(PP*.PP*)) / (einf.PP*), brought to weight -einf.P = 1.
// Dividing by a vector is multiplying by it and dividing by its square, which the weight takes in.
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
SWIVEL_INLINE constexpr PipelinePose<T> solve_pipeline(const Vector<T>& wrist, const Vector<T>& normal, const T& upper,
                                                       const T& fore)
{
    const auto e0 = unit<T, kE0>();
    const auto einf = unit<T, kEinf>();
    const Vector<T> e3 = vector(T(0), T(0), T(1));
    const Point<T> p_w = point(wrist);
    const Vector<T> pi_swivel = normal;

    // Step 1, the elbow point: S1 = p_w - L2^2/2 einf, S2 = e0 - L1^2/2 einf, PP = S1 ^ S2 ^ pi_swivel, choose one
    // point.
    const auto s1 = sphere(p_w, fore);
    const auto s2 = e0 - (T(0.5) * upper * upper) * einf;
    const auto pp = s1 ^ s2 ^ pi_swivel;
    const Vector<T> one = pair_point(pp, T(1)), other = pair_point(pp, T(-1));
    const Vector<T> pole_side = cross(normal, wrist);
    const Vector<T> elbow = select(scalar_product(one, pole_side) > T(0), one, other);
    const Point<T> p_e = point(elbow);

    // Step 2, the elbow quaternion: c4 = cos of the angle between line_se and line_ew, q_e = sqrt((1+c4)/2) -
    // sqrt((1-c4)/2) i.
    const auto line_se = e0 ^ p_e ^ einf;
    const auto line_ew = p_e ^ p_w ^ einf;
    const T c4 = scalar_product(line_se, line_ew) /
                 (sqrt(scalar_product(line_se, line_se)) * sqrt(scalar_product(line_ew, line_ew)));
    const Rotor<T> q_e = rotor(-sqrt((T(1) - c4) * T(0.5)), T(0), T(0), sqrt((T(1) + c4) * T(0.5)));

    // Step 3, the middle line between p_ze and p_e: pi_M = p_ze - p_e, pi_e* = e0 ^ p_ze ^ p_e ^ einf, l_M = pi_e ^
    // pi_M.
    const Point<T> p_ze = point(upper * e3);
    const Plane<T> pi_m = part<Plane<T>::set>(p_ze - p_e);
    const auto pi_e = part<Vector<T>::set>(dual(e0 ^ p_ze ^ p_e ^ einf));
    const CentralLine<T> l_m = part<CentralLine<T>::set>(pi_e ^ pi_m);

    // Step 4, rotate to the elbow by pi about the middle line: q12 = l_M / |l_M|.
    const CentralLine<T> q12 = normalise(l_m);

    // Step 5, rotate to the wrist about k: pi_yz2 = q12 pi_yz ~q12. c3 is the cosine of the angle from it to pi_swivel,
    // measured here before the turn by q12. q3 = sqrt((1+c3)/2) + s sqrt((1-c3)/2) k, where s is the sign of the angle.
    const Vector<T> n = grade_part<1>(~q12 * pi_swivel * q12);
    const T c3 = n.template at<kE1>(), s3 = n.template at<kE2>();
    const T s = select(s3 < T(0), T(-1), T(1));
    const Rotor<T> q3 = rotor(T(0), T(0), s * sqrt((T(1) - c3) * T(0.5)), sqrt((T(1) + c3) * T(0.5)));

    return {elbow, c4, q_e, q12, q3, q12 * q3};
}

}  // namespace swivel::inline SWIVEL_ISA
