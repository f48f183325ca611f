#pragma once
// SPDX-License-Identifier: MIT
// The bytes of a glTF file's buffers, wherever they are kept: in the GLB's chunk, in the text, or in files beside it
// and nowhere else.

#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "tools/formats/gltf_container.h"

namespace swivel::formats {

struct GltfBuffers {
    std::vector<std::string_view> bytes;                       // of each buffer, in `contents`, which copies share
    std::vector<std::shared_ptr<const std::string>> contents;  // fewer where buffers lie in one file
};

// Every buffer of a document that check_members() has passed, each as long as it says: what there is beyond is left.
// path: of the glTF file. container: its chunk becomes the first buffer and is empty then. Throws InputError for
// - a buffer without bytes, or with too few;
// - an address that is not relative;
// - a file outside the glTF file's folder, links followed;
// - more than 8 GiB in files.
// Reads plain files only, each address once; allocates what the buffers say they hold and the files do.
GltfBuffers read_gltf_buffers(const std::filesystem::path& path, const nlohmann::json& document,
                              GltfContainer& container);

}  // namespace swivel::formats
