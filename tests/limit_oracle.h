// SPDX-License-Identifier: MIT
//
// Judges joint limits by angles, in double, with Eigen and the C library's arc functions. It says how far a rotation is
// outside of a cone, a twist range or a box of Euler angles. It shares nothing with core/limits.h.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace swivel::test {

inline constexpr double kPi = std::numbers::pi;

// An angle range: middle and half width, radians.
struct AngleRange {
    double middle = 0, half = kPi;

    // How far an angle is outside; negative inside.
    double outside(double angle) const { return std::fabs(std::remainder(angle - middle, 2 * kPi)) - half; }
};

// All violations are in units of a cosine, positive where the limit is broken.
inline double cone_violation(const Eigen::Vector3d& axis, double cos_opening, const Eigen::Vector3d& direction)
{
    return cos_opening - axis.dot(direction);
}

inline double twist_violation(const Eigen::Vector3d& axis, const AngleRange& range, const Eigen::Quaterniond& q)
{
    const double along = q.vec().dot(axis), angle = 2 * std::atan2(along, q.w());
    const double off = std::remainder(angle - range.middle, 2 * kPi);
    return (q.w() * q.w() + along * along) * (std::cos(range.half) - std::cos(off));
}

struct AngleBox {
    int axes[3] = {0, 1, 2};
    AngleRange range[3];
};

// By the box's own angles, both triples that give the rotation: the better one counts.
inline double box_violation(const AngleBox& box, const Eigen::Matrix3d& r)
{
    const int p = box.axes[0], q = box.axes[1], s = box.axes[2];
    const double sign = (q - p + 3) % 3 == 1 ? 1 : -1;
    const double length = std::hypot(r(s, s), r(q, s));
    const double first = std::atan2(-sign * r(q, s), r(s, s)), last = std::atan2(-sign * r(p, q), r(p, p)),
                 middle = std::atan2(sign * r(p, s), length);
    const auto sine_of = [](double outside) { return outside <= kPi / 2 ? std::sin(outside) : 1; };
    const auto violation = [&](double a, double b, double c) {
        // The sine's way out of the middle range, as long as it leads to one of its ends on the same side of the pole.
        double middle_out = -1;
        if (box.range[1].outside(b) > 0) {
            middle_out = 2;
            for (const double end : {box.range[1].middle - box.range[1].half, box.range[1].middle + box.range[1].half})
                if (std::cos(end) * std::cos(b) >= 0)
                    middle_out = std::min(middle_out, std::fabs(std::sin(end) - std::sin(b)));
        }
        return std::max(
            {middle_out, length * sine_of(box.range[0].outside(a)), length * sine_of(box.range[2].outside(c))});
    };
    return std::min(violation(first, middle, last), violation(first + kPi, kPi - middle, last + kPi));
}

}  // namespace swivel::test
