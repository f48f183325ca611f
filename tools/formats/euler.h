#pragma once
// SPDX-License-Identifier: MIT
// Rotations as three angles about three different axes, in any of the six orders, as animation files store them:
// R = R(axes[0], a0) R(axes[1], a1) R(axes[2], a2), so the last angle turns first. Angles are degrees, as in files.
// Knows no file.

#include <Eigen/Geometry>
#include <array>

namespace swivel::formats {

using EulerAxes = std::array<int, 3>;  // a permutation of 0 1 2, which stand for x y z

// The rotation by `angle_deg` about one axis (0 x, 1 y, 2 z).
Eigen::Quaterniond axis_rotation(int axis, double angle_deg);

// The angles of `rotation`, in degrees, that lie nearest to `near_deg`. There are two families, (a0, a1, a2) and (a0 +
// 180, 180 - a1, a2 + 180), with any number of full turns added to each angle. The nearest has the smallest sum of
// squared differences. At gimbal lock only a sum or difference of a0 and a2 is known; a0 then stays at `near_deg[0]`.
// rotation: unit. Values of near_deg beyond 1e6 degrees count as 0: a double so large no longer resolves the angle.
// The angles give the rotation back to 1e-10 rad.
Eigen::Vector3d nearest_euler(const Eigen::Quaterniond& rotation, const EulerAxes& axes,
                              const Eigen::Vector3d& near_deg);

}  // namespace swivel::formats
