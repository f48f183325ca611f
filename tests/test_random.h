// SPDX-License-Identifier: MIT
//
// The same random numbers in every run of a test, so that a failure comes back. Compilers call the arguments of a
// function in orders of their own. So what compares sizes or counts with a limit draws in statements of their own, or
// in braces.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>

namespace swivel::test {

// SplitMix64 (Steele, Lea, Flood, 2014).
struct Random {
    std::uint64_t state;

    std::uint64_t bits()
    {
        std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    std::uint32_t word() { return static_cast<std::uint32_t>(bits() >> 32); }
    std::uint32_t below(std::uint32_t n) { return word() % n; }
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }  // in [0, 1)
    double between(double a, double b) { return a + (b - a) * unit(); }
    double spread(double a, double b) { return a * std::pow(b / a, unit()); }  // even in its logarithm
    Eigen::Vector3d direction()
    {
        for (;;) {
            const double x = between(-1, 1), y = between(-1, 1), z = between(-1, 1);
            const Eigen::Vector3d v(x, y, z);
            if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
        }
    }
    Eigen::Vector3d vector(double min, double max)  // with a length between the two
    {
        const double length = between(min, max);
        return length * direction();
    }
    Eigen::Vector3d across(const Eigen::Vector3d& axis)  // unit, orthogonal to axis
    {
        for (;;) {
            const Eigen::Vector3d v = axis.cross(direction());
            if (v.norm() > 0.1 * axis.norm()) return v.normalized();
        }
    }
    Eigen::Quaterniond rotation()
    {
        const double angle = between(-3.14, 3.14);
        return Eigen::Quaterniond(Eigen::AngleAxisd(angle, direction()));
    }
};

}  // namespace swivel::test
