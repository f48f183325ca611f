// SPDX-License-Identifier: MIT
// A BVH file's text made anew: with new keys, with one more joint, or at another rate.
#include "tools/formats/bvh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "tools/formats/error.h"
#include "tools/formats/euler.h"
#include "tools/formats/output_file.h"
#include "tools/formats/printable.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

constexpr double kMaxTextBytes = 0x1p31;  // of a text, as readers have it
constexpr double kValueBytes = 12;        // of a value of nine decimals and a blank, at least

// One joint's keys, to be written into the text.
struct Track {
    const JointKeys& keys;
    EulerAxes axes{};
    Eigen::Vector3d angle_deg = Eigen::Vector3d::Zero();  // of the frame written last; before the first the file's own
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
};

struct Plan {
    std::vector<Track> tracks;
    std::vector<double*> values;  // per channel of a line: its new value, in a track; null: the channel keeps its text
};

[[noreturn]] void refuse(const BvhFile& file, int joint, std::string_view what, std::string_view cause)
{
    const auto at = static_cast<std::size_t>(joint);
    const std::string name = printable(file.clip.joints[at].name);
    throw InputError(
        file.path, file.joints[at].line,
        fmt::format("joint '{0}' cannot take a new {1}: {2}; export the clip with three {1} channels for it, "
                    "of X, Y and Z",
                    name, what, cause));
}

// The axes of a joint's rotation channels, in their order.
std::vector<int> rotation_axes(const BvhJoint& joint)
{
    std::vector<int> axes;
    for (const Channel channel : joint.channels)
        if (!is_position(channel)) axes.push_back(axis_of(channel));
    return axes;
}

bool are_different(const std::vector<int>& axes)
{
    return axes[0] != axes[1] && axes[1] != axes[2] && axes[0] != axes[2];
}

EulerAxes axes_of(const BvhFile& file, int joint)
{
    const std::vector<int> axes = rotation_axes(file.joints[static_cast<std::size_t>(joint)]);
    if (axes.size() > 3) refuse(file, joint, "rotation", "it has more than three rotation channels");
    if (axes.size() < 3) refuse(file, joint, "rotation", "it has fewer than three rotation channels");
    if (!are_different(axes)) refuse(file, joint, "rotation", "its rotation channels repeat an axis");
    return {axes[0], axes[1], axes[2]};
}

void require_positions(const BvhFile& file, int joint)
{
    const BvhJoint& at = file.joints[static_cast<std::size_t>(joint)];
    for (const Channel axis : {Channel::Xposition, Channel::Yposition, Channel::Zposition})
        if (std::ranges::find(at.channels, axis) == at.channels.end())
            refuse(file, joint, "position", "it has fewer than three position channels");
}

Plan make_plan(const BvhFile& file, std::span<const JointKeys> keys)
{
    Plan plan;
    plan.values.resize(file.channel_count);
    plan.tracks.reserve(keys.size());  // so that they stay where their values point
    for (const JointKeys& each : keys) {
        Track& track = plan.tracks.emplace_back(Track{each});
        if (!each.rotation.empty()) track.axes = axes_of(file, each.joint);
        if (!each.translation.empty()) require_positions(file, each.joint);
        const BvhJoint& joint = file.joints[static_cast<std::size_t>(each.joint)];
        int angle = 0;
        for (std::size_t c = 0; c < joint.channels.size(); ++c) {
            double*& value = plan.values[joint.first_channel + c];
            if (is_position(joint.channels[c]))
                value = each.translation.empty() ? nullptr : &track.place[axis_of(joint.channels[c])];
            else
                value = each.rotation.empty() ? nullptr : &track.angle_deg[angle++];
        }
    }
    return plan;
}

// The values of a frame's line, which the reader has checked.
std::vector<double> values_of(const BvhFile& file, std::size_t frame)
{
    std::string_view rest = std::string_view(file.text).substr(file.frame_begin[frame]);
    std::vector<double> values;
    while (values.size() < file.channel_count) values.push_back(parse_number(take_word(rest)).value());
    return values;
}

// The file's own angles in its first frame.
void start_from_file(const BvhFile& file, Plan& plan)
{
    const std::vector<double> values = values_of(file, 0);
    for (std::size_t n = 0; n < values.size(); ++n)
        if (plan.values[n]) *plan.values[n] = values[n];
}

void take_frame(Plan& plan, std::size_t frame)
{
    for (Track& track : plan.tracks) {
        if (!track.keys.rotation.empty())
            track.angle_deg = nearest_euler(track.keys.rotation[frame].normalized(), track.axes, track.angle_deg);
        if (!track.keys.translation.empty()) track.place = track.keys.translation[frame];
    }
}

// A value of a frame's line, with nine decimals; of a degree they are 9e-12 rad.
std::string value_text(double value)
{
    const double shown = std::abs(value) < 5e-10 ? 0.0 : value;  // no "-0.000000000"
    return fmt::format("{:.9f}", shown);
}

// The lines after MOTION.
std::string frames_text(std::size_t count, double frame_time)
{
    return fmt::format("\nFrames: {}\nFrame Time: {}\n", count, frame_time);
}

// Writes the text from `done` through the last new value of the frame at `begin`, and copies the text between new
// values.
std::size_t write_frame(OutputFile& out, std::string_view text, std::size_t begin, std::size_t done, const Plan& plan)
{
    std::string_view rest = text.substr(begin);
    for (const double* const value : plan.values) {
        const std::string_view word = take_word(rest);
        if (!value) continue;
        const auto word_begin = static_cast<std::size_t>(word.data() - text.data());
        out.write(text.substr(done, word_begin - done));
        out.write(value_text(*value));
        done = word_begin + word.size();
    }
    return done;
}

void write_own_frames(OutputFile& out, const BvhFile& file, Plan& plan)
{
    const std::string_view text = file.text;
    std::size_t done = 0;
    start_from_file(file, plan);
    for (std::size_t frame = 0; frame < file.clip.frame_count && !plan.tracks.empty(); ++frame) {
        take_frame(plan, frame);
        done = write_frame(out, text, file.frame_begin[frame], done, plan);
    }
    out.write(text.substr(done));
}

// A frame's line in which every joint rests.
std::string rest_line(const BvhFile& file)
{
    std::string line;
    for (std::size_t n = 0; n < file.joints.size(); ++n)
        for (const Channel channel : file.joints[n].channels)
            line += fmt::format(
                "{}{}", line.empty() ? "" : " ",
                is_position(channel) ? pose_without_keys(file.clip.joints[n]).offset[axis_of(channel)] : 0.0);
    return line + '\n';
}

void write_new_frames(OutputFile& out, const BvhFile& file, const NewFrames& frames, Plan& plan)
{
    out.write(std::string_view(file.text).substr(0, file.motion_begin));
    out.write(frames_text(frames.count, frames.frame_time));
    const std::string line = rest_line(file);
    for (std::size_t frame = 0; frame < frames.count; ++frame) {
        take_frame(plan, frame);
        const std::size_t done = write_frame(out, line, 0, 0, plan);
        out.write(std::string_view(line).substr(done));
    }
}

// The file with a joint of six channels, all 0, put above one: see NewJoint. Lines beyond those announced are left out.
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

// The values at a time in frames of the file. before: of the line before, to which angles stay near.
std::vector<double> values_at(const BvhFile& file, double time, const std::vector<double>& before)
{
    const auto from = std::min(static_cast<std::size_t>(time), file.clip.frame_count - 1);
    const std::size_t next = std::min(from + 1, file.clip.frame_count - 1), joints = file.joints.size();
    const double share = time - static_cast<double>(from);
    std::vector<double> values = values_of(file, from);
    const std::vector<double> next_values = values_of(file, next);
    for (std::size_t joint = 0; joint < joints; ++joint) {
        std::vector<std::size_t> angles;  // their places in the line
        for (std::size_t c = 0; c < file.joints[joint].channels.size(); ++c) {
            const std::size_t at = file.joints[joint].first_channel + c;
            const bool is_angle = !is_position(file.joints[joint].channels[c]);
            if (is_angle) angles.push_back(at);
            const double change = next_values[at] - values[at];
            values[at] += share * (is_angle ? std::remainder(change, 360) : change);
        }
        const std::vector<int> axes = rotation_axes(file.joints[joint]);
        if (axes.size() != 3 || !are_different(axes)) continue;  // they cannot give the joint any rotation
        const Eigen::Quaterniond turn =
            file.clip.rotation[from * joints + joint].slerp(share, file.clip.rotation[next * joints + joint]);
        const Eigen::Vector3d near_deg(before[angles[0]], before[angles[1]], before[angles[2]]);
        const Eigen::Vector3d angles_deg = nearest_euler(turn.normalized(), {axes[0], axes[1], axes[2]}, near_deg);
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
    text += frames_text(static_cast<std::size_t>(steps) + 1, steps > 0 ? seconds / steps : clip.frame_time);
    std::vector<double> line = values_of(file, 0);
    for (double step = 0; step <= steps; ++step) {
        line = values_at(file, steps > 0 ? step * last / steps : 0, line);
        for (std::size_t n = 0; n < line.size(); ++n) text += (n > 0 ? " " : "") + value_text(line[n]);
        text += '\n';
    }
    BvhFile resampled = bvh_of(file.path, std::move(text));
    resampled.frames_line = file.frames_line;
    resampled.surplus_count = file.surplus_count, resampled.announced_count = file.announced_count;
    return resampled;
}

void require_can_key(const BvhFile& file, int joint) { axes_of(file, joint); }

void write_bvh(const std::filesystem::path& path, const BvhFile& file, std::span<const JointKeys> keys,
               const std::optional<NewFrames>& frames, const std::optional<NewJoint>& above)
{
    if (above) {
        make_plan(file, keys);  // refuses a joint that cannot take its keys, by the line of the file that was read
        // The new joint takes the number of the joint below it, and that one and all later ones the next.
        std::vector<JointKeys> all{{above->below, above->rotation, above->translation}};
        for (const JointKeys& each : keys)
            all.push_back({each.joint < above->below ? each.joint : each.joint + 1, each.rotation, each.translation});
        return write_bvh(path, with_joint_above(file, above->below, above->name), all, frames);
    }
    require_keys(file.clip, keys, frames ? frames->count : file.clip.frame_count);
    Plan plan = make_plan(file, keys);
    OutputFile out(path);
    if (frames)
        write_new_frames(out, file, *frames, plan);
    else
        write_own_frames(out, file, plan);
    out.commit();
}

}  // namespace swivel::formats
