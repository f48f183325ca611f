// SPDX-License-Identifier: MIT
//
// Are a solver's results right? Forward kinematics in double, sharing nothing with any solver.
#pragma once

#include <cmath>
#include <span>

#include "bench/rivals/limbs.h"

namespace bench {

struct Vec {
    double x, y, z;
};
inline Vec vec(const float* v) { return {v[0], v[1], v[2]}; }
inline Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator*(double s, Vec v) { return {s * v.x, s * v.y, s * v.z}; }
inline double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double norm(Vec v) { return std::sqrt(dot(v, v)); }

// v turned by the quaternion x, y, z, w, of unit length.
template <class Number>
Vec turn(const Number (&q)[4], Vec v)
{
    const double tx = 2 * (q[1] * v.z - q[2] * v.y), ty = 2 * (q[2] * v.x - q[0] * v.z),
                 tz = 2 * (q[0] * v.y - q[1] * v.x);
    return v +
           Vec{q[3] * tx + q[1] * tz - q[2] * ty, q[3] * ty + q[2] * tx - q[0] * tz, q[3] * tz + q[0] * ty - q[1] * tx};
}

// The worst wrist error of the ordinary arms, in arm lengths; infinite for a NaN or an elbow off its pole's side.
double worst_error(std::span<const Limb> limbs, const Poses& poses);

// What results must keep to be timed: the loops' fast arithmetic is off by up to 3e-4.
inline constexpr double kRightWithin = 1e-3;

}  // namespace bench
