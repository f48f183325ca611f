#pragma once
// SPDX-License-Identifier: MIT
// A glTF document on its way into a file, and keys put into its animation. What only the replaced keys used is used by
// the new ones, so that nothing without a use is left behind. Knows no file.

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "tools/formats/gltf_edit.h"

namespace swivel::formats {

// Its JSON, and where new bytes go. An object of this Json is a vector of members: a new one moves all others, so the
// lists that grow are there (open_lists()) before anything refers into the document.
struct GltfAsset {
    nlohmann::ordered_json document;
    std::string bytes;       // of the GLB's chunk, or of a new buffer
    std::size_t buffer = 0;  // whose bytes these are

    nlohmann::ordered_json& list(const char* name);
    void open_lists();
    // An empty list is not legal glTF.
    void drop_empty_lists();
    // Adds bytes; the buffer view of them.
    nlohmann::ordered_json add_bytes(std::string_view content);
};

void add_keys(GltfAsset& asset, const GltfChanges& changes);

}  // namespace swivel::formats
