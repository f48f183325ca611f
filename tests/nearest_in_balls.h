// SPDX-License-Identifier: MIT
//
// The point of two balls nearest to the origin, by search in double. It knows nothing of the circle in which their
// spheres meet.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

namespace swivel::test {

struct Ball {
    Eigen::Vector3d middle;
    double radius;

    double beyond(const Eigen::Vector3d& point) const { return (point - middle).norm() - radius; }
};

// By how much two balls are apart; 0 or less where they share points.
inline double gap_of(const Ball& a, const Ball& b) { return (b.middle - a.middle).norm() - a.radius - b.radius; }

// None where they share no point. Along the line of both middles the squared distance of a slice is convex, so thirds
// of the line find its least.
inline std::optional<Eigen::Vector3d> nearest_in_balls(const Ball& a, const Ball& b)
{
    const Eigen::Vector3d way = b.middle - a.middle;
    if (gap_of(a, b) > 0) return {};
    const Eigen::Vector3d line = way.norm() > 0 ? way.normalized() : Eigen::Vector3d(1, 0, 0);
    const double at_a = line.dot(a.middle), at_b = line.dot(b.middle);
    const Eigen::Vector3d off = a.middle - at_a * line;  // of the line of both middles from the origin
    const double height = off.norm();
    const auto room = [](const Ball& ball, double from) {
        return std::sqrt(std::max(0.0, ball.radius * ball.radius - from * from));
    };
    // How far from the origin's line a slice's nearest point is.
    const auto across = [&](double x) {
        return std::max(0.0, height - std::min(room(a, x - at_a), room(b, x - at_b)));
    };
    const auto distance = [&](double x) { return std::hypot(x, across(x)); };
    double low = std::max(at_a - a.radius, at_b - b.radius), high = std::min(at_a + a.radius, at_b + b.radius);
    for (int n = 0; n < 200; ++n) {
        const double first = low + (high - low) / 3, second = high - (high - low) / 3;
        (distance(first) <= distance(second) ? high : low) = distance(first) <= distance(second) ? second : first;
    }
    const double x = 0.5 * (low + high);
    return Eigen::Vector3d(x * line + (height > 0 ? Eigen::Vector3d(across(x) / height * off) : off));
}

}  // namespace swivel::test
