// SPDX-License-Identifier: MIT
#include "tools/feet/contacts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/formats/error.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

using Eigen::Vector3d;

// How many frames on either side lie within a time: 1 at least, and at most the clip's.
std::size_t frames_within(const LegMotion& motion, double seconds)
{
    const auto max = static_cast<double>(motion.frame_count());
    return static_cast<std::size_t>(std::clamp(std::round(seconds / motion.frame_time), 1.0, max));
}

// Each leg's floor: the 2nd percentile of its toe's heights.
std::vector<double> floors_of(const LegMotion& motion)
{
    std::vector<double> floors;
    for (const LegPath& leg : motion.legs) {
        std::vector<double> heights;
        for (const Vector3d& toe_w : leg.toe_w) heights.push_back(toe_w.dot(motion.up_w));
        floors.push_back(quantile(std::move(heights), 0.02));
    }
    return floors;
}

// The frames in which each leg's toe is low. A leg that is always held up has none.
std::vector<std::vector<bool>> low_frames(const LegMotion& motion, const ContactBars& bars)
{
    const std::vector<double> floors = floors_of(motion);
    std::vector<std::vector<bool>> low;
    for (std::size_t n = 0; n < floors.size(); ++n) {
        const LegPath& leg = motion.legs[n];
        const double bar = bars.height * leg.length;
        const bool is_held_up = floors[n] >= std::ranges::min(floors) + bar;
        std::vector<bool>& of_leg = low.emplace_back();
        for (const Vector3d& toe_w : leg.toe_w)
            of_leg.push_back(!is_held_up && toe_w.dot(motion.up_w) < floors[n] + bar);
    }
    return low;
}

// stands: in the frames in which its toe is low.
std::vector<bool> find_of_leg(const LegMotion& motion, const LegPath& leg, std::vector<bool> stands,
                              const ContactBars& bars)
{
    const std::size_t last = motion.frame_count() - 1, near = frames_within(motion, 1.0 / 60);
    for (std::size_t frame = 0; frame <= last; ++frame) {
        const std::size_t before = frame - std::min(frame, near), after = std::min(frame + near, last);
        const double time = static_cast<double>(after - before) * motion.frame_time;
        if ((leg.toe_w[after] - leg.toe_w[before]).norm() >= bars.speed * leg.length * time) stands[frame] = false;
    }
    // Most of the frames around each; the first and the last one count for those beyond.
    const auto half = static_cast<std::ptrdiff_t>(frames_within(motion, (1.0 / 12 - motion.frame_time) / 2));
    const auto stands_at = [&](std::ptrdiff_t frame) -> std::ptrdiff_t {
        return stands[static_cast<std::size_t>(std::clamp(frame, std::ptrdiff_t{0}, std::ssize(stands) - 1))] ? 1 : 0;
    };
    std::ptrdiff_t standing = 0;  // of the frames around one
    for (std::ptrdiff_t n = -half; n <= half; ++n) standing += stands_at(n);
    std::vector<bool> max;
    for (std::ptrdiff_t frame = 0; frame < std::ssize(stands); ++frame) {
        max.push_back(standing > half);
        standing += stands_at(frame + half + 1) - stands_at(frame - half);
    }
    return max;
}

// The grid's own axes in the world: x goes along the world's x, where that is level, and z to the viewer's side.
struct GridAxes {
    Vector3d x_w, z_w;

    explicit GridAxes(const Vector3d& up_w)
        : x_w(up_w.x() == 0 ? Vector3d::UnitX() : Vector3d::UnitY()), z_w(x_w.cross(up_w))
    {
    }
};

}  // namespace

Contacts find_contacts(const LegMotion& motion, const ContactBars& bars)
{
    Contacts contacts;
    std::vector<std::vector<bool>> low = low_frames(motion, bars);
    for (std::size_t n = 0; n < low.size(); ++n)
        contacts.push_back(find_of_leg(motion, motion.legs[n], std::move(low[n]), bars));
    return contacts;
}

std::optional<Slide> slide_of(const LegMotion& motion, const ContactBars& bars)
{
    Vector3d way = Vector3d::Zero();
    double path = 0, beside_body = 0;
    std::array<std::vector<double>, 3> steps;
    const std::vector<std::vector<bool>> low = low_frames(motion, bars);
    for (std::size_t n = 0; n < low.size(); ++n) {
        const std::vector<Vector3d>& toe_w = motion.legs[n].toe_w;
        for (std::size_t frame = 1; frame < toe_w.size(); ++frame)
            if (low[n][frame] && low[n][frame - 1]) {
                const Vector3d step = motion.level(toe_w[frame] - toe_w[frame - 1]);
                way += step;
                path += step.norm();
                beside_body += (step - motion.level(motion.carrier_w[frame] - motion.carrier_w[frame - 1])).norm();
                for (int axis = 0; axis < 3; ++axis) steps[static_cast<std::size_t>(axis)].push_back(step[axis]);
            }
    }
    Eigen::AlignedBox3d room;
    for (const Vector3d& place_w : motion.carrier_w) room.extend(motion.level(place_w));
    if (way.norm() <= motion.leg_length() / 2) return std::nullopt;
    const bool with_body = beside_body < path / 2;
    if (!with_body && way.norm() <= 2 * room.diagonal().norm()) return std::nullopt;
    const Vector3d step(quantile(steps[0], 0.5), quantile(steps[1], 0.5), quantile(steps[2], 0.5));
    return Slide{step / motion.frame_time, with_body};
}

std::vector<formats::ContactRow> rows_of(const LegMotion& motion, const Contacts& contacts)
{
    std::vector<formats::ContactRow> rows;
    for (std::size_t frame = 0; frame < motion.frame_count(); ++frame)
        for (std::size_t leg = 0; leg < contacts.size(); ++leg)
            if (frame == 0 || contacts[leg][frame] != contacts[leg][frame - 1])
                rows.push_back({static_cast<std::uint32_t>(frame), motion.legs[leg].name, contacts[leg][frame], 0});
    return rows;
}

Contacts contacts_of_rows(std::span<const LegPath> legs, std::size_t frame_count,
                          std::span<const formats::ContactRow> rows, const std::filesystem::path& file)
{
    Contacts contacts(legs.size(), std::vector<bool>(frame_count));
    for (const formats::ContactRow& row : rows) {
        const auto leg = std::ranges::find_if(legs, [&](const LegPath& each) { return each.name == row.limb; });
        if (leg == legs.end())
            throw formats::InputError(
                file, row.line, fmt::format("{} is no leg that the clip has; remove its rows", limb_word(row.limb)));
        if (row.frame >= frame_count)
            throw formats::InputError(
                file, row.line,
                fmt::format("there is no frame {}; the clip's frames are 0 to {}", row.frame, frame_count - 1));
        std::vector<bool>& frames = contacts[static_cast<std::size_t>(leg - legs.begin())];
        std::fill(frames.begin() + row.frame, frames.end(), row.is_on);  // rows are in the order of their frames
    }
    return contacts;
}

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
