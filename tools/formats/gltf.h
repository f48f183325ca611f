#pragma once
// SPDX-License-Identifier: MIT
// glTF 2.0 and GLB. Reading takes the node hierarchy as a skeleton and one animation as its clip, and keeps the rest
// of the asset as it is; writing puts new rotations into that animation and leaves everything else alone. Conventions:
// - Every node is a joint, so that what lies above a skeleton (an armature with its scale) counts. Nodes that a skin
//   names are bones; in a file without skins all are. A joint's number is its node's index; an unnamed node is "#12".
// - The rest pose is the nodes' own transforms. A matrix is taken apart into translation, rotation and scale.
// - The animation's keys become frames. If all keys of nodes lie on one even grid, a frame is a key; otherwise it
//   is sampled evenly from its first key to its last, 60 times a second or at the rate asked for.
// - No animation: the clip is one frame, the rest pose, and writing adds an animation of one key.
// Images are neither decoded nor needed. Weights, visibility and other targets than nodes' own poses are kept, not
// read.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/formats/clip.h"
#include "tools/formats/gltf_container.h"
#include "tools/formats/gltf_sampler.h"

namespace swivel::formats {

enum class GltfPath : std::uint8_t { translation, rotation, scale };

struct GltfChannel {
    int joint = -1;  // of the clip
    GltfPath path = GltfPath::rotation;
    GltfSampler sampler;
};

struct GltfFile {
    std::filesystem::path path;                // where it was read
    GltfContainer container;                   // the whole file
    std::vector<std::string> buffers;          // contents of the file's buffers, wherever they are kept
    std::vector<std::string> animation_names;  // of all animations; may be empty or repeat
    int animation = -1;                        // which one `clip` is; -1: there is none
    std::vector<GltfChannel> channels;         // of that animation
    std::vector<float> times;                  // of the clip's frames, strictly increasing seconds
    Clip clip;
};

struct GltfChoice {
    std::string animation = {};  // name or, counted from 0, index; empty: the first
    double rate = 0;             // frames a second, 0: see above
};

// Reads and checks a whole file. Throws InputError for anything malformed that concerns the skeleton or the chosen
// animation, buffers that are missing or compressed, numbers that are not finite, an animation that does not exist or
// whose name is not unique, or poses beyond 8 GiB. Holds the file about twice, and 32 bytes a frame and joint.
GltfFile read_gltf(const std::filesystem::path& path, const GltfChoice& choice = {});

// The same of a file that is in memory already. path: what messages call it, and what its files lie beside.
GltfFile read_gltf(const std::filesystem::path& path, GltfContainer container, const GltfChoice& choice);

// Writes `file` with the rotations of the overridden joints replaced, keyed at the clip's frames: LINEAR, or STEP
// where the joints overridden moved by steps before. Where several frames' keys lie apart, a viewer turns each joint
// evenly in between. All other JSON is kept value by value, all buffers byte by byte; keys no longer used stay in them.
// Joints whose node has a matrix get translation, rotation and scale instead, as animated nodes must.
// path: .glb or .gltf, may be the file that was read; appears whole or not at all (see OutputFile). A .glb takes in the
// buffers and images that lie in files beside the .gltf; a .gltf holds the new keys itself and goes on
// using the same files, from wherever it is written.
// Throws InputError on writing, and for a joint whose matrix is sheared, which keys cannot say. Throws
// std::invalid_argument for a joint out of range or named twice, a wrong frame count, a zero or non-finite quaternion.
void write_gltf(const std::filesystem::path& path, const GltfFile& file, std::span<const RotationOverride> overrides);

}  // namespace swivel::formats
