// SPDX-License-Identifier: MIT
//
// How a figure's feet stand: how high over the world's origin, and how steep from ankle to toe. Knows clips and
// figures.
#pragma once

#include <array>
#include <optional>

#include "tools/retarget/rest_figure.h"

namespace swivel::tools {

struct Stance {
    std::optional<double> height;                // of toes, or else ankles, on the ground, along the figure's up
    std::array<std::optional<double>, 2> slope;  // from ankle to toe of a flat foot, left and right: the angle over
                                                 // the ground, radians; nothing without toes, too
};

// The angle of a way, as a figure has it, over the ground: radians, below 0 downwards.
double slope_of(const Eigen::Vector3d& way);

// A figure whose feet at rest are within 0.3 leg lengths of height 0 stands so: its rest tells all. Otherwise its clip
// tells it, where that has more than one frame. A foot is still in a frame to which ankle and toe come slower than 0.3
// legs a second. With ten still feet or more, the slope of both feet is the one that nine
// tenths of them are not above, and the height is the median of those that were the lower foot. With fewer, the height
// is that which the lower foot is not above in a twentieth of the frames, and no slope is told.
Stance stance_of(const formats::Clip& clip, const RestFigure& figure, bool has_toes);

}  // namespace swivel::tools
