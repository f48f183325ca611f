// SPDX-License-Identifier: MIT
//
// Vectors and rotations in double, of + - * / and square roots alone: the same numbers on every machine.
#pragma once

#include <array>
#include <cmath>

#include "tools/corpus/random.h"

namespace swivel::corpus {

struct Vector {
    double x, y, z;
};
struct Rotation {
    Vector v;
    double w;
};

inline double square_root(double x) { return std::sqrt(x); }

inline Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector operator*(double s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector cross(const Vector& a, const Vector& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vector& a) { return square_root(dot(a, a)); }
inline Vector unit(const Vector& a) { return (1 / length(a)) * a; }
inline Vector between(const Vector& from, const Vector& to, double share) { return from + share * (to - from); }

inline Rotation unit(const Rotation& q)
{
    const double scale = 1 / square_root(dot(q.v, q.v) + q.w * q.w);
    return {scale * q.v, scale * q.w};
}
inline Rotation operator*(const Rotation& a, const Rotation& b)
{
    return {a.w * b.v + b.w * a.v + cross(a.v, b.v), a.w * b.w - dot(a.v, b.v)};
}
inline Rotation reverse(const Rotation& q) { return {-1 * q.v, q.w}; }
// The least turn from one direction to another, which is not its opposite.
inline Rotation turn_between(const Vector& from, const Vector& to)
{
    return unit(Rotation{cross(from, to), length(from) * length(to) + dot(from, to)});
}
// q: of unit length.
inline Vector turn(const Rotation& q, const Vector& a)
{
    const Vector t = 2 * cross(q.v, a);
    return a + q.w * t + cross(q.v, t);
}

inline Vector random_direction(Random& random)
{
    for (;;) {
        const Vector v{random.signed_unit(), random.signed_unit(), random.signed_unit()};
        const double length2 = dot(v, v);
        if (length2 > 0.01 && length2 < 1) return unit(v);
    }
}
// Each number from -size to size.
inline Vector random_vector(Random& random, double size)
{
    const double x = random.signed_unit(), y = random.signed_unit(), z = random.signed_unit();
    return size * Vector{x, y, z};
}
// A vector of unit length, orthogonal to a unit axis.
inline Vector random_across(Random& random, const Vector& axis)
{
    for (;;) {
        const Vector v = cross(axis, random_direction(random));
        if (dot(v, v) > 0.01) return unit(v);
    }
}
inline Rotation random_unit_rotation(Random& random)
{
    for (;;) {
        const Rotation q{{random.signed_unit(), random.signed_unit(), random.signed_unit()}, random.signed_unit()};
        const double length2 = dot(q.v, q.v) + q.w * q.w;
        if (length2 > 0.01 && length2 < 1) return unit(q);
    }
}

// A rotation of any length between these.
inline Rotation random_rotation(Random& random, double shortest, double longest)
{
    const Rotation q = random_unit_rotation(random);
    const double size = random.between(shortest, longest);
    return {size * q.v, size * q.w};
}

inline std::array<float, 3> floats(const Vector& v)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
inline std::array<float, 4> floats(const Rotation& q)
{
    return {static_cast<float>(q.v.x), static_cast<float>(q.v.y), static_cast<float>(q.v.z), static_cast<float>(q.w)};
}
inline void put_vector(const Vector& v, float* at)
{
    at[0] = static_cast<float>(v.x), at[1] = static_cast<float>(v.y), at[2] = static_cast<float>(v.z);
}
inline void put_vector(const Vector& v, double* at) { at[0] = v.x, at[1] = v.y, at[2] = v.z; }
inline Vector vector_of(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }
inline Rotation rotation_of(const std::array<float, 4>& q) { return {{q[0], q[1], q[2]}, q[3]}; }

}  // namespace swivel::corpus
