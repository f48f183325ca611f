#pragma once
// SPDX-License-Identifier: MIT
// A glTF document on its way into a file, and keys put into its animation. What only the replaced keys used stays
// without a use. Knows no file.

#include <string>
#include <string_view>

#include "tools/formats/gltf_edit.h"
#include "tools/formats/gltf_json.h"

namespace swivel::formats {

// Its JSON, and where new bytes go.
struct GltfAsset {
    nlohmann::json document;
    std::string bytes;       // of the GLB's chunk, or of a new buffer
    std::size_t buffer = 0;  // whose bytes these are

    // The document's list of this name, made where there is none.
    nlohmann::json& list(const char* name);
    // An empty list is not legal glTF.
    void drop_empty_lists();
    // Adds bytes; the buffer view of them.
    nlohmann::json add_bytes(std::string_view content);
};

void add_keys(GltfAsset& asset, const GltfChanges& changes);

}  // namespace swivel::formats
