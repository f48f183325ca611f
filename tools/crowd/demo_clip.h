// SPDX-License-Identifier: MIT
//
// A made-up figure and its motion, for the demo: it sways, bends its knees and swings its arms in loops. Knows clips
// alone.
#pragma once

#include "tools/formats/clip.h"

namespace swivel::tools {

// The first frames, 1 to 240, of a loop of 240; 60 a second. Metres, y up; the figure stands at the origin, faces +z
// and rests in a T-pose.
formats::Clip demo_clip(std::size_t frame_count);

constexpr std::size_t kDemoFrames = 240;  // of the whole loop

}  // namespace swivel::tools
