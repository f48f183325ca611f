// SPDX-License-Identifier: MIT
#include "tools/feet/floor.h"

#include <algorithm>

namespace swivel::tools {

namespace {

using Eigen::Vector3d;

// The grid's own axes in the world: x goes along the world's x, where that is level, and z to the viewer's side.
struct GridAxes {
    Vector3d x_w, z_w;

    explicit GridAxes(const Vector3d& up_w)
        : x_w(up_w.x() == 0 ? Vector3d::UnitX() : Vector3d::UnitY()), z_w(x_w.cross(up_w))
    {
    }
};

}  // namespace

double Floor::hill(const Vector3d& place_w) const
{
    if (!hills) return 0;
    const GridAxes axes(up_w);
    return ground_at(hills->grid, hills->heights.data(), place_w.dot(axes.x_w), place_w.dot(axes.z_w)).height;
}

Vector3d Floor::normal_w(const Vector3d& place_w) const
{
    if (!hills) return up_w;
    const GridAxes axes(up_w);
    const GroundPoint point =
        ground_at(hills->grid, hills->heights.data(), place_w.dot(axes.x_w), place_w.dot(axes.z_w));
    return (up_w - point.slope_x * axes.x_w - point.slope_z * axes.z_w).normalized();
}

double floor_level(const LegMotion& motion, const Contacts& contacts)
{
    std::vector<double> heights;
    for (std::size_t leg = 0; leg < motion.legs.size(); ++leg)
        for (std::size_t frame = 0; frame < motion.frame_count(); ++frame)
            if (contacts[leg][frame]) heights.push_back(motion.legs[leg].toe_w[frame].dot(motion.up_w));
    const auto middle = heights.begin() + std::ssize(heights) / 2;
    std::ranges::nth_element(heights, middle);
    return *middle;
}

}  // namespace swivel::tools
