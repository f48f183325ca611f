// SPDX-License-Identifier: MIT
//
// What the pages' programs are checked with.
#pragma once

#include <swivel/swivel.hpp>

#include <Eigen/Geometry>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

using Float2 = std::array<float, 2>;
using Float3 = std::array<float, 3>;
using Float4 = std::array<float, 4>;
using Double3 = std::array<double, 3>;
using Double4 = std::array<double, 4>;

template <class Values>
Eigen::Vector3d vec(const Values& v)
{
    return {static_cast<double>(v[0]), static_cast<double>(v[1]),
            static_cast<double>(v[2])};
}

template <class Values>
Eigen::Quaterniond quat(const Values& q)
{
    return Eigen::Quaterniond(static_cast<double>(q[3]), static_cast<double>(q[0]),
                              static_cast<double>(q[1]), static_cast<double>(q[2]))
        .normalized();
}

template <class A, class B>
double distance(const A& a, const B& b)
{
    return (vec(a) - vec(b)).norm();
}

// In radians.
template <class A, class B>
double turn_between(const A& a, const B& b)
{
    return quat(a).angularDistance(quat(b));
}
