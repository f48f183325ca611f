// SPDX-License-Identifier: MIT
//
// Looped clips, and the search for a clip's loop. Knows clips alone.
#pragma once

#include <cstddef>

#include "tools/formats/clip.h"

namespace swivel::tools {

// Frames first to last - 1 of a clip, after which `first` follows again.
struct ClipLoop {
    std::size_t first = 0, last = 0;

    std::size_t length() const { return last - first; }
};

inline constexpr std::size_t kFewestLooped = 2;  // frames of a loop, however long each takes
inline constexpr double kSeam = 0.15;            // seconds in which the seam's difference fades

// The looped clip for this many frames from `first` on. body: a joint that all others move with, such as the hips. Each
// round goes on from where the last one ended, moved along x and z and turned about y. The remaining difference at the
// seam fades in kSeam.
formats::Clip looped(const formats::Clip& clip, int body, const ClipLoop& loop, std::size_t frame_count);

inline constexpr std::size_t kMaxSearched = 100'000;  // frames
inline constexpr double kShortestLoop = 0.5;          // seconds
inline constexpr double kLongEnough = 1;              // seconds: no loop needs to be longer
inline constexpr double kMinPace = 0.5;               // of a loop, as a share of the clip's
inline constexpr double kWideGap = 0.17;              // 10 degrees: walks, jumps and boxing come back to within 9

struct FoundLoop {
    ClipLoop loop;
    // Between its two frames, of a joint's pose and motion: radians, the root of the mean square. Joints that never
    // turn do not count.
    double gap;
};

// The pair of frames whose pose and motion differ least, nearly, among all pairs that are far enough apart and between
// which the clip moves. Each frame is compared with some thousands of the most similar ones. The pose is the joints'
// rotations, the motion their change in the next 1/30 s. The body's turn about y does not count.
// - Far enough is half the clip, but at least kShortestLoop and kFewestLooped, and at most kLongEnough.
// - The clip moves if joints turn at kMinPace of its own pace or faster, in the mean. Its pace is the root of the
//   mean square of all seconds' mean speeds, so that a long rest counts little.
// - Of loops whose gap is below 0.001 the shortest is taken.
// Without two such frames the whole clip is the loop, and the gap infinite. body: a joint that all others move with,
// such as the hips. The clip has frame_time > 0 and 2 frames or more. Takes 0.5 s for 16,000 frames of 31 joints,
// and 3 s for 100,000, whatever they hold.
FoundLoop find_loop(const formats::Clip& clip, int body);

}  // namespace swivel::tools
