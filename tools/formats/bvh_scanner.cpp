// SPDX-License-Identifier: MIT
#include "tools/formats/bvh_scanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/formats/error.h"
#include "tools/formats/limits.h"
#include "tools/formats/printable.h"
#include "tools/formats/text.h"

namespace swivel::formats {

namespace {

constexpr std::size_t kMaxDepth = 1000;  // no skeleton is deeper; paths of names stay printable
constexpr std::int64_t kMaxChannels = 6;

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

void close_joint(const Scanner& scan, BvhFile& file, std::vector<OpenJoint>& open)
{
    file.joints[open.back().joint].end = scan.at;
    const std::string& name = file.clip.joints[open.back().joint].name;
    if (!open.back().has_offset) fail(scan, fmt::format("joint '{}' has no OFFSET", printable(name)));
    open.pop_back();
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
        close_joint(scan, file, open);
    } else {
        fail_expected(scan, "OFFSET or CHANNELS (once, before children), JOINT, End Site or }", token);
    }
}

constexpr std::string_view kTokenEnds = " \t\r\n\v\f{}:";

}  // namespace

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

std::string_view next_token(Scanner& scan)
{
    const std::size_t begin = std::min(scan.text.find_first_not_of(kBlanks, scan.at), scan.text.size());
    skip_to(scan, begin);
    std::size_t end = std::min(scan.text.find_first_of(kTokenEnds, begin), scan.text.size());
    const bool takes_stop = end < scan.text.size() && (scan.text[end] == ':' || end == begin);
    if (takes_stop) ++end;
    scan.at = end;
    return scan.text.substr(begin, end - begin);
}

std::string_view rest_of_line(Scanner& scan)
{
    const std::size_t end = std::min(scan.text.find_first_of("\n{}", scan.at), scan.text.size());
    const std::string_view rest = scan.text.substr(scan.at, end - scan.at);
    scan.at = end;
    return trimmed(rest);
}

void skip_to(Scanner& scan, std::size_t place)
{
    const std::size_t counted = std::max(std::min(place, scan.text.size() - 1), scan.at);
    const std::string_view passed = scan.text.substr(scan.at, counted - scan.at);
    scan.line += static_cast<std::size_t>(std::count(passed.begin(), passed.end(), '\n'));
    scan.at = place;
}

void expect(Scanner& scan, std::string_view word)
{
    const std::string_view token = next_token(scan);
    if (!same_ignoring_case(token, word)) fail_expected(scan, word, token);
}

void fail(const Scanner& scan, std::string_view cause) { throw InputError(scan.path, scan.line, cause); }

void fail_expected(const Scanner& scan, std::string_view wanted, std::string_view found)
{
    if (found.empty()) fail(scan, fmt::format("the file ends where {} should be; is it cut short?", wanted));
    fail(scan,
         fmt::format("'{}' where {} should be; correct it, or export the clip as BVH again", printable(found), wanted));
}

}  // namespace swivel::formats
