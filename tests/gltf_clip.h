#pragma once
// SPDX-License-Identifier: MIT
// A glTF file with the frames of all its bones, as most tests want it.

#include "tools/formats/gltf.h"

namespace swivel::test {

inline formats::GltfFile read_clip(const std::filesystem::path& path, const formats::GltfChoice& choice = {})
{
    formats::GltfFile file = formats::read_gltf(path, choice);
    formats::sample(file, formats::bones_of(file.clip));
    return file;
}

}  // namespace swivel::test
