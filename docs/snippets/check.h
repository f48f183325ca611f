// SPDX-License-Identifier: MIT
//
// What the pages' programs are checked with.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <swivel/swivel_bodies.hpp>
#include <swivel/swivel_explain.hpp>
#include <swivel/swivel_regions.hpp>
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

// The start of a character. The animation does not turn its joints.
template <std::size_t joints>
struct Posed {
    Float3 place = {};
    Float4 rotation = {0, 0, 0, 1};
    std::array<Float4, joints> pose, solved;
    Posed()
    {
        pose.fill({0, 0, 0, 1});
        solved = pose;
    }
};

// A skeleton whose joints are not turned at rest.
template <std::size_t joints>
struct Bones {
    std::array<std::int32_t, joints> parents;
    std::array<Float3, joints> offsets;

    swivel_skeleton skeleton() const
    {
        swivel_skeleton made = swivel_default_skeleton();
        made.parents = swivel::stream(parents);
        made.translations = swivel::stream(offsets);
        made.joint_count = joints;
        return made;
    }
    swivel_limb_joints limb(std::uint32_t first, float bend) const
    {
        swivel_limb_joints made =
            swivel_default_limb_joints(first, first + 1, first + 2);
        made.bend[2] = bend;
        return made;
    }
    // A joint of a solved character in the world: forward kinematics of our own.
    Eigen::Isometry3d frame(const Posed<joints>& character, std::size_t joint) const
    {
        Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
        for (std::int32_t up = static_cast<std::int32_t>(joint); up >= 0;) {
            const auto n = static_cast<std::size_t>(up);
            frame = Eigen::Translation3d(vec(offsets[n])) * quat(character.solved[n]) *
                    frame;
            up = parents[n];
        }
        return Eigen::Translation3d(vec(character.place)) * quat(character.rotation) *
               frame;
    }
};

template <class Character>
swivel_pose pose_of(std::vector<Character>& characters)
{
    swivel_pose pose = swivel_default_pose();
    pose.rotations = {characters[0].pose.data(), sizeof(Character), sizeof(Float4),
                      nullptr};
    pose.results = {characters[0].solved.data(), sizeof(Character), sizeof(Float4),
                    nullptr};
    pose.root_position = swivel::stream(characters, &Character::place);
    pose.root_rotation = swivel::stream(characters, &Character::rotation);
    return pose;
}
