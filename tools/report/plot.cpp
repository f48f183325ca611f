// SPDX-License-Identifier: MIT
#include "tools/report/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "tools/report/html.h"

namespace swivel::tools {

namespace {

constexpr double kWidth = 720, kHeight = 300, kLeft = 70, kRight = 20, kTop = 14, kBottom = 44;

// From numbers to places along one side of the picture.
struct Axis {
    bool log;
    double from, to;     // places, in pixels
    double least, most;  // as shown: of logarithms on a logarithmic axis

    bool shows(double value) const { return std::isfinite(value) && (!log || value > 0); }
    double scaled(double value) const { return log ? std::log10(value) : value; }
    double place(double value) const { return from + (to - from) * (scaled(value) - least) / (most - least); }
};

// Widens the axis to whole steps.
void round_out(Axis& axis, double step)
{
    axis.least = step * std::floor(axis.least / step);
    axis.most = step * std::ceil(axis.most / step);
    if (axis.least == axis.most) axis.most += step;
}

// 1, 2 or 5 times a power of ten, about a fifth of a range.
double step_of(double range)
{
    if (!(range > 0)) return 1;
    const double power = std::pow(10, std::floor(std::log10(range / 5)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power * 6 >= range) return factor * power;
    return 10 * power;
}

struct Tick {
    double place;
    std::string text;
};

std::vector<Tick> ticks_of(Axis& axis)
{
    const double step =
        axis.log ? std::max(1.0, std::ceil((axis.most - axis.least) / 8)) : step_of(axis.most - axis.least);
    round_out(axis, step);
    std::vector<Tick> ticks;
    const auto count = static_cast<int>(std::lround((axis.most - axis.least) / step));
    for (int n = 0; n <= count; ++n) {
        const double scaled = axis.least + n * step, value = axis.log ? std::pow(10, scaled) : scaled;
        const bool is_plain = axis.log && value > 0.09 && value < 1e5;
        ticks.push_back({axis.from + (axis.to - axis.from) * n / count,
                         axis.log && !is_plain ? fmt::format("1e{}", std::lround(scaled))
                                               : fmt::format("{:.6g}", std::fabs(value) < 1e-12 * step ? 0 : value)});
    }
    return ticks;
}

Axis axis_of(const Plot& plot, bool is_x)
{
    Axis axis{is_x ? plot.log_x : plot.log_y, is_x ? kLeft : kHeight - kBottom, is_x ? kWidth - kRight : kTop,
              std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    double bound = -std::numeric_limits<double>::infinity();
    for (const Series& series : plot.series)
        for (const auto& point : series.points) {
            const double value = is_x ? point.first : point.second;
            if (!axis.shows(value)) continue;
            axis.least = std::min(axis.least, axis.scaled(value));
            axis.most = std::max(axis.most, axis.scaled(value));
            if (series.is_bound) bound = std::max(bound, axis.scaled(value));
        }
    // A bound on the frame's edge could not be told from it.
    if (!is_x) axis.most = std::max(axis.most, bound + 0.02 * (axis.log ? 1 : axis.most - axis.least));
    if (!is_x && !axis.log) axis.least = std::min(axis.least, 0.0);
    return axis;
}

// A line for each tick, and its text.
std::string grid_of(const std::vector<Tick>& x_ticks, const std::vector<Tick>& y_ticks)
{
    std::string svg;
    for (const Tick& tick : x_ticks)
        svg += fmt::format(
            "<path class=\"grid\" d=\"M{0:.2f} {1}V{2}\"/><text class=\"x\" x=\"{0:.2f}\" y=\"{3}\">{4}</text>",
            tick.place, kTop, kHeight - kBottom, kHeight - kBottom + 16, escaped(tick.text));
    for (const Tick& tick : y_ticks)
        svg += fmt::format(
            "<path class=\"grid\" d=\"M{1} {0:.2f}H{2}\"/><text class=\"y\" x=\"{3}\" y=\"{4:.2f}\">{5}</text>",
            tick.place, kLeft, kWidth - kRight, kLeft - 6, tick.place + 4, escaped(tick.text));
    return svg;
}

using Points = std::span<const std::pair<double, double>>;

// Runs of neighbours that both axes show.
std::vector<Points> segments_of(const Series& series, const Axis& x, const Axis& y)
{
    std::vector<Points> segments;
    const Points all(series.points);
    std::size_t first = 0;
    for (std::size_t n = 0; n <= all.size(); ++n) {
        if (n < all.size() && x.shows(all[n].first) && y.shows(all[n].second)) continue;
        if (n > first) segments.push_back(all.subspan(first, n - first));
        first = n + 1;
    }
    return segments;
}

std::string svg_of(const Series& series, std::size_t number, const Axis& x, const Axis& y)
{
    constexpr std::size_t kMostDots = 60;  // more would hide the line
    std::string path, dots;
    for (const Points& segment : segments_of(series, x, y)) {
        const bool is_dotted = series.points.size() <= kMostDots && !series.is_bound;
        const bool is_drawn = series.is_line && segment.size() > 1;  // a line of one point paints nothing
        for (std::size_t n = 0; n < segment.size(); ++n) {
            const auto& [at_x, at_y] = segment[n];
            if (is_drawn) path += fmt::format("{}{:.2f} {:.2f}", n == 0 ? "M" : "L", x.place(at_x), y.place(at_y));
            if (is_dotted || !is_drawn)
                dots += fmt::format(
                    "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"3.2\"><title>{}: {:.6g}, {:.6g}</title></circle>",
                    x.place(at_x), y.place(at_y), escaped(series.name), at_x, at_y);
        }
    }
    return fmt::format("<g class=\"series s{}{}\">{}{}</g>", number % kColourCount, series.is_bound ? " bound" : "",
                       path.empty() ? "" : fmt::format("<path d=\"{}\"/>", path), dots);
}

}  // namespace

std::string svg_of(const Plot& plot)
{
    Axis x = axis_of(plot, true), y = axis_of(plot, false);
    if (!(x.least <= x.most) || !(y.least <= y.most)) return {};
    std::vector<Tick> x_ticks;
    if (plot.x_names.empty()) {
        x_ticks = ticks_of(x);
    } else {
        x.least = -0.5, x.most = static_cast<double>(plot.x_names.size()) - 0.5;
        for (std::size_t n = 0; n < plot.x_names.size(); ++n)
            x_ticks.push_back({x.place(static_cast<double>(n)), plot.x_names[n]});
    }
    const std::vector<Tick> y_ticks = ticks_of(y);
    std::string svg =
        fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\"><title>{}</title>", kWidth, kHeight, escaped(plot.title));
    svg += grid_of(x_ticks, y_ticks);
    for (std::size_t n = 0; n < plot.series.size(); ++n) svg += svg_of(plot.series[n], n, x, y);
    svg += fmt::format("<text class=\"x label\" x=\"{}\" y=\"{}\">{}</text>", (kLeft + kWidth - kRight) / 2,
                       kHeight - 8, escaped(plot.x_label));
    svg += fmt::format("<text class=\"x label\" transform=\"translate(14 {}) rotate(-90)\">{}</text></svg>",
                       (kTop + kHeight - kBottom) / 2, escaped(plot.y_label));
    return svg;
}

}  // namespace swivel::tools
