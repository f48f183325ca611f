// SPDX-License-Identifier: MIT
// A BVH file's text made anew: at another rate, or with one more joint.
#include "tools/formats/bvh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "tools/formats/error.h"
#include "tools/formats/euler.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

constexpr double kMaxTextBytes = 0x1p31;  // of a text, as readers have it
constexpr double kValueBytes = 12;        // of a value of nine decimals and a blank, at least

// The axes of a joint's rotation channels, if these give it any rotation.
std::optional<EulerAxes> free_axes(const BvhJoint& joint)
{
    std::vector<int> axes;
    for (const Channel channel : joint.channels)
        if (!is_position(channel)) axes.push_back(axis_of(channel));
    std::vector<int> sorted = axes;
    std::ranges::sort(sorted);
    if (sorted != std::vector<int>{0, 1, 2}) return std::nullopt;
    return EulerAxes{axes[0], axes[1], axes[2]};
}

// The values of a frame's line, which the reader has checked.
std::vector<double> values_of(const BvhFile& file, std::size_t frame)
{
    std::string_view rest = std::string_view(file.text).substr(file.frame_begin[frame]);
    std::vector<double> values;
    while (values.size() < file.channel_count) values.push_back(parse_number(take_word(rest)).value());
    return values;
}

// The values at a time in frames of the file. before: of the line before, to which angles stay near.
std::vector<double> values_at(const BvhFile& file, double time, const std::vector<double>& before)
{
    const auto from = std::min(static_cast<std::size_t>(time), file.clip.frame_count - 1);
    const std::size_t to = std::min(from + 1, file.clip.frame_count - 1), joints = file.joints.size();
    const double share = time - static_cast<double>(from);
    std::vector<double> values = values_of(file, from);
    const std::vector<double> next = values_of(file, to);
    for (std::size_t joint = 0; joint < joints; ++joint) {
        std::vector<std::size_t> angles;  // their places in the line
        for (std::size_t c = 0; c < file.joints[joint].channels.size(); ++c) {
            const std::size_t at = file.joints[joint].first_channel + c;
            const bool is_angle = !is_position(file.joints[joint].channels[c]);
            if (is_angle) angles.push_back(at);
            values[at] += share * (is_angle ? std::remainder(next[at] - values[at], 360) : next[at] - values[at]);
        }
        const std::optional<EulerAxes> axes = free_axes(file.joints[joint]);
        if (!axes) continue;
        const Eigen::Quaterniond turn =
            file.clip.rotation[from * joints + joint].slerp(share, file.clip.rotation[to * joints + joint]);
        const Eigen::Vector3d near_deg(before[angles[0]], before[angles[1]], before[angles[2]]);
        const Eigen::Vector3d angles_deg = nearest_euler(turn.normalized(), *axes, near_deg);
        for (std::size_t n = 0; n < 3; ++n) values[angles[n]] = angles_deg[static_cast<Eigen::Index>(n)];
    }
    return values;
}

}  // namespace

BvhFile at_rate(const BvhFile& file, double rate)
{
    const Clip& clip = file.clip;
    const double last = static_cast<double>(clip.frame_count - 1), seconds = last * clip.frame_time;
    const double steps = clip.frame_count > 1 ? std::max(std::round(seconds * rate), 1.0) : 0;
    if (steps * kValueBytes * static_cast<double>(file.channel_count) > kMaxTextBytes)
        throw InputError(file.path,
                         fmt::format("{:.0f} frames of {} values take more than 2 GiB; give a lower --fps, or cut it",
                                     steps + 1, file.channel_count));
    std::string text = file.text.substr(0, file.motion_begin);
    text += fmt::format("\nFrames: {}\nFrame Time: {}\n", static_cast<std::size_t>(steps) + 1,
                        steps > 0 ? seconds / steps : clip.frame_time);
    std::vector<double> line = values_of(file, 0);
    for (double step = 0; step <= steps; ++step) {
        line = values_at(file, steps > 0 ? step * last / steps : 0, line);
        for (std::size_t n = 0; n < line.size(); ++n) text += (n > 0 ? " " : "") + value_text(line[n]);
        text += '\n';
    }
    BvhFile resampled = bvh_of(file.path, std::move(text));
    resampled.surplus_count = file.surplus_count, resampled.announced_count = file.announced_count;
    return resampled;
}

BvhFile with_joint_above(const BvhFile& file, int joint, std::string_view name)
{
    const BvhJoint& below = file.joints[static_cast<std::size_t>(joint)];
    const std::string_view text = file.text;
    std::string wider(text.substr(0, below.name_begin));  // through ROOT or JOINT
    wider += fmt::format(
        " {}\n{{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\nJOINT", name);
    wider += text.substr(below.name_begin, below.end - below.name_begin);
    wider += "\n}";
    std::size_t done = below.end;
    for (const std::size_t frame_begin : file.frame_begin) {
        std::string_view rest = text.substr(frame_begin);
        for (std::size_t n = 0; n < below.first_channel; ++n) take_word(rest);
        const auto word_begin = static_cast<std::size_t>(take_word(rest).data() - text.data());
        wider += text.substr(done, word_begin - done);
        wider += "0 0 0 0 0 0 ";
        done = word_begin;
    }
    const std::size_t line_end = std::min(text.find('\n', done), text.size() - 1);
    wider += text.substr(done, line_end + 1 - done);
    return bvh_of(file.path, std::move(wider));
}

}  // namespace swivel::formats
