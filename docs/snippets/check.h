// SPDX-License-Identifier: MIT
//
// What the pages' programs are checked with.
#pragma once

#include <swivel/swivel.hpp>

#include <Eigen/Geometry>
#include <algorithm>
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

// A limb of three joints that are not turned at rest. Elbow and wrist lie in the frame
// of the joint above, and the bend is in the shoulder's.
inline swivel_binding bound(const Float3& elbow, const Float3& wrist,
                            const Float3& bend)
{
    const std::int32_t parents[] = {-1, 0, 1};
    const Float3 translations[] = {{0, 0, 0}, elbow, wrist};
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.joint_count = 3;
    skeleton.parents = swivel::stream(parents);
    skeleton.translations = swivel::stream(translations);
    swivel_limb_joints joints = swivel_default_limb_joints(0, 1, 2);
    std::copy(bend.begin(), bend.end(), joints.bend);
    return swivel::bind(skeleton, joints);
}

// In radians.
template <class A, class B>
double turn_between(const A& a, const B& b)
{
    return quat(a).angularDistance(quat(b));
}
