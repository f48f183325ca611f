// SPDX-License-Identifier: MIT
//
// Draws the picture of docs/howto/limits.md: the region that swivel puts around what a clip does, beside one cone.
#include <array>

#include "swivel/swivel.hpp"
#include "tools/site/picture.h"

namespace {

using Float3 = std::array<float, 3>;

constexpr double kPi = 3.141592653589793, kRadius = 150;
constexpr Point kMiddle{200, 190};

// The sphere as a disc, on which equal areas are equal: +z is its middle, -z its rim.
Point shown(const Float3& d)
{
    const double x = double{d[0]}, y = double{d[1]}, z = double{d[2]}, across = std::hypot(x, y);
    const double far = kRadius * std::sqrt((1 - z) / 2), scale = across > 0 ? far / across : 0;
    return {kMiddle.x + scale * x, kMiddle.y - scale * y};
}
Float3 direction(double x, double y)
{
    const double far2 = x * x + y * y, z = 1 - 2 * far2, scale = 2 * std::sqrt(std::fmax(0, 1 - far2));
    return {static_cast<float>(scale * x), static_cast<float>(scale * y), static_cast<float>(z)};
}

// An arm that reaches up, out to the side and down, and sways on its way.
std::vector<Float3> clip()
{
    std::vector<Float3> made;
    for (int n = 0; n <= 240; ++n) {
        const double turn = (80 - 230.0 * n / 240) * kPi / 180, far = 0.55 + 0.05 * std::sin(n / 8.0);
        made.push_back(direction(far * std::cos(turn), far * std::sin(turn)));
    }
    return made;
}

// Runs of allowed directions, and the share of all directions that they are.
double draw(Picture& picture, const swivel::Region& region, const char* colour, double opacity)
{
    constexpr int kRows = 100, kColumns = 300;
    int inside = 0, all = 0;
    for (int row = 0; row < kRows; ++row) {
        const double y = 1 - 2 * (row + 0.5) / kRows;
        int start = -1;
        for (int column = 0; column <= kColumns; ++column) {
            const double x = -1 + 2 * (column + 0.5) / kColumns;
            const bool on = x * x + y * y < 1, allowed = on && region.room(direction(x, y)) >= 0;
            all += on, inside += allowed;
            if (allowed && start < 0) start = column;
            if (allowed || start < 0) continue;
            const auto at = [&](int n) { return kMiddle.x + kRadius * (2.0 * n / kColumns - 1); };
            const double top = kMiddle.y - kRadius * (y + 1.0 / kRows);
            picture.box({at(start), top}, {at(column), top + 2 * kRadius / kRows}, colour, opacity);
            start = -1;
        }
    }
    return 100.0 * inside / all;
}

std::string around_a_clip()
{
    const std::vector<Float3> directions = clip();
    const auto around = [&](std::uint32_t most_cones) {
        swivel::Region region;
        region.add_directions(directions, static_cast<float>(swivel::degrees(5)), most_cones);
        return region;
    };
    Picture picture("A region around what a clip does", 380);
    std::vector<Point> rim;
    for (int n = 0; n <= 180; ++n)
        rim.push_back({kMiddle.x + kRadius * std::cos(n * kPi / 90), kMiddle.y + kRadius * std::sin(n * kPi / 90)});
    const double one = draw(picture, around(1), kPale, 0.5), some = draw(picture, around(6), kGreen, 0.5);
    picture.line(rim, kInk, 2);
    for (const Float3& each : directions) picture.dot(shown(each), 1.6, kOrange);
    const auto legend = [&](double y, const char* colour, const char* words) {
        picture.box({390, y - 11}, {408, y + 3}, colour, 0.7);
        picture.text({418, y}, words, kInk);
    };
    char line[80];
    legend(120, kOrange, "where the clip's upper arm points");
    std::snprintf(line, sizeof line, "the region: %.0f %% of all directions", some);
    legend(160, kGreen, line);
    std::snprintf(line, sizeof line, "one cone around it: %.0f %%", one);
    legend(200, kPale, line);
    picture.text({390, 250}, "The disc is all directions, of equal areas.", kGrey);
    picture.text({390, 274}, "The arm at rest is its middle.", kGrey);
    return picture.done();
}

}  // namespace

std::vector<NamedPicture> region_pictures() { return {{"region.svg", around_a_clip()}}; }
