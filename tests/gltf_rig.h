#pragma once
// SPDX-License-Identifier: MIT
// glTF files made up by tests: nodes, skins and animations in, a .gltf or .glb out; and what the product reads of them.

#include <nlohmann/json.hpp>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "tests/test_data.h"
#include "tools/formats/gltf.h"

namespace swivel::test {

class GltfRig {
public:
    nlohmann::json json;
    std::string bytes;

    GltfRig();

    // A node at rest; parent -1: a root.
    int add(const std::string& name, int parent, const Eigen::Vector3d& translation,
            const Eigen::Quaterniond& rotation = Eigen::Quaterniond::Identity(),
            const Eigen::Vector3d& scale = Eigen::Vector3d::Ones());
    int add_animation(const std::string& name);
    int add_accessor(const std::vector<float>& values, const char* type, std::size_t width);
    // Keys of a node: path "translation", "rotation" (x, y, z, w) or "scale"; kind "STEP", "LINEAR" or "CUBICSPLINE".
    void add_keys(int animation, int node, const char* path, const std::vector<float>& times,
                  const std::vector<float>& values, const char* kind = "LINEAR");
    // Writes the file by its suffix; a .gltf has its bytes in a .bin beside it.
    void write(const fs::path& path) const;

    static std::string glb(std::string text, std::string chunk);
};

inline std::vector<int> bones_of(const formats::Clip& clip)
{
    std::vector<int> bones;
    for (int joint = 0; joint < static_cast<int>(clip.joints.size()); ++joint)
        if (joint_at(clip, joint).is_bone) bones.push_back(joint);
    return bones;
}

// A file with the frames of all its bones, as most tests want it.
inline formats::GltfFile read_clip(const fs::path& path, const formats::GltfChoice& choice = {})
{
    formats::GltfFile file = formats::read_gltf(path, choice);
    formats::sample(file, bones_of(file.clip));
    return file;
}

}  // namespace swivel::test
