// SPDX-License-Identifier: MIT
//
// Limbs in their own frame, solved through the public interface, and where they then are, by Eigen in double.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "swivel/swivel.hpp"
#include "tests/formula_arm.h"

namespace swivel::test {

using Float3 = std::array<float, 3>;
using Float4 = std::array<float, 4>;

inline Float3 floats(const Vector3d& v)
{
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}
inline Float4 floats(const Quaterniond& q)
{
    return {static_cast<float>(q.x()), static_cast<float>(q.y()), static_cast<float>(q.z()), static_cast<float>(q.w())};
}

// The turns of the joints, of unit length, bones as stretched, and what follows from them.
struct LimbPose {
    Quaterniond shoulder, elbow, wrist = Quaterniond::Identity();
    double upper, fore, stretch = 1;
    std::uint32_t flags;

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
    const auto unit = [](const Float4& q) { return Quaterniond(q[3], q[0], q[1], q[2]).normalized(); };
    const auto half = get(SWIVEL_ELBOW, std::array<float, 2>{}), bones = get(SWIVEL_LENGTHS, std::array<float, 2>{});
    LimbPose pose;
    pose.shoulder = unit(get(SWIVEL_SHOULDER, Float4{}));
    pose.elbow = unit({-half[1], 0, 0, half[0]});
    pose.wrist = unit(get(SWIVEL_WRIST, Float4{0, 0, 0, 1}));
    pose.stretch = get(SWIVEL_STRETCH, std::array{1.0f})[0];
    pose.upper = pose.stretch * bones[0], pose.fore = pose.stretch * bones[1];
    pose.flags = get(SWIVEL_FLAGS, std::array<std::uint32_t, 1>{})[0];
    return pose;
}

inline void write_arm(Crowd& crowd, std::uint32_t n, const Arm& arm)
{
    const auto put = [&](swivel_field field, const auto& value) {
        if (swivel_field_row_count(crowd.get(), 0, field)) crowd.write(field, 0, std::span(&value, 1), n);
    };
    put(SWIVEL_TARGET, floats(arm.wrist)), put(SWIVEL_POLE, floats(arm.pole));
    put(SWIVEL_LENGTHS, std::array{static_cast<float>(arm.upper), static_cast<float>(arm.fore)});
}
// The poses of arms that nothing more is asked of, whatever features they have.
inline std::vector<LimbPose> solve_all(const std::vector<Arm>& arms, swivel_features features = 0)
{
    Crowd crowd(group(static_cast<std::uint32_t>(arms.size()), features));
    for (std::uint32_t n = 0; n < arms.size(); ++n) write_arm(crowd, n, arms[n]);
    crowd.solve();
    std::vector<LimbPose> poses;
    for (std::uint32_t n = 0; n < arms.size(); ++n) poses.push_back(pose_of(crowd, n));
    return poses;
}

// One limb. What is not written is as a crowd begins: it changes nothing.
struct FreeLimb {
    Crowd crowd;

    FreeLimb(const Arm& arm, swivel_features features) : crowd(group(1, features)) { write_arm(crowd, 0, arm); }
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
