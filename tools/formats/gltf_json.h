#pragma once
// SPDX-License-Identifier: MIT
// A glTF file's JSON text: what of it a reader of skeletons needs, and new keys and weights put into it. Owns every
// rule about where things stand in that text; knows no clip.

#include <Eigen/Geometry>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/formats/gltf_container.h"
#include "tools/formats/gltf_weights.h"

namespace swivel::formats {

// The text as a document. Throws InputError for text that is no JSON object or is nested deeper than 500 levels, for
// members that check_members() refuses, and if the document says that its buffers are compressed.
nlohmann::ordered_json gltf_document(const std::filesystem::path& path, std::string_view json);

// The files beside a glTF file that its buffers and images lie in, there or not. path: of the glTF file.
std::vector<std::filesystem::path> files_beside(const std::filesystem::path& path,
                                                const nlohmann::ordered_json& document);

// What of the document concerns nodes, skins and animations, as text and without buffers: no broken image or mesh gets
// in the reader's way.
std::string skeleton_json(const nlohmann::ordered_json& document);

// What a writer puts into a file.
struct GltfChanges {
    struct Track {
        int node = -1;
        std::vector<float> xyzw;  // 4 for each time
        bool is_stepped = false;  // STEP; else LINEAR
        // What the node's matrix, if it has one, is made of.
        Eigen::Vector3d translation, scale;
        Eigen::Quaterniond rotation;
    };
    std::vector<float> times;
    std::vector<Track> tracks;
    int animation = -1;  // -1: a new one
    std::span<const GltfWeights> weights;
};

// The file with these changes, in the shape for a file at `to`: `binary` or not. from: where the file was read, for
// what lies beside it; buffers: their contents. Both must be as read: anything gltf_document() refuses is undefined
// here. Throws InputError when the result is larger than a GLB can be.
GltfContainer with_changes(const GltfContainer& file, std::span<const std::string_view> buffers,
                           const GltfChanges& changes, const std::filesystem::path& from,
                           const std::filesystem::path& to, bool binary);

}  // namespace swivel::formats
