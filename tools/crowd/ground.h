// SPDX-License-Identifier: MIT
//
// Ground as it lies: a grid of heights, read by a biquadratic B-spline. So height and normal are continuous, and the
// steps of 8 bits are smooth. Only + - * / and floor, so all CPUs agree. Knows no file's axes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/crowd/goals.h"

namespace swivel::tools {

struct Ground {
    goal_ground grid;
    std::vector<float> heights;  // [row * columns + column], 0 to 1
};

struct GroundPoint {
    double height, slope_x, slope_z;  // the height in the world; its slopes along x and z
};

// Where a line of samples is read: three of them, and their shares in the value and in its slope.
struct SplineReach {
    std::array<std::size_t, 3> sample;
    std::array<double, 3> share, slope;
};
// at: in samples, from the first. count: of samples, 1 or more; the outer ones go on for ever.
inline SplineReach spline_reach(double at, std::uint32_t count)
{
    const double last = count - 1.0, middle = std::floor(std::clamp(at, -1.0, last + 1) + 0.5);
    const double t = std::clamp(at - middle, -0.5, 0.5);  // beyond the edges all three samples are the outer one
    const auto sample = [&](double n) { return n > 0 ? static_cast<std::size_t>(std::min(n, last)) : 0; };  // NaN: 0
    return {{sample(middle - 1), sample(middle), sample(middle + 1)},
            {0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t, 0.5 * (0.5 + t) * (0.5 + t)},
            {t - 0.5, -2 * t, t + 0.5}};
}

inline GroundPoint ground_at(const goal_ground& grid, const float* heights, double x, double z)
{
    GroundPoint point{grid.place[1], 0, 0};
    if (grid.columns == 0) return point;
    const double column_step = grid.size[0] / (grid.columns - 1), row_step = grid.size[2] / (grid.rows - 1);
    const SplineReach column = spline_reach((x - grid.place[0] + grid.size[0] / 2) / column_step, grid.columns),
                      row = spline_reach((z - grid.place[2] + grid.size[2] / 2) / row_step, grid.rows);
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c) {
            const double height = grid.size[1] * double{heights[row.sample[r] * grid.columns + column.sample[c]]};
            point.height += row.share[r] * column.share[c] * height;
            point.slope_x += row.share[r] * column.slope[c] * height / column_step;
            point.slope_z += row.slope[r] * column.share[c] * height / row_step;
        }
    return point;
}

}  // namespace swivel::tools
