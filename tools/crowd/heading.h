// SPDX-License-Identifier: MIT
//
// A character's turn about y. Its heading is the tangent of a quarter of the angle, from -1 at -180 degrees to 1 at
// 180. Only + - * / make a quaternion of a heading, so all CPUs agree.
#pragma once

#include <cmath>
#include <numbers>

#include "tools/crowd/goals.h"

namespace swivel::tools {

// The quaternion (0, y, 0, w).
struct HalfTurn {
    double y, w;
};
inline HalfTurn half_turn_of(const goal_character& who)
{
    const double t{who.heading}, t2 = t * t;
    return {2 * t / (1 + t2), (1 - t2) / (1 + t2)};
}

// The heading of an angle, and the angle of a heading.
inline float heading_of(double degrees)
{
    return static_cast<float>(std::tan(std::remainder(degrees, 360) * std::numbers::pi / 720));
}
inline float degrees_of(const goal_character& who)
{
    return static_cast<float>(std::atan(double{who.heading}) * 720 / std::numbers::pi);
}

// Turns a vector's x and z along with a character. A heading of 0 keeps every bit.
inline void turn_with(const goal_character& who, double& x, double& z)
{
    if (who.heading == 0) return;
    const auto [y, w] = half_turn_of(who);
    const double cosine = w * w - y * y, sine = 2 * w * y, before = x;
    x = cosine * before + sine * z;
    z = cosine * z - sine * before;
}

}  // namespace swivel::tools
