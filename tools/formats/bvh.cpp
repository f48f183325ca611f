// SPDX-License-Identifier: MIT
#include "tools/formats/bvh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "tools/formats/bvh_scanner.h"
#include "tools/formats/euler.h"
#include "tools/formats/limits.h"
#include "tools/formats/printable.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

constexpr double kMaxDegrees = 1e9;                      // of which a double's last digit is 1e-7 degrees
constexpr std::size_t kMaxPoses = std::size_t{1} << 28;  // frames times joints: 8 GiB of quaternions

// Returns the announced number of frames.
std::size_t read_motion_header(Scanner& scan, BvhFile& file)
{
    if (file.channel_count == 0) fail(scan, "no joint has CHANNELS, so there is no motion to read");
    file.motion_begin = scan.at;
    expect(scan, "Frames:");
    const std::string_view count_word = rest_of_line(scan);
    const std::optional<std::int64_t> count = parse_integer(count_word);
    if (!count || *count < 1) {
        fail(scan, fmt::format("Frames: '{}' is not a whole number above 0", printable(count_word)));
    }
    file.frames_line = scan.line;
    file.announced_count = static_cast<std::size_t>(*count);
    expect(scan, "Frame");
    expect(scan, "Time:");
    const std::string_view time_word = rest_of_line(scan);
    const std::optional<double> time = parse_number(time_word);
    if (!time || !(*time > 0)) {
        fail(scan, fmt::format("Frame Time: '{}' is not a number of seconds above 0", printable(time_word)));
    }
    file.clip.frame_time = *time;
    return static_cast<std::size_t>(*count);
}

// Makes room for the frames that the rest of the text can hold, at two bytes a value, whatever the file announces.
void reserve_frames(const Scanner& scan, BvhFile& file, std::size_t announced)
{
    Clip& clip = file.clip;
    const std::size_t max = (scan.text.size() - scan.at) / (2 * file.channel_count) + 1;
    const std::size_t frame_count = std::min(announced, max);
    if (frame_count > kMaxPoses / clip.joints.size()) {
        fail(scan, fmt::format("{} frames of {} joints need more than 8 GiB; cut the clip into pieces", frame_count,
                               clip.joints.size()));
    }
    file.frame_begin.reserve(frame_count);
    clip.rotation.reserve(frame_count * clip.joints.size());
    clip.translation.reserve(frame_count * clip.track_count);
}

// A channel of a frame's line.
struct NamedChannel {
    std::string name;
    bool is_position;
};

NamedChannel named_channel(const BvhFile& file, std::size_t channel)
{
    const auto after = std::upper_bound(file.joints.begin(), file.joints.end(), channel,
                                        [](std::size_t c, const BvhJoint& joint) { return c < joint.first_channel; });
    // Joints without channels share their successor's first channel; the last of equals has them.
    const auto joint = static_cast<std::size_t>(after - file.joints.begin()) - 1;
    const Channel kind = file.joints[joint].channels[channel - file.joints[joint].first_channel];
    return {
        fmt::format("{} {}", printable(file.clip.joints[joint].name), kChannelNames[static_cast<std::size_t>(kind)]),
        is_position(kind)};
}

// Refuses a number that is too large: an angle that a double does not resolve, or a place beyond the engine's range.
void require_held(const Scanner& scan, const BvhFile& file, std::size_t channel, double number)
{
    if (std::abs(number) <= kMaxDegrees) return;
    const NamedChannel at = named_channel(file, channel);
    if (at.is_position && std::abs(number) <= kMaxNorm) return;
    fail(scan, fmt::format("value {} ({}): {:g} is more than {:g}{}; correct it", channel + 1, at.name, number,
                           at.is_position ? kMaxNorm : kMaxDegrees, at.is_position ? "" : " degrees"));
}

void parse_values(const Scanner& scan, const BvhFile& file, std::string_view line, std::span<double> values)
{
    std::size_t count = 0;
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line), ++count) {
        if (count >= values.size()) continue;
        const std::optional<double> number = parse_number(word);
        if (!number) {
            fail(scan, fmt::format("value {} ({}): '{}' is not a finite decimal number", count + 1,
                                   named_channel(file, count).name, printable(word)));
        }
        require_held(scan, file, count, *number);
        values[count] = *number;
    }
    if (count != values.size()) {
        fail(scan, fmt::format("{} values, the channels need {} (one frame is one line)", count, values.size()));
    }
}

void append_frame(BvhFile& file, std::span<const double> values)
{
    Clip& clip = file.clip;
    for (std::size_t i = 0; i < file.joints.size(); ++i) {
        const BvhJoint& joint = file.joints[i];
        Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
        Eigen::Vector3d translation = clip.joints[i].offset;
        for (std::size_t c = 0; c < joint.channels.size(); ++c) {
            const Channel channel = joint.channels[c];
            const double value = values[joint.first_channel + c];
            if (is_position(channel)) {
                translation[axis_of(channel)] = value;
            } else {
                rotation = rotation * axis_rotation(axis_of(channel), value);
            }
        }
        clip.rotation.push_back(rotation);
        if (clip.joints[i].track >= 0) clip.translation.push_back(translation);
    }
    ++clip.frame_count;
}

// Takes the line as the next frame. One beyond those announced is checked and left out.
void read_frame(const Scanner& scan, BvhFile& file, std::size_t announced, std::string_view line,
                std::span<double> values)
{
    parse_values(scan, file, line, values);
    if (file.clip.frame_count == announced) {
        ++file.surplus_count;
        return;
    }
    file.frame_begin.push_back(scan.at);
    append_frame(file, values);
}

void read_frames(Scanner& scan, BvhFile& file, std::size_t announced)
{
    std::vector<double> values(file.channel_count);
    while (scan.at < scan.text.size()) {
        const std::size_t end = std::min(scan.text.find('\n', scan.at), scan.text.size());
        const std::string_view line = scan.text.substr(scan.at, end - scan.at);
        if (!trimmed(line).empty()) read_frame(scan, file, announced, line, values);
        skip_to(scan, std::min(end + 1, scan.text.size()));
    }
    if (file.clip.frame_count != announced) {
        fail(scan, fmt::format("the file ends after {} of the {} frames announced in line {}; is it cut short?",
                               file.clip.frame_count, announced, file.frames_line));
    }
}

}  // namespace

BvhFile read_bvh(const std::filesystem::path& path) { return bvh_of(path, read_text(path)); }

BvhFile bvh_of(const std::filesystem::path& path, std::string text)
{
    BvhFile file;
    file.path = path;
    file.text = std::move(text);
    Scanner scan{file.path, file.text, file.text.size() - without_byte_order_mark(file.text).size()};
    read_hierarchy(scan, file);
    const std::size_t announced = read_motion_header(scan, file);
    reserve_frames(scan, file, announced);
    read_frames(scan, file, announced);
    return file;
}

bool is_bvh_text(std::string_view text)
{
    text = without_byte_order_mark(text);
    return same_ignoring_case(take_word(text), "HIERARCHY");
}

}  // namespace swivel::formats
