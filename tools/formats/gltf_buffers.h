#pragma once
// SPDX-License-Identifier: MIT
// The bytes of a glTF file's buffers, wherever they are kept: in the GLB's chunk, in the text, or in files beside it
// and nowhere else.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tools/formats/gltf_container.h"

namespace swivel::formats {

// Every buffer of a document that check_members() has passed, each as long as it says: what there is beyond is left.
// path: of the glTF file. Throws InputError, naming the buffer, where its bytes are missing, too few, or at an address
// that is not relative. Reads plain files only; allocates what the buffers say they hold and the files do.
std::vector<std::string> read_gltf_buffers(const std::filesystem::path& path, const nlohmann::ordered_json& document,
                                           const GltfContainer& container);

}  // namespace swivel::formats
