#pragma once
// SPDX-License-Identifier: MIT
// A glTF file's JSON text: what of it a reader of skeletons needs, and new keys put into it. Owns every rule about
// where things stand in that text; knows no clip.

#include <Eigen/Geometry>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "tools/formats/gltf_container.h"

namespace swivel::formats {

// The text without all that has nothing to do with nodes, skins and animations, so that no image or mesh, be it broken,
// gets in the way. Throws InputError for text that is no JSON object, is nested deeper than 500 levels, or says that
// its buffers are compressed.
std::string skeleton_json(const std::filesystem::path& path, std::string_view json);

struct GltfKeys {
    struct Track {
        int node = -1;
        std::vector<float> xyzw;  // 4 for each time
        // What the node's matrix, if it has one, is made of.
        Eigen::Vector3d translation, scale;
        Eigen::Quaterniond rotation;
    };
    std::vector<float> times;
    std::vector<Track> tracks;
    int animation = -1;  // -1: a new one
    bool is_stepped = false;
};

// The file with these keys, in the shape for a file at `to`: `binary` or not. from: where the file was read, for what
// lies beside it; buffers: their contents. Both must be as read: anything skeleton_json() refuses is undefined here.
// Throws InputError when the result is larger than a GLB can be.
GltfContainer with_keys(const GltfContainer& file, std::span<const std::string> buffers, const GltfKeys& keys,
                        const std::filesystem::path& from, const std::filesystem::path& to, bool binary);

}  // namespace swivel::formats
