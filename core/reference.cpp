// SPDX-License-Identifier: MIT
//
// Inverse kinematics of a 7-DOF arm after D. Hildenbrand, "Inverse Kinematics of a Virtual Character" (TU Darmstadt,
// 2019), step by step; each comment is the lecture's line. o* is dual(o), and rotors turn o into Q o ~Q.
// Where the lecture leaves a sign open, a test decides it: the elbow is on the pole's side, the twist is sign(s3).

#include "core/reference.h"

#include "core/dense.h"

#include <cmath>

namespace swivel {

using namespace dense;  // the lecture's symbols: e1, e2, e3, e0, einf, i, j, k

namespace {

// The swivel plane through the shoulder, a point and the wrist. Its normal is p_w x point.
Multivector swivel_plane(const Multivector& p, const Multivector& p_w) { return dual(e0 ^ p ^ p_w ^ einf); }

// Step 1: calculate the elbow point p_e.
Multivector elbow_point(const Multivector& p_w, const Multivector& pi_swivel, double L1, double L2)
{
    // S1 = p_w - 1/2 L2^2 einf, the sphere around p_w
    const Multivector S1 = sphere(p_w, L2);
    // S2 = e0 - 1/2 L1^2 einf, the sphere around the shoulder e0
    const Multivector S2 = sphere(e0, L1);
    // PP = S1 ^ S2 ^ pi_swivel
    const Multivector PP = S1 ^ S2 ^ pi_swivel;
    // choose one point: on the pole's side, so that the plane through it has the swivel plane's normal
    const Multivector p = point_of_pair(PP, +1);
    return scalar(dot(swivel_plane(p, p_w), pi_swivel)) > 0 ? p : point_of_pair(PP, -1);
}

// Step 2, first half: the angle of the elbow.
double cosine_of_flexion(const Multivector& p_e, const Multivector& p_w)
{
    // line_se = (e0 ^ p_e ^ einf)*
    const Multivector line_se = dual(e0 ^ p_e ^ einf);
    // line_ew = (p_e ^ p_w ^ einf)*
    const Multivector line_ew = dual(p_e ^ p_w ^ einf);
    // c4 = (line_se* . line_ew*) / (|line_se*| |line_ew*|)
    return scalar(dot(dual(line_se), dual(line_ew))) / (norm(dual(line_se)) * norm(dual(line_ew)));
}

// Step 2, second half: calculate the elbow quaternion q_e.
Multivector elbow_quaternion(double c4)
{
    // q_e = sqrt((1 + c4) / 2) - sqrt((1 - c4) / 2) i
    return std::sqrt((1 + c4) / 2) - std::sqrt((1 - c4) / 2) * i;
}

// Step 3: compute the middle line between p_e and p_ze.
Multivector middle_line(const Multivector& p_e, double L1)
{
    // p_ze = L1 e3 + 1/2 L1^2 einf + e0
    const Multivector p_ze = point(L1 * e3);
    // pi_M = p_ze - p_e
    const Multivector pi_M = p_ze - p_e;
    // pi_e* = e0 ^ p_ze ^ p_e ^ einf
    const Multivector pi_e = dual(e0 ^ p_ze ^ p_e ^ einf);
    // l_M = pi_e ^ pi_M
    return pi_e ^ pi_M;
}

// Step 4: rotate to the elbow position, around the middle line with angle pi.
Multivector middle_quaternion(const Multivector& l_M)
{
    // q12 = cos(pi/2) + l_M / |l_M| sin(pi/2) = l_M / |l_M|
    return l_M / norm(l_M);
}

// Step 5: rotate to the wrist location.
Multivector twist_quaternion(const Multivector& q12, const Multivector& pi_swivel)
{
    // pi_yz = e1
    const Multivector pi_yz = e1;
    // pi_yz2 = q12 pi_yz ~q12
    const Multivector pi_yz2 = q12 * pi_yz * ~q12;
    // c3 = (pi_yz2 . pi_swivel) / (|pi_yz2| |pi_swivel|), on the planes themselves: their duals bring the sign of I^2
    const double c3 = scalar(dot(pi_yz2, pi_swivel)) / (norm(pi_yz2) * norm(pi_swivel));
    // the lecture's +-: theta3 turns e1 towards e2, so it has the sign of s3 = (q12 e2 ~q12) . pi_swivel
    const double s3 = scalar(dot(q12 * e2 * ~q12, pi_swivel));
    const double s = s3 < 0 ? -1 : 1;
    // q3 = sqrt((1 + c3) / 2) + s sqrt((1 - c3) / 2) k
    return std::sqrt((1 + c3) / 2) + s * std::sqrt((1 - c3) / 2) * k;
}

// w + x i + y j + z k to x, y, z, w: i i = -1, while the other units times i have no scalar part.
void write_quaternion(const Multivector& Q, double out[4])
{
    out[0] = -scalar(Q * i);
    out[1] = -scalar(Q * j);
    out[2] = -scalar(Q * k);
    out[3] = scalar(Q);
}

void write_vector(const Multivector& v, double out[3])
{
    out[0] = scalar(dot(v, e1));
    out[1] = scalar(dot(v, e2));
    out[2] = scalar(dot(v, e3));
}

}  // namespace

ReferencePose solve_reference(const ReferenceArm& arm)
{
    const Multivector p_w = point(vector(arm.wrist[0], arm.wrist[1], arm.wrist[2]));
    const Multivector p_pole = point(vector(arm.pole[0], arm.pole[1], arm.pole[2]));
    const Multivector pi = swivel_plane(p_pole, p_w), pi_swivel = pi / norm(pi);
    const Multivector p_e = elbow_point(p_w, pi_swivel, arm.upper, arm.fore);
    const double c4 = cosine_of_flexion(p_e, p_w);
    const Multivector q_e = elbow_quaternion(c4);
    const Multivector l_M = middle_line(p_e, arm.upper);
    const Multivector q12 = middle_quaternion(l_M);
    const Multivector q3 = twist_quaternion(q12, pi_swivel);
    // q_s = q12 q3
    const Multivector q_s = q12 * q3;

    ReferencePose pose;
    write_vector(p_e, pose.elbow);
    pose.cos_flexion = c4;
    write_quaternion(q_e, pose.elbow_rotor);
    write_quaternion(q12, pose.middle_rotor);
    write_quaternion(q3, pose.twist_rotor);
    write_quaternion(q_s, pose.shoulder_rotor);
    return pose;
}

}  // namespace swivel
