// SPDX-License-Identifier: MIT
//
// A plot of a few series, as SVG inside a page. Knows numbers and names; no solver.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace swivel::tools {

struct Series {
    std::string name;
    std::vector<std::pair<double, double>> points;  // x and y; those that an axis cannot show are left out
    bool is_line = true;                            // false: points alone
    bool is_bound = false;                          // dashed: a limit, not a measurement
};

struct Plot {
    std::string title, x_label, y_label;
    bool log_x = false, log_y = false;
    std::vector<Series> series;
    std::vector<std::string> x_names{};  // of x = 0, 1, 2 and so on, in place of numbers
};

// The page's style has so many colours, .s0 and so on. A plot of more series uses some twice.
inline constexpr std::size_t kColourCount = 12;

// An <svg> element. Colours come from the page's style. No text of the plot is taken for markup.
std::string svg_of(const Plot& plot);

}  // namespace swivel::tools
