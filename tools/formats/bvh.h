#pragma once
// SPDX-License-Identifier: MIT
// BVH motion files. Reading keeps the file's text; writing puts new keys into that text and leaves every other byte
// as it was. Conventions:
// - Rotation channels are degrees, multiplied in the order listed: Zrotation Yrotation Xrotation is Rz Ry Rx.
// - A position channel takes the place of that component of OFFSET, at roots and inner joints alike, as Blender and
//   assimp read it. An old note on the format adds the two at the root. In files in use, the offset there is zero, or
//   it repeats the first frame's position.
// - One frame is one line, as the format says. A line with another number of values is refused, because wrapped lines
//   look like lost values. Blank lines are skipped. Lines beyond the count after "Frames:" are checked and left out, as
//   other readers do, because some exporters count the steps between frames.
// - Keywords may be in any case, and lines may end in LF or CRLF. Names may repeat and hold anything but braces. There
//   may be several ROOTs, and joints without CHANNELS.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/formats/clip.h"
#include "tools/formats/joint_keys.h"

namespace swivel::formats {

enum class Channel : std::uint8_t { Xposition, Yposition, Zposition, Xrotation, Yrotation, Zrotation };

constexpr std::array<std::string_view, 6> kChannelNames = {"Xposition", "Yposition", "Zposition",
                                                           "Xrotation", "Yrotation", "Zrotation"};

constexpr bool is_position(Channel channel) { return channel <= Channel::Zposition; }

// 0, 1, 2 for x, y, z.
constexpr int axis_of(Channel channel) { return static_cast<int>(channel) % 3; }

struct BvhJoint {
    std::vector<Channel> channels;  // in the file's order, at most six
    std::size_t first_channel = 0;  // the joint's first value in a frame's line
    std::size_t line = 0;           // of CHANNELS, or of the joint if it has none; for messages
    std::size_t name_begin = 0;     // byte in the text after ROOT or JOINT, where the name follows
    std::size_t end = 0;            // byte in the text after the joint's closing brace
};

struct BvhFile {
    std::filesystem::path path;            // where it was read; for messages
    std::string text;                      // the whole file
    std::size_t motion_begin = 0;          // byte in `text` after MOTION, where "Frames:" follows
    std::vector<std::size_t> frame_begin;  // byte in `text` where each frame's line starts
    std::vector<BvhJoint> joints;          // same order as clip.joints
    std::size_t channel_count = 0;         // values a line
    std::size_t frames_line = 0;           // of "Frames:"; for messages
    std::size_t surplus_count = 0;         // lines of values beyond those announced
    std::size_t announced_count = 0;       // the number after "Frames:" in the file that was read
    Clip clip;
};

// Reads and checks a whole file. Throws InputError with the line for anything malformed, a number that is not finite, a
// wrong count of values or frames, more than 1,000 joints inside each other, or poses beyond 8 GiB.
// Holds the text once, and 32 bytes a frame and joint. The announced count of frames allocates nothing.
BvhFile read_bvh(const std::filesystem::path& path);

// The same for a text in memory. path: its name in messages.
BvhFile bvh_of(const std::filesystem::path& path, std::string text);

// The file at another number of frames a second, above 0. Its first and last frame stay, so the rate is the nearest one
// that fits the clip's length. Joints with rotation channels of three axes turn evenly, the shortest way (slerp); all
// other values go evenly, angles the shorter way around. Throws InputError for a text of more than 2 GiB.
BvhFile at_rate(const BvhFile& file, double rate);

// Whether a text starts like a BVH file.
bool is_bvh_text(std::string_view text);

// Throws InputError, as write_bvh() does, for a joint that cannot take new rotations.
void require_can_key(const BvhFile& file, int joint);

// Writes `file` with the channels of these keys replaced; all other text is copied byte for byte, so without keys the
// copy is identical. With new frames only the hierarchy is copied, and all other channels rest: angles are 0, positions
// the OFFSET. Numbers have nine decimals, which keep rotations within 1e-9 rad. Angles are continuous: each triple is
// the one nearest to the frame before, the first to the file's own, or to 0 in new frames. path: may be the file that
// was read. It appears whole or not at all (see OutputFile). Throws InputError when a joint with new rotations lacks
// three rotation channels about three different axes, one with new translations a position channel of each axis, or on
// writing. Throws std::invalid_argument as require_keys() does. Allocates a few bytes a channel. With a new joint it
// allocates the whole file again, and leaves out lines beyond those announced.
void write_bvh(const std::filesystem::path& path, const BvhFile& file, std::span<const JointKeys> keys,
               const std::optional<NewFrames>& frames = {}, const std::optional<NewJoint>& above = {});

}  // namespace swivel::formats
