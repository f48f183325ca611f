// SPDX-License-Identifier: MIT
#include "tests/feet_motion.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <sstream>

namespace swivel::test {

using Eigen::Vector3d;

double PlainLegs::leg_length(std::size_t side) const
{
    const PlainLegPath& leg = legs[side];
    return (leg.knee[0] - leg.hip[0]).norm() + (leg.ankle[0] - leg.knee[0]).norm();
}

PlainLegs legs_path(const PlainMotion& motion, double frame_time)
{
    constexpr const char* kJoints[] = {"UpLeg", "Leg", "Foot", "ToeBase"};
    PlainLegs path{frame_time, {}, {}};
    for (std::size_t frame = 0; frame < motion.lines.size(); ++frame) {
        const std::vector<PlainPose> pose = pose_of(motion, frame);
        path.add(pose[0].position, [&](std::size_t joint, std::size_t side) {
            const std::string name = (side == 0 ? "Left" : "Right") + std::string(kJoints[joint]);
            return pose[static_cast<std::size_t>(joint_named(motion, name))].position;
        });
    }
    return path;
}

PlainLegs legs_path(const PlainGltf& gltf, const std::array<std::string, 5>& names,
                    const std::array<std::string, 2>& sides, const std::vector<double>& times)
{
    PlainLegs path{times[1] - times[0], {}, {}};
    for (const double time : times) {
        const auto place = [&](std::string name, std::size_t side) {
            if (name.find('*') != name.npos) name.replace(name.find('*'), 1, sides[side]);
            return Vector3d(plain_world(gltf, 0, gltf.node_named(name), time).translation());
        };
        path.add(place(names[0], 0),
                 [&](std::size_t joint, std::size_t side) { return place(names[1 + joint], side); });
    }
    return path;
}

std::string carried(const PlainMotion& motion, const Carried& to)
{
    std::istringstream in(motion.header);
    std::string text, joint;
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "JOINT") words >> joint;
        if (word == "End") joint = "end";
        const bool is_bone = joint == "LeftLeg" || joint == "RightLeg" || joint == "LeftFoot" || joint == "RightFoot";
        double x = 0, y = 0, z = 0;
        if (word == "OFFSET" && is_bone && words >> x >> y >> z)
            line = fmt::format("OFFSET {} {} {}", to.legs * x, to.legs * y, to.legs * z);
        if (word == "Frames:") line = fmt::format("Frames: {}", (motion.lines.size() + to.every - 1) / to.every);
        if (word == "Frame") line = fmt::format("Frame Time: {}", to.frame_time());
        text += line + "\n";
    }
    const std::vector<double>&first = motion.values.front(), &last = motion.values.back();
    for (std::size_t frame = 0; frame < motion.values.size(); frame += to.every) {
        std::vector<double> values = motion.values[frame];
        const double passed = static_cast<double>(frame) / static_cast<double>(motion.values.size() - 1);
        for (std::size_t n = 0; n < motion.joint(0).channels.size(); ++n) {
            const std::string& channel = motion.joint(0).channels[n];
            if (channel == "Xposition" || channel == "Zposition")
                values[n] = to.way * values[n] - to.minus * passed * (last[n] - first[n]);
        }
        for (std::size_t n = 0; n < values.size(); ++n) text += fmt::format("{}{:.6f}", n == 0 ? "" : " ", values[n]);
        text += "\n";
    }
    return text;
}

PlainContacts plain_contacts(const PlainLegs& legs, double speed, double height)
{
    PlainContacts contacts;
    const int last = static_cast<int>(legs.frame_count()) - 1;
    const auto floor_of = [&](std::size_t side) {
        std::vector<double> heights;
        for (const Eigen::Vector3d& toe : legs.legs[side].toe) heights.push_back(toe.y());
        std::ranges::sort(heights);
        return heights[static_cast<std::size_t>(last / 50)];
    };
    for (std::size_t side = 0; side < 2; ++side) {
        const double length = legs.leg_length(side), floor = floor_of(side);
        const bool is_held_up = floor >= floor_of(1 - side) + height * length;
        const auto toe = [&](int frame) {
            return legs.legs[side].toe[static_cast<std::size_t>(std::clamp(frame, 0, last))];
        };
        const auto stands = [&](int frame) {
            const int at = std::clamp(frame, 0, last), before = std::max(at - 1, 0), after = std::min(at + 1, last);
            const double way = (toe(after) - toe(before)).norm(), time = (after - before) * legs.frame_time;
            return !is_held_up && way < speed * length * time && toe(at).y() < floor + height * length;
        };
        for (int frame = 0; frame <= last; ++frame) {
            int count = 0;
            for (int n = -2; n <= 2; ++n) count += stands(frame + n) ? 1 : 0;
            contacts[side].push_back(count > 2);
        }
    }
    return contacts;
}

PlainContacts prototypes_contacts(const PlainLegs& source)
{
    const double leg = kMetre * source.leg_length(0);
    return plain_contacts(source, 0.5 / leg, 0.06 / leg);
}

PlainContacts contacts_in_table(const std::string& csv, std::size_t frame_count)
{
    PlainContacts contacts{std::vector<bool>(frame_count), std::vector<bool>(frame_count)};
    std::istringstream in(csv);
    std::string line;
    std::getline(in, line);
    REQUIRE(line == "frame,limb,contact");
    while (std::getline(in, line)) {
        std::vector<bool>& leg = contacts[line.find("left_leg") == line.npos ? 1 : 0];
        std::fill(leg.begin() + std::stol(line), leg.end(), line.ends_with(",on"));
    }
    return contacts;
}

PlainSkating plain_skating(const PlainLegs& legs, const PlainContacts& contacts)
{
    PlainSkating skating;
    double way = 0, begun_way = 0, frames = 0, steps = 0;
    for (std::size_t side = 0; side < 2; ++side) {
        const PlainLegPath& leg = legs.legs[side];
        bool is_begun = false;
        const auto bend = [&](std::size_t n) {
            const Vector3d thigh = leg.knee[n] - leg.hip[n], shin = leg.ankle[n] - leg.knee[n];
            return std::atan2(thigh.cross(shin).norm(), thigh.dot(shin)) * 180 / std::numbers::pi;
        };
        for (std::size_t n = 1; n < legs.frame_count(); ++n) {
            const Vector3d step = leg.toe[n] - leg.toe[n - 1];
            skating.knee = std::max(skating.knee, std::abs(bend(n) - bend(n - 1)));
            if (n > 1)
                skating.jump =
                    std::max(skating.jump, (step - (leg.toe[n - 1] - leg.toe[n - 2])).norm() / legs.frame_time);
            if (contacts[side][n] && !contacts[side][n - 1]) {
                ++steps;
                is_begun = true;
            }
            if (!contacts[side][n] || !contacts[side][n - 1]) continue;
            const double slide = std::hypot(step.x(), step.z());
            skating.max = std::max(skating.max, slide / legs.frame_time);
            skating.sink = std::max(skating.sink, std::abs(step.y()));
            way += slide;
            if (is_begun) begun_way += slide;
            ++frames;
        }
    }
    for (std::size_t n = 2; n < legs.body.size(); ++n)
        skating.body_jump = std::max(skating.body_jump,
                                     (legs.body[n - 2] - 2 * legs.body[n - 1] + legs.body[n]).norm() / legs.frame_time);
    skating.mean = way / (frames * legs.frame_time);
    skating.step = way / steps;
    skating.begun_step = begun_way / steps;
    return skating;
}

namespace {

// The spline of degree k over the knots n, n + 1, ...
double basis(int k, double n, double t)
{
    if (k == 0) return t >= n && t < n + 1 ? 1 : 0;
    return ((t - n) * basis(k - 1, n, t) + (n + k + 1 - t) * basis(k - 1, n + 1, t)) / k;
}

}  // namespace

double Hills::height(double x, double z) const
{
    // Sample n is the middle of its spline, which starts 1.5 before it.
    const double column = (x / size.x() + 0.5) * static_cast<double>(columns - 1),
                 row = (z / size.z() + 0.5) * static_cast<double>(rows - 1);
    double sum = 0;
    for (double r = std::floor(row) - 2; r <= row + 2; ++r)
        for (double c = std::floor(column) - 2; c <= column + 2; ++c) {
            const auto at = [](double n, std::size_t count) {
                return static_cast<std::size_t>(std::clamp(n, 0.0, static_cast<double>(count - 1)));
            };
            sum += basis(2, r - 1.5, row) * basis(2, c - 1.5, column) * samples[at(r, rows) * columns + at(c, columns)];
        }
    return sum * size.y() / 65535;
}

Hills random_hills(const Vector3d& size)
{
    Hills hills{24, 17, {}, size};
    std::mt19937 random(42);
    std::uniform_int_distribution<int> any(0, 65535);
    for (std::size_t n = 0; n < hills.columns * hills.rows; ++n)
        hills.samples.push_back(static_cast<std::uint16_t>(any(random)));
    return hills;
}

Hills ground_along(const Vector3d& way, const std::function<double(double)>& height)
{
    constexpr std::size_t kSamples = 401;
    const double reach = 1.5 * way.norm();
    std::vector<double> heights;
    for (std::size_t row = 0; row < kSamples; ++row)
        for (std::size_t column = 0; column < kSamples; ++column) {
            const auto place = [&](std::size_t n) { return reach * (2 * static_cast<double>(n) / (kSamples - 1) - 1); };
            heights.push_back(height(Vector3d(place(column), 0, place(row)).dot(way.normalized())));
        }
    const auto [low, high] = std::ranges::minmax(heights);
    Hills ground{kSamples, kSamples, {}, {2 * reach, high - low, 2 * reach}};
    for (const double each : heights)
        ground.samples.push_back(static_cast<std::uint16_t>(std::lround(65535 * (each - low) / (high - low))));
    return ground;
}

void write_png(const fs::path& path, const Hills& hills, int bits)
{
    std::FILE* const file = std::fopen(path.c_str(), "wb");
    REQUIRE(file);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_IHDR(png, info, static_cast<png_uint_32>(hills.columns), static_cast<png_uint_32>(hills.rows), bits,
                 PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    for (std::size_t row = 0; row < hills.rows; ++row) {
        std::vector<png_byte> bytes;
        for (std::size_t column = 0; column < hills.columns; ++column) {
            const std::uint16_t sample = hills.samples[row * hills.columns + column];
            bytes.push_back(static_cast<png_byte>(sample >> 8));
            if (bits == 16) bytes.push_back(static_cast<png_byte>(sample & 255));
        }
        png_write_row(png, bytes.data());
    }
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    std::fclose(file);
}

}  // namespace swivel::test
