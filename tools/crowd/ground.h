// SPDX-License-Identifier: MIT
//
// Ground as it lies: a grid of heights, read by a biquadratic B-spline. So height and normal are continuous, and the
// steps of 8 bits are smooth. Only + - * and floor, so all CPUs agree. Knows no file's axes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/formats/height_picture.h"

namespace swivel::tools {

// Its middle is at 0. Columns go along x, from -width/2 to width/2, rows along z. Beyond its edges the ground goes on
// level, as high as there.
struct Ground {
    formats::HeightPicture picture;
    double width = 1, height = 1, depth = 1;  // along x, of white, along z; above 0
};

struct GroundPoint {
    double height, slope_x, slope_z;  // the slopes: of the height, along x and z
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
    const auto sample = [&](double n) { return static_cast<std::size_t>(std::clamp(n, 0.0, last)); };
    return {{sample(middle - 1), sample(middle), sample(middle + 1)},
            {0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t, 0.5 * (0.5 + t) * (0.5 + t)},
            {t - 0.5, -2 * t, t + 0.5}};
}

inline GroundPoint ground_at(const Ground& ground, double x, double z)
{
    const formats::HeightPicture& picture = ground.picture;
    const double column_step = ground.width / (picture.columns - 1), row_step = ground.depth / (picture.rows - 1);
    const SplineReach column = spline_reach((x + ground.width / 2) / column_step, picture.columns),
                      row = spline_reach((z + ground.depth / 2) / row_step, picture.rows);
    GroundPoint point{0, 0, 0};
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c) {
            const double height =
                ground.height * double{picture.heights[row.sample[r] * picture.columns + column.sample[c]]};
            point.height += row.share[r] * column.share[c] * height;
            point.slope_x += row.share[r] * column.slope[c] * height / column_step;
            point.slope_z += row.slope[r] * column.share[c] * height / row_step;
        }
    return point;
}

}  // namespace swivel::tools
