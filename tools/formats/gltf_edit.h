#pragma once
// SPDX-License-Identifier: MIT
// Puts new keys into a glTF file's JSON text and buffers. Owns every rule about places in that text; knows no skeleton.

#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/formats/clip.h"
#include "tools/formats/gltf_container.h"

namespace swivel::formats {

// The changes that a writer makes to a file.
struct GltfChanges {
    struct Track {
        int node = -1;
        std::vector<float> xyzw;  // rotations, 4 for each time; empty: no new ones
        std::vector<float> xyz;   // the same of translations, 3 for each time
        bool is_stepped = false;  // STEP; else LINEAR
        UnkeyedPose rest;         // the parts of the node's matrix, if it has one
    };
    // A new node, put between a node and that one's parent, without a transform. It gets the index after the file's
    // last node. Skins that move the node below it get it as their last joint.
    struct NewNode {
        std::string name;
        std::size_t below;
        Eigen::Matrix4d inverse_bind;  // of those skins
    };
    // One of several figures: all nodes of the file, below a node of its own.
    struct Figure {
        std::string name;
        Eigen::Vector3d place;
        double size;
        Eigen::Quaterniond rotation;
        std::vector<Track> tracks;
    };
    std::vector<float> times;
    std::vector<Track> tracks;
    int animation = -1;               // -1: a new one
    std::optional<std::string> name;  // given: a new animation of this name replaces the animation
    // Not empty: one scene of these figures, and one animation of `name` that moves them, replace all scenes,
    // animations and tracks. Nodes rest as their first keys have them. Nodes and skins are copied; meshes, materials
    // and all that they are made of are shared.
    std::vector<Figure> figures;
    bool drops_animations = false;  // removes all animations and adds none
    std::optional<NewNode> node{};  // moved by a track of its own
};

// The file with these changes, in the shape for a file at `to`: `binary` or not. from: where the file was read, for
// what lies beside it; buffers: their contents. Both must be as read: anything gltf_document() refuses is undefined
// here. Holds the text twice, and once as a document.
GltfContainer with_changes(const GltfContainer& file, std::span<const std::string_view> buffers,
                           const GltfChanges& changes, const std::filesystem::path& from,
                           const std::filesystem::path& to, bool binary);

}  // namespace swivel::formats
