// SPDX-License-Identifier: MIT
//
// Judges a clip alone, as a viewer would: its body, where it goes, whether feet skate, knees snap and joints tremble.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tools/rig/limbs.h"
#include "tools/swivel/motion_file.h"

namespace swivel::tools {

// The file, its verdict (good, look or garbage), the doubts, and what the clip holds, in centimetres and degrees.
// Doubts are those of clip_doubts(), and
// - garbage: no limb binds; if some do, a limb that does not is a doubt;
// - legs below 0.2 m or above 2.5 m in a file of metres;
// - some frames, not all, are a T-pose: arms aside and legs down, within 25 degrees;
// - it glides, see slide_of();
// - a foot skates above 0.3 leg lengths a second in the mean of its contacts; recorded feet are at 0.2;
// - a toe is under the floor by 0.085 leg lengths, by which others may be over it and in contact;
// - a knee turns by four times as much as in the frames beside that, and above 720 degrees a second;
// - a joint trembles by a degree, at 49 frames a second or more. Recorded joints are at 0.7; toes are left out.
// Root, feet, knees, noise and loop are told of three even frames or more. search: of bind_limbs() for `figure`.
nlohmann::ordered_json inspection_of(const std::string& name, const MotionFile& file, const FigureJoints& figure,
                                     const LimbSearch& search);

}  // namespace swivel::tools
