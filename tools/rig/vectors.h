// SPDX-License-Identifier: MIT
//
// Angles between directions, ranks and courses of numbers, numbers for people, and vectors as arrays.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace swivel::tools {

// The angle between two directions, 0 to 180; 0 where either is zero.
inline double degrees_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
    return std::atan2(a.cross(b).norm(), a.dot(b)) * (180 / std::numbers::pi);
}

// Copies a vector, or a quaternion's coeffs() as x, y, z, w, to an array of floats or doubles.
void put(const auto& from, auto& to)
{
    for (std::size_t n = 0; n < std::size(to); ++n)
        to[n] = static_cast<std::remove_cvref_t<decltype(to[n])>>(from[static_cast<Eigen::Index>(n)]);
}

// The axis of the world that is nearest to a direction, with its sign.
Eigen::Vector3d nearest_axis(const Eigen::Vector3d& direction);

// "x" to "z", with a minus in front where it points the other way.
std::string axis_name(const Eigen::Vector3d& axis);

// The axis of such a name; nothing for any other.
std::optional<Eigen::Vector3d> axis_of(std::string_view name);

// The quantile of this share, 0 to 1. values: one or more.
double quantile(std::vector<double> values, double share);

// The largest of some values above 0, and its frame.
struct Peak {
    std::size_t frame = 0;
    double value = 0;

    void raise(std::size_t at, double candidate)
    {
        if (candidate > value) *this = {at, candidate};
    }
};

// The lowest course above the values that changes by at most max_step a frame.
std::vector<double> course_above(std::vector<double> values, double max_step);

// The values, changed so that neighbours differ by at most max_step: halfway between the lowest such course above them
// and the highest one below. Values far enough from a jump stay as they are.
std::vector<double> eased(const std::vector<double>& values, double max_step);

// For people to read, without a -0.
Eigen::Vector3d to_three_decimals(const Eigen::Vector3d& v);

// "(0.000 1.000 0.000)", without the sign of a 0; and as a crowd file has it, "[0.000, 1.000, 0.000]".
std::string vector_text(const Eigen::Vector3d& v);
std::string toml_row(const Eigen::Vector3d& v);

}  // namespace swivel::tools
