#pragma once
// SPDX-License-Identifier: MIT
// A glTF file with the frames of all its bones, as most tests want it.

#include <vector>

#include "tools/formats/gltf.h"

namespace swivel::test {

inline std::vector<int> bones_of(const formats::Clip& clip)
{
    std::vector<int> bones;
    for (int joint = 0; joint < static_cast<int>(clip.joints.size()); ++joint)
        if (joint_at(clip, joint).is_bone) bones.push_back(joint);
    return bones;
}

inline formats::GltfFile read_clip(const std::filesystem::path& path, const formats::GltfChoice& choice = {})
{
    formats::GltfFile file = formats::read_gltf(path, choice);
    formats::sample(file, bones_of(file.clip));
    return file;
}

}  // namespace swivel::test
