#pragma once
// SPDX-License-Identifier: MIT
// The frames of a glTF animation: which times they are at, and the skeleton's local poses there. Knows no JSON.

#include <cstddef>

#include "tools/formats/gltf.h"

namespace swivel::formats {

// Decoded keys and sampled poses may each take so much. A fuzzer's tiny files must not take long.
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
constexpr std::size_t kMostPoseBytes = std::size_t{1} << 20;
#else
constexpr std::size_t kMostPoseBytes = std::size_t{8} << 30;
#endif

// Fills file.times and everything of file.clip but its joints' names and rest poses, from file.channels; rate as in
// GltfChoice. Once a file. Throws InputError for more poses than kMostPoseBytes hold, or where a spline of rotations
// passes through zero.
void sample_frames(GltfFile& file, double rate);

}  // namespace swivel::formats
