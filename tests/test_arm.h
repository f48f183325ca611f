// SPDX-License-Identifier: MIT
//
// Values as arrays of floats and in Eigen's terms. Arms in their own frame, solved through the public interface, and
// where their elbows, wrists and hands then are, by Eigen in double and independently of the library.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "swivel/swivel.hpp"
#include "tests/test_random.h"

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
inline Quaterniond turn_between(const Vector3d& from, const Vector3d& goal)
{
    Quaterniond twice;
    twice.w() = from.norm() * goal.norm() + from.dot(goal);
    twice.vec() = from.cross(goal);
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

inline Crowd crowd_of(swivel_features features, std::uint32_t limb_count, const swivel_binding& binding = {},
                      std::uint32_t twist_bone_count = 0)
{
    swivel_limb_def def = limbs(limb_count, features);
    def.twist_bone_count = twist_bone_count;
    def.binding = binding;
    Crowd crowd(def);
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

// Writes a limb's value of a field, if its group has that.
template <class Value>
void put(Crowd& crowd, swivel_field field, std::uint32_t limb, const Value& value, std::uint32_t group = 0)
{
    if (swivel_field_row_count(crowd.get(), group, field)) crowd.write(field, group, std::span(&value, 1), limb);
}

// An arm in its own frame, and where its wrist and its elbow are wanted.
struct Arm {
    Vector3d wrist = Vector3d::Zero(), pole = Vector3d::Zero();
    double upper = 0, fore = 0;

    double length() const { return upper + fore; }
    Vector3d normal() const { return wrist.cross(pole).normalized(); }
    // By the law of cosines: along the line by the elbow's foot, and away from it towards the pole.
    Vector3d elbow() const
    {
        const double d = wrist.norm();
        const double along = (d * d + upper * upper - fore * fore) / (2 * d);
        const double away = std::sqrt(std::max(0.0, upper * upper - along * along));
        return along / d * wrist + away * normal().cross(wrist).normalized();
    }
};

// To floats, so that both precisions see the same.
inline double rounded(double x) { return static_cast<float>(x); }
inline Vector3d rounded(const Vector3d& v) { return v.cast<float>().cast<double>(); }
inline Arm rounded(const Arm& arm)
{
    return {rounded(arm.wrist), rounded(arm.pole), rounded(arm.upper), rounded(arm.fore)};
}

// The turns of the joints, of unit length, bones as stretched, and what follows from them.
struct LimbPose {
    Quaterniond shoulder, elbow, wrist = Quaterniond::Identity();
    double upper, fore, stretch = 1;
    std::uint32_t flags;
    Float4 shoulder_result;  // as the library gives them
    Float2 elbow_result;

    Vector3d elbow_place() const { return shoulder * Vector3d(0, 0, upper); }
    Vector3d wrist_place() const { return elbow_place() + shoulder * (elbow * Vector3d(0, 0, fore)); }
    Vector3d hinge() const { return shoulder * Vector3d::UnitX(); }  // the swivel plane's normal
    Quaterniond hand() const { return shoulder * elbow * wrist; }
};
// From what a crowd gives for one limb of its first group, which has no skeleton.
inline LimbPose pose_of(const Crowd& crowd, std::uint32_t n = 0)
{
    const auto get = [&](swivel_field field, auto value) {
        if (swivel_field_row_count(crowd.get(), 0, field)) crowd.read(field, 0, std::span(&value, 1), n);
        return value;
    };
    const auto unit = [](const Float4& q) { return quat(q).normalized(); };
    const Float2 bones = get(SWIVEL_LENGTHS, Float2{});
    LimbPose pose;
    pose.shoulder_result = get(SWIVEL_SHOULDER, Float4{}), pose.elbow_result = get(SWIVEL_ELBOW, Float2{});
    pose.shoulder = unit(pose.shoulder_result);
    pose.elbow = unit({-pose.elbow_result[1], 0, 0, pose.elbow_result[0]});
    pose.wrist = unit(get(SWIVEL_WRIST, Float4{0, 0, 0, 1}));
    pose.stretch = get(SWIVEL_STRETCH, std::array{1.0f})[0];
    pose.upper = pose.stretch * bones[0], pose.fore = pose.stretch * bones[1];
    pose.flags = get(SWIVEL_FLAGS, std::array<std::uint32_t, 1>{})[0];
    return pose;
}

inline void write_arm(Crowd& crowd, std::uint32_t n, const Arm& arm)
{
    put(crowd, SWIVEL_TARGET, n, floats(arm.wrist)), put(crowd, SWIVEL_POLE, n, floats(arm.pole));
    put(crowd, SWIVEL_LENGTHS, n, Float2{static_cast<float>(arm.upper), static_cast<float>(arm.fore)});
}
// The poses of arms that nothing more is asked of, whatever features they have.
inline std::vector<LimbPose> solve_all(const std::vector<Arm>& arms, swivel_features features = 0)
{
    Crowd crowd(limbs(static_cast<std::uint32_t>(arms.size()), features));
    for (std::uint32_t n = 0; n < arms.size(); ++n) write_arm(crowd, n, arms[n]);
    crowd.solve();
    std::vector<LimbPose> poses;
    for (std::uint32_t n = 0; n < arms.size(); ++n) poses.push_back(pose_of(crowd, n));
    return poses;
}

// One limb. What is not written is as a crowd begins: it changes nothing.
struct FreeLimb {
    Crowd crowd;

    FreeLimb(const Arm& arm, swivel_features features) : crowd(limbs(1, features)) { write_arm(crowd, 0, arm); }
    template <class Value>
    void write(swivel_field field, const Value& value)
    {
        crowd.write_all(field, 0, value);
    }
    LimbPose solve()
    {
        crowd.solve({.on_this_thread = true});
        return pose_of(crowd);
    }
};

inline Arm random_reachable(Random& random)
{
    const double upper = random.between(0.2, 0.5), fore = upper * random.between(0.6, 1.6);
    const double near = std::fabs(upper - fore), far = upper + fore;
    const Vector3d line = random.direction();
    return rounded(Arm{(near + random.between(0.05, 0.95) * (far - near)) * line,
                       random.between(-1, 1) * line + random.spread(0.1, 1) * random.across(line), upper, fore});
}

}  // namespace swivel::test
