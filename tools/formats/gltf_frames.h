#pragma once
// SPDX-License-Identifier: MIT
// The frames of a glTF animation: which times they are at, and the skeleton's local poses there. Knows no JSON.

#include "tools/formats/gltf.h"

namespace swivel::formats {

// Fills file.times and everything of file.clip but its joints' names and rest poses, from file.channels. Once a file.
// Throws InputError for more poses than choice.most_pose_bytes hold, or where a spline of rotations passes through
// zero.
void sample_frames(GltfFile& file, const GltfChoice& choice);

}  // namespace swivel::formats
