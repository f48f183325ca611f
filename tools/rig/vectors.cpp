// SPDX-License-Identifier: MIT
#include "tools/rig/vectors.h"

#include <fmt/format.h>

#include <algorithm>

namespace swivel::tools {

Eigen::Vector3d nearest_axis(const Eigen::Vector3d& direction)
{
    Eigen::Index axis = 0;
    direction.cwiseAbs().maxCoeff(&axis);
    return std::copysign(1.0, direction[axis]) * Eigen::Vector3d::Unit(axis);
}

std::string axis_name(const Eigen::Vector3d& axis)
{
    Eigen::Index at = 0;
    axis.cwiseAbs().maxCoeff(&at);
    return fmt::format("{}{}", axis[at] < 0 ? "-" : "", "xyz"[at]);
}

std::optional<Eigen::Vector3d> axis_of(std::string_view name)
{
    for (Eigen::Index at = 0; at < 3; ++at)
        for (const double sign : {1.0, -1.0})
            if (const Eigen::Vector3d axis = sign * Eigen::Vector3d::Unit(at); axis_name(axis) == name) return axis;
    return std::nullopt;
}

double quantile(std::vector<double> values, double share)
{
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, at);
    return *at;
}

std::vector<double> course_above(std::vector<double> values, double max_step)
{
    for (std::size_t n = 1; n < values.size(); ++n) values[n] = std::max(values[n], values[n - 1] - max_step);
    for (std::size_t n = values.size(); n-- > 1;) values[n - 1] = std::max(values[n - 1], values[n] - max_step);
    return values;
}

std::vector<double> eased(const std::vector<double>& values, double max_step)
{
    std::vector<double> turned = values;
    for (double& value : turned) value = -value;
    std::vector<double> above = course_above(values, max_step);
    const std::vector<double> below = course_above(std::move(turned), max_step);
    for (std::size_t n = 0; n < above.size(); ++n)
        if (above[n] != -below[n]) above[n] = (above[n] - below[n]) / 2;
    return above;
}

Eigen::Vector3d to_three_decimals(const Eigen::Vector3d& v) { return (1000 * v).array().round() / 1000 + 0.0; }

std::string vector_text(const Eigen::Vector3d& v)
{
    const Eigen::Vector3d shown = to_three_decimals(v);
    return fmt::format("({:.3f} {:.3f} {:.3f})", shown.x(), shown.y(), shown.z());
}

std::string toml_row(const Eigen::Vector3d& v)
{
    const Eigen::Vector3d shown = to_three_decimals(v);
    return fmt::format("[{:.3f}, {:.3f}, {:.3f}]", shown.x(), shown.y(), shown.z());
}

}  // namespace swivel::tools
