// SPDX-License-Identifier: MIT
//
// One arm or many through the public interface, and where their results put elbow, wrist and hand, worked out by Eigen
// in double and independently of the library.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "swivel/swivel.hpp"

namespace swivel::test {

using Eigen::Quaterniond;
using Eigen::Vector3d;

using Float1 = std::array<float, 1>;
using Float2 = std::array<float, 2>;
using Float3 = std::array<float, 3>;
using Float4 = std::array<float, 4>;

inline Vector3d vec(const Float3& v) { return {v[0], v[1], v[2]}; }
inline Vector3d vec(const float (&v)[3]) { return {v[0], v[1], v[2]}; }
inline Quaterniond quat(const Float4& q) { return {q[3], q[0], q[1], q[2]}; }
inline Quaterniond quat(const float (&q)[4]) { return {q[3], q[0], q[1], q[2]}; }
inline Float3 floats(const Vector3d& v)
{
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}
inline Float4 floats(const Quaterniond& q)
{
    return {static_cast<float>(q.x()), static_cast<float>(q.y()), static_cast<float>(q.z()), static_cast<float>(q.w())};
}

// From one direction to another that is not its opposite. Eigen's own instantiates a singular value decomposition, in 8
// s.
inline Quaterniond turn_between(const Vector3d& from, const Vector3d& to)
{
    Quaterniond twice;
    twice.w() = from.norm() * to.norm() + from.dot(to);
    twice.vec() = from.cross(to);
    return twice.normalized();
}

// In radians.
inline double angle_between(const Vector3d& a, const Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }
inline double angle_of(const Quaterniond& q) { return 2 * std::atan2(q.vec().norm(), std::fabs(q.w())); }

// Distance of two rotations as quaternions; q and -q are one.
inline double distance(const Quaterniond& a, const Quaterniond& b)
{
    return std::min((a.coeffs() - b.coeffs()).norm(), (a.coeffs() + b.coeffs()).norm());
}

// w >= 0; at w = 0 the first of x, y, z that is not zero is positive.
inline bool is_in_hemisphere(const Float4& q)
{
    for (const float c : {q[3], q[0], q[1], q[2]})
        if (c != 0) return c > 0;
    return false;
}
inline bool is_unit(const Float4& q) { return std::abs(quat(q).norm() - 1) <= 1e-6; }

// The arrays of a test's skeleton, as the library takes them.
template <class Skeleton>
swivel_skeleton view_of(const Skeleton& s)
{
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.parents = {s.parents.data(), sizeof s.parents[0]};
    skeleton.rotations = {s.rotations.data(), sizeof s.rotations[0]};
    skeleton.translations = {s.translations.data(), sizeof s.translations[0]};
    skeleton.joint_count = static_cast<std::uint32_t>(s.parents.size());
    return skeleton;
}

inline Crowd crowd_of(swivel_features features, std::uint32_t limb_count, const swivel_binding& binding = {})
{
    Crowd crowd({swivel::group(limb_count, binding, features)});
    if (!(features & SWIVEL_JOINTS)) crowd.write_all(SWIVEL_LENGTHS, 0, Float2{1, 1});
    return crowd;
}

template <class Value>
std::vector<Value> read(const Crowd& crowd, swivel_field field, std::uint32_t group = 0)
{
    std::vector<Value> values(swivel_group_limb_count(crowd.get(), group));
    crowd.read(field, group, values);
    return values;
}

// Goal and pose of an arm in the arm frame, without any feature.
struct Arm {
    Float3 target, pole;
    Float2 lengths;

    double length() const { return double{lengths[0]} + lengths[1]; }
};
struct Pose {
    Float4 shoulder;
    Float2 elbow;
    std::uint32_t flags;

    Vector3d elbow_point(const Arm& arm) const { return quat(shoulder).normalized() * Vector3d(0, 0, arm.lengths[0]); }
    Vector3d wrist_point(const Arm& arm) const
    {
        const Quaterniond q_e = Quaterniond(elbow[0], -double{elbow[1]}, 0, 0).normalized();
        return elbow_point(arm) + quat(shoulder).normalized() * (q_e * Vector3d(0, 0, arm.lengths[1]));
    }
};

inline std::vector<Pose> solve(const std::vector<Arm>& arms)
{
    Crowd crowd = crowd_of(0, static_cast<std::uint32_t>(arms.size()));
    std::vector<Float3> targets, poles;
    std::vector<Float2> lengths;
    for (const Arm& arm : arms) {
        targets.push_back(arm.target);
        poles.push_back(arm.pole);
        lengths.push_back(arm.lengths);
    }
    crowd.write(SWIVEL_TARGET, 0, targets);
    crowd.write(SWIVEL_POLE, 0, poles);
    crowd.write(SWIVEL_LENGTHS, 0, lengths);
    crowd.solve();
    const auto shoulders = read<Float4>(crowd, SWIVEL_SHOULDER);
    const auto elbows = read<Float2>(crowd, SWIVEL_ELBOW);
    const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
    std::vector<Pose> poses;
    for (std::size_t n = 0; n < arms.size(); ++n) poses.push_back({shoulders[n], elbows[n], flags[n]});
    return poses;
}

}  // namespace swivel::test
