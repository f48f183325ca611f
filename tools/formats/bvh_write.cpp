// SPDX-License-Identifier: MIT
#include "tools/formats/bvh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include "tools/formats/error.h"
#include "tools/formats/euler.h"
#include "tools/formats/output_file.h"
#include "tools/formats/printable.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

constexpr int kKept = -1;

// One joint's keys, to be written into the text.
struct Track {
    const JointKeys& keys;
    EulerAxes axes{};
    Eigen::Vector3d angle_deg = Eigen::Vector3d::Zero();  // of the frame written last; before the first the file's own
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
};

struct Plan {
    std::vector<Track> tracks;
    std::vector<int> slot;  // per channel of a line: kSlots * track and then angle 0 to 2 or place 3 to 5, or kKept
};
constexpr int kSlots = 6;

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

// In the order of the joint's rotation channels.
EulerAxes axes_of(const BvhFile& file, int joint)
{
    const BvhJoint& at = file.joints[static_cast<std::size_t>(joint)];
    const auto require = [&](bool is_met, std::string_view cause) {
        if (!is_met) refuse(file, joint, "rotation", cause);
    };
    EulerAxes axes{};
    int count = 0;
    for (const Channel channel : at.channels) {
        if (is_position(channel)) continue;
        require(count < 3, "it has more than three rotation channels");
        axes[static_cast<std::size_t>(count++)] = axis_of(channel);
    }
    require(count == 3, "it has fewer than three rotation channels");
    require(axes[0] != axes[1] && axes[1] != axes[2] && axes[0] != axes[2], "its rotation channels repeat an axis");
    return axes;
}

// Plans the joint's rotation channels as the track's angles.
void claim_angles(const BvhFile& file, int joint, int first_slot, Plan& plan)
{
    const BvhJoint& at = file.joints[static_cast<std::size_t>(joint)];
    int angle = 0;
    for (std::size_t c = 0; c < at.channels.size(); ++c)
        if (!is_position(at.channels[c])) plan.slot[at.first_channel + c] = first_slot + angle++;
}

// The same of its position channels.
void claim_places(const BvhFile& file, int joint, int first_slot, Plan& plan)
{
    const BvhJoint& at = file.joints[static_cast<std::size_t>(joint)];
    for (const Channel axis : {Channel::Xposition, Channel::Yposition, Channel::Zposition})
        if (std::ranges::find(at.channels, axis) == at.channels.end())
            refuse(file, joint, "position", "it has fewer than three position channels");
    for (std::size_t c = 0; c < at.channels.size(); ++c)
        if (is_position(at.channels[c])) plan.slot[at.first_channel + c] = first_slot + 3 + axis_of(at.channels[c]);
}

Plan make_plan(const BvhFile& file, std::span<const JointKeys> keys)
{
    Plan plan;
    plan.slot.assign(file.channel_count, kKept);
    for (const JointKeys& each : keys) {
        const int first_slot = kSlots * static_cast<int>(plan.tracks.size());
        Track track{each};
        if (!each.rotation.empty()) {
            track.axes = axes_of(file, each.joint);
            claim_angles(file, each.joint, first_slot, plan);
        }
        if (!each.translation.empty()) claim_places(file, each.joint, first_slot, plan);
        plan.tracks.push_back(track);
    }
    return plan;
}

double& value_of(Plan& plan, int slot)
{
    Track& track = plan.tracks[static_cast<std::size_t>(slot / kSlots)];
    return slot % kSlots < 3 ? track.angle_deg[slot % kSlots] : track.place[slot % kSlots - 3];
}

// The file's own angles in its first frame, which the reader has checked.
void start_from_file(const BvhFile& file, Plan& plan)
{
    std::string_view rest = std::string_view(file.text).substr(file.frame_begin.front());
    for (const int slot : plan.slot) {
        const std::string_view word = take_word(rest);
        if (slot != kKept) value_of(plan, slot) = parse_number(word).value();
    }
}

void take_frame(Plan& plan, std::size_t frame)
{
    for (Track& track : plan.tracks) {
        if (!track.keys.rotation.empty())
            track.angle_deg = nearest_euler(track.keys.rotation[frame].normalized(), track.axes, track.angle_deg);
        if (!track.keys.translation.empty()) track.place = track.keys.translation[frame];
    }
}

// Writes the text from `done` through the last new value of the frame at `begin`, and copies the text between new
// values.
std::size_t write_frame(OutputFile& out, std::string_view text, std::size_t begin, std::size_t done, Plan& plan)
{
    std::string_view rest = text.substr(begin);
    for (const int slot : plan.slot) {
        const std::string_view word = take_word(rest);
        if (slot == kKept) continue;
        const auto word_begin = static_cast<std::size_t>(word.data() - text.data());
        out.write(text.substr(done, word_begin - done));
        out.write(value_text(value_of(plan, slot)));
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
    out.write(fmt::format("\nFrames: {}\nFrame Time: {}\n", frames.count, frames.frame_time));
    const std::string line = rest_line(file);
    for (std::size_t frame = 0; frame < frames.count; ++frame) {
        take_frame(plan, frame);
        const std::size_t done = write_frame(out, line, 0, 0, plan);
        out.write(std::string_view(line).substr(done));
    }
}

}  // namespace

std::string value_text(double value)
{
    const double shown = std::abs(value) < 5e-10 ? 0.0 : value;  // no "-0.000000000"
    return fmt::format("{:.9f}", shown);
}

void require_can_key(const BvhFile& file, int joint) { axes_of(file, joint); }

void write_bvh(const std::filesystem::path& path, const BvhFile& file, std::span<const JointKeys> keys,
               const std::optional<NewFrames>& frames, const std::optional<NewJoint>& above)
{
    if (above) {  // takes the number of the joint below it, and that one and all later ones the next
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
