// SPDX-License-Identifier: MIT
#include "tools/formats/euler.h"

#include <cmath>
#include <numbers>

namespace swivel::formats {
namespace {

constexpr double kRadians = std::numbers::pi / 180;
constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kMaxNear_deg = 1e6;  // neighbouring doubles there are 1e-10 degrees apart
constexpr double kLock = 1e-10;       // cos a1 below this: a0 is noise, and any a0 fits to 1e-10 rad

// +1 for the axes in cyclic order (xyz yzx zxy), -1 for the others: the sign of every sine below.
double handedness(const EulerAxes& axes) { return (axes[0] + 1) % 3 == axes[1] ? 1.0 : -1.0; }

// a0, from the last column of R = (s sin a1, -s sin a0 cos a1, cos a0 cos a1) in the rows axes[0..2].
double first_angle(const Eigen::Matrix3d& matrix, const EulerAxes& axes, double locked_a0)
{
    const double cos_part = matrix(axes[2], axes[2]);
    const double sin_part = -handedness(axes) * matrix(axes[1], axes[2]);
    return std::hypot(cos_part, sin_part) < kLock ? locked_a0 : std::atan2(sin_part, cos_part);
}

// a1 and a2 that fit the given a0, from M = R(axes[0], -a0) R = R(axes[1], a1) R(axes[2], a2). Both come from entries
// that are well conditioned everywhere, so an error of a0 at the lock is made good by a2.
Eigen::Vector3d complete_angles(const Eigen::Quaterniond& rotation, const EulerAxes& axes, double a0)
{
    const double s = handedness(axes);
    const Eigen::Matrix3d m = (axis_rotation(axes[0], -a0 * kDegrees) * rotation).toRotationMatrix();
    const double a1 = std::atan2(s * m(axes[0], axes[2]), m(axes[2], axes[2]));
    const double a2 = std::atan2(s * m(axes[1], axes[0]), m(axes[1], axes[1]));
    return {a0, a1, a2};
}

// Every angle by full turns to within 180 degrees of its neighbour.
Eigen::Vector3d unwound(const Eigen::Vector3d& angle_deg, const Eigen::Vector3d& near_deg)
{
    const Eigen::Vector3d turns = ((near_deg - angle_deg) / 360).array().round();
    return angle_deg + 360 * turns;
}

}  // namespace

Eigen::Quaterniond axis_rotation(int axis, double angle_deg)
{
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle_deg * kRadians, Eigen::Vector3d::Unit(axis)));
}

Eigen::Vector3d nearest_euler(const Eigen::Quaterniond& rotation, const EulerAxes& axes,
                              const Eigen::Vector3d& near_deg)
{
    const Eigen::Vector3d goal_deg = (near_deg.array().abs() > kMaxNear_deg).select(0.0, near_deg);
    const Eigen::Matrix3d matrix = rotation.toRotationMatrix();
    const double a0 = first_angle(matrix, axes, goal_deg[0] * kRadians);
    const Eigen::Vector3d angle_deg = kDegrees * complete_angles(rotation, axes, a0);
    const Eigen::Vector3d other_deg(angle_deg[0] + 180, 180 - angle_deg[1], angle_deg[2] + 180);
    const Eigen::Vector3d one_deg = unwound(angle_deg, goal_deg);
    const Eigen::Vector3d two_deg = unwound(other_deg, goal_deg);
    return (one_deg - goal_deg).squaredNorm() <= (two_deg - goal_deg).squaredNorm() ? one_deg : two_deg;
}

}  // namespace swivel::formats
