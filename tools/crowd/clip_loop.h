// SPDX-License-Identifier: MIT
//
// A clip that is played over and over. Knows clips alone.
#pragma once

#include <cstddef>

#include "tools/formats/clip.h"

namespace swivel::tools {

// Frames of a clip. After the one before `last`, `first` follows.
struct ClipLoop {
    std::size_t first = 0, last = 0;

    std::size_t length() const { return last - first; }
};

inline constexpr std::size_t kFewestLooped = 2;  // frames of a loop, however long each takes
inline constexpr double kSeam = 0.15;            // seconds in which what differs at the seam fades

// Which way a body is turned about y in a frame. body: a joint that all others move with, such as the hips.
Eigen::Quaterniond heading_of(const formats::Clip& clip, std::size_t frame, int body);

// The clip as it goes on for so many frames from `first` on. Every time round, what lies in the world goes on from
// where it was, moved along x and z and turned about y. What still differs at the seam fades in kSeam.
formats::Clip looped(const formats::Clip& clip, int body, const ClipLoop& loop, std::size_t frame_count);

}  // namespace swivel::tools
