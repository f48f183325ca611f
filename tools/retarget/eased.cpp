// SPDX-License-Identifier: MIT
#include "tools/retarget/eased.h"

#include <algorithm>

namespace swivel::tools {

namespace {

// The lowest course above the values that changes by at most max_step a frame.
std::vector<double> course_above(std::vector<double> values, double max_step)
{
    for (std::size_t n = 1; n < values.size(); ++n) values[n] = std::max(values[n], values[n - 1] - max_step);
    for (std::size_t n = values.size(); n-- > 1;) values[n - 1] = std::max(values[n - 1], values[n] - max_step);
    return values;
}

}  // namespace

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

}  // namespace swivel::tools
