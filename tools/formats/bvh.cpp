// SPDX-License-Identifier: MIT
#include "tools/formats/bvh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/formats/error.h"
#include "tools/formats/euler.h"
#include "tools/formats/limits.h"
#include "tools/formats/printable.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

constexpr std::size_t kMaxDepth = 1000;  // no skeleton is deeper; paths of names stay printable
constexpr std::int64_t kMaxChannels = 6;
constexpr double kMaxDegrees = 1e9;                      // of which a double's last digit is 1e-7 degrees
constexpr std::size_t kMaxPoses = std::size_t{1} << 28;  // frames times joints: 8 GiB of quaternions

// Reads the text word by word and counts lines.
struct Scanner {
    const std::filesystem::path& path;  // for messages
    std::string_view text;              // not empty
    std::size_t at = 0;                 // the byte to read next
    std::size_t line = 1;               // of that byte
};

// Throws InputError for the current line.
[[noreturn]] void fail(const Scanner& scan, std::string_view cause) { throw InputError(scan.path, scan.line, cause); }

// The same, saying that `found` stands in place of `wanted`. Empty `found`: the file has ended.
[[noreturn]] void fail_expected(const Scanner& scan, std::string_view wanted, std::string_view found)
{
    if (found.empty()) fail(scan, fmt::format("the file ends where {} should be; is it cut short?", wanted));
    fail(scan,
         fmt::format("'{}' where {} should be; correct it, or export the clip as BVH again", printable(found), wanted));
}

// Goes on to byte `place`, counting lines. The end of the file counts as part of its last line.
void skip_to(Scanner& scan, std::size_t place)
{
    const std::size_t counted = std::max(std::min(place, scan.text.size() - 1), scan.at);
    const std::string_view passed = scan.text.substr(scan.at, counted - scan.at);
    scan.line += static_cast<std::size_t>(std::count(passed.begin(), passed.end(), '\n'));
    scan.at = place;
}

// The next word, brace, or label with its colon; empty at the end of the file.
std::string_view next_token(Scanner& scan)
{
    const std::size_t begin = std::min(scan.text.find_first_not_of(kBlanks, scan.at), scan.text.size());
    skip_to(scan, begin);
    std::size_t end = std::min(scan.text.find_first_of(" \t\r\n\v\f{}:", begin), scan.text.size());
    const bool takes_stop = end < scan.text.size() && (scan.text[end] == ':' || end == begin);
    if (takes_stop) ++end;
    scan.at = end;
    return scan.text.substr(begin, end - begin);
}

// The rest of the line, up to a brace, without blanks at the ends.
std::string_view rest_of_line(Scanner& scan)
{
    const std::size_t end = std::min(scan.text.find_first_of("\n{}", scan.at), scan.text.size());
    const std::string_view rest = scan.text.substr(scan.at, end - scan.at);
    scan.at = end;
    return trimmed(rest);
}

// Takes the next token, which must be `word` in any case.
void expect(Scanner& scan, std::string_view word)
{
    const std::string_view token = next_token(scan);
    if (!same_ignoring_case(token, word)) fail_expected(scan, word, token);
}

// A joint whose closing brace has not come yet.
struct OpenJoint {
    std::size_t joint;
    bool has_offset = false;
    bool has_channels = false;
    bool has_child = false;
};

Eigen::Vector3d read_offset(Scanner& scan)
{
    std::string_view rest = rest_of_line(scan);
    Eigen::Vector3d offset;
    for (double& value : offset) {
        const std::string_view word = take_word(rest);
        if (word.empty()) fail(scan, "OFFSET has fewer than three numbers");
        const std::optional<double> number = parse_number(word);
        if (!number) fail(scan, fmt::format("OFFSET: '{}' is not a finite decimal number", printable(word)));
        if (!(std::abs(*number) <= kMaxNorm))
            fail(scan, fmt::format("OFFSET: {:g} is more than {:g}; correct it", *number, kMaxNorm));
        value = *number;
    }
    if (!take_word(rest).empty()) fail(scan, "OFFSET has more than three numbers");
    return offset;
}

Channel parse_channel(const Scanner& scan, std::string_view word)
{
    for (std::size_t i = 0; i < kChannelNames.size(); ++i) {
        if (same_ignoring_case(word, kChannelNames[i])) return static_cast<Channel>(i);
    }
    fail(scan, fmt::format("unknown channel '{}'; known are Xposition to Zposition and Xrotation to Zrotation",
                           printable(word)));
}

std::vector<Channel> read_channels(Scanner& scan)
{
    std::string_view rest = rest_of_line(scan);
    const std::string_view count_word = take_word(rest);
    const std::optional<std::int64_t> count = parse_integer(count_word);
    if (!count || *count < 0 || *count > kMaxChannels) {
        fail(scan, fmt::format("CHANNELS: '{}' is not a count from 0 to 6", printable(count_word)));
    }
    std::vector<Channel> channels;
    for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
        const Channel channel = parse_channel(scan, word);
        const bool repeats = std::find(channels.begin(), channels.end(), channel) != channels.end();
        if (repeats && is_position(channel)) fail(scan, fmt::format("CHANNELS names {} twice", word));
        channels.push_back(channel);
    }
    if (channels.size() != static_cast<std::size_t>(*count)) {
        fail(scan, fmt::format("CHANNELS announces {} and names {}", *count, channels.size()));
    }
    return channels;
}

void open_joint(Scanner& scan, BvhFile& file, std::vector<OpenJoint>& open)
{
    if (open.size() == kMaxDepth) fail(scan, fmt::format("more than {} joints inside each other", kMaxDepth));
    Joint joint;
    const std::size_t name_begin = scan.at;
    joint.name = rest_of_line(scan);
    if (joint.name.empty()) fail(scan, "a joint without a name");
    file.joints.push_back({{}, file.channel_count, scan.line, name_begin});
    if (!open.empty()) {
        joint.parent = static_cast<int>(open.back().joint);
        open.back().has_child = true;
    }
    open.push_back({file.clip.joints.size()});
    joint.number = static_cast<int>(file.clip.joints.size());
    file.clip.joints.push_back(std::move(joint));
    expect(scan, "{");
}

// An end site is a point to draw to, and no joint.
Eigen::Vector3d read_end_site(Scanner& scan)
{
    rest_of_line(scan);
    expect(scan, "{");
    expect(scan, "OFFSET");
    const Eigen::Vector3d offset = read_offset(scan);
    expect(scan, "}");
    return offset;
}

void add_channels(Scanner& scan, BvhFile& file, std::size_t joint)
{
    BvhJoint& at = file.joints[joint];
    at.channels = read_channels(scan);
    at.line = scan.line;
    file.channel_count += at.channels.size();
    if (std::any_of(at.channels.begin(), at.channels.end(), is_position)) {
        file.clip.joints[joint].track = static_cast<int>(file.clip.track_count++);
    }
}

// One member of the innermost open joint. OFFSET and CHANNELS come before the children, each once: values in a
// frame's line follow the order of CHANNELS in the file.
void read_member(Scanner& scan, BvhFile& file, std::vector<OpenJoint>& open)
{
    const std::string_view token = next_token(scan);
    OpenJoint& inner = open.back();
    if (same_ignoring_case(token, "JOINT")) {
        open_joint(scan, file, open);
    } else if (same_ignoring_case(token, "End")) {
        file.clip.joints[inner.joint].end = read_end_site(scan);
        inner.has_child = true;
    } else if (same_ignoring_case(token, "OFFSET") && !inner.has_offset && !inner.has_child) {
        file.clip.joints[inner.joint].offset = read_offset(scan);
        inner.has_offset = true;
    } else if (same_ignoring_case(token, "CHANNELS") && !inner.has_channels && !inner.has_child) {
        add_channels(scan, file, inner.joint);
        inner.has_channels = true;
    } else if (token == "}") {
        const std::string& name = file.clip.joints[inner.joint].name;
        if (!inner.has_offset) fail(scan, fmt::format("joint '{}' has no OFFSET", printable(name)));
        file.joints[inner.joint].end = scan.at;
        open.pop_back();
    } else {
        fail_expected(scan, "OFFSET or CHANNELS (once, before children), JOINT, End Site or }", token);
    }
}

// Reads from HIERARCHY through the word MOTION into the joints of `file` and of its clip, and counts the channels.
// Keeps its own stack, so nesting cannot exhaust the program's.
void read_hierarchy(Scanner& scan, BvhFile& file)
{
    expect(scan, "HIERARCHY");
    std::vector<OpenJoint> open;
    for (;;) {
        if (!open.empty()) {
            read_member(scan, file, open);
            continue;
        }
        const std::string_view token = next_token(scan);
        const bool has_joints = !file.clip.joints.empty();
        if (has_joints && same_ignoring_case(token, "MOTION")) return;
        if (!same_ignoring_case(token, "ROOT")) fail_expected(scan, has_joints ? "ROOT or MOTION" : "ROOT", token);
        open_joint(scan, file, open);
    }
}

void read_motion_header(Scanner& scan, BvhFile& file)
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
}

// Makes room for the frames that the rest of the text can hold, at two bytes a value, whatever the file announces.
void reserve_frames(const Scanner& scan, BvhFile& file)
{
    Clip& clip = file.clip;
    const std::size_t max = (scan.text.size() - scan.at) / (2 * file.channel_count) + 1;
    const std::size_t frame_count = std::min(file.announced_count, max);
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

// One frame a line. Lines beyond those announced are checked and left out.
void read_frames(Scanner& scan, BvhFile& file)
{
    std::vector<double> values(file.channel_count);
    while (scan.at < scan.text.size()) {
        const std::size_t end = std::min(scan.text.find('\n', scan.at), scan.text.size());
        const std::string_view line = scan.text.substr(scan.at, end - scan.at);
        const bool is_surplus = file.clip.frame_count == file.announced_count;
        if (!trimmed(line).empty()) {
            parse_values(scan, file, line, values);
            if (is_surplus) {
                ++file.surplus_count;
            } else {
                file.frame_begin.push_back(scan.at);
                append_frame(file, values);
            }
        }
        skip_to(scan, std::min(end + 1, scan.text.size()));
    }
    if (file.clip.frame_count != file.announced_count) {
        fail(scan, fmt::format("the file ends after {} of the {} frames announced in line {}; is it cut short?",
                               file.clip.frame_count, file.announced_count, file.frames_line));
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
    read_motion_header(scan, file);
    reserve_frames(scan, file);
    read_frames(scan, file);
    return file;
}

bool is_bvh_text(std::string_view text)
{
    text = without_byte_order_mark(text);
    return same_ignoring_case(take_word(text), "HIERARCHY");
}

}  // namespace swivel::formats
