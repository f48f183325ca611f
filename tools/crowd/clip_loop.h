// SPDX-License-Identifier: MIT
//
// A clip that is played over and over: the frames that a loop goes on between, and the clip as it goes on. Knows clips
// alone.
#pragma once

#include <cstddef>

#include "tools/formats/clip.h"

namespace swivel::tools {

// Frames of a clip. After the one before `last`, `first` follows.
struct ClipLoop {
    std::size_t first = 0, last = 0;

    std::size_t length() const { return last - first; }
};

inline constexpr std::size_t kMostSearched = 20'000;  // frames
inline constexpr std::size_t kFewestLooped = 2;       // frames of a loop, however long each takes
inline constexpr double kShortestLoop = 0.5;          // seconds
inline constexpr double kSeam = 0.15;                 // seconds in which what differs at the seam fades

struct FoundLoop {
    ClipLoop loop;
    double gap;  // between its two frames, of a joint's pose and motion: radians, the root of the mean square
};

// Among all pairs of frames that are kShortestLoop and kFewestLooped or more apart, the two whose pose and motion
// differ least. Pose is how joints are turned, motion how they go on turning in 1/30 s. Which way the body is turned
// about y does not count. Without two such frames the whole clip is the loop, and the gap infinite. body: a joint that
// all others move with, such as the hips. The clip has frame_time > 0 and 2 frames or more. Takes time in the square of
// the frames.
FoundLoop find_loop(const formats::Clip& clip, int body);

// The clip as it goes on for so many frames from `first` on. Every time round, what lies in the world goes on from
// where it was, moved along x and z and turned about y. What still differs at the seam fades in kSeam.
formats::Clip looped(const formats::Clip& clip, int body, const ClipLoop& loop, std::size_t frame_count);

}  // namespace swivel::tools
