#pragma once
// SPDX-License-Identifier: MIT
// A glTF file's JSON text as a document. Knows which documents are refused, not what they say.

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>

namespace swivel::formats {

// Frees a document without asking for memory. The library's own destructor does ask, and where there is none the
// program ends.
struct FreeDocument {
    void operator()(nlohmann::json* document) const noexcept;
};
using GltfDocument = std::unique_ptr<nlohmann::json, FreeDocument>;

// The text as a document. Throws InputError for
// - text that is no JSON object;
// - text that is nested deeper than 500 levels;
// - members that check_members() refuses;
// - a document that says that its buffers are compressed.
GltfDocument gltf_document(const std::filesystem::path& path, std::string_view json);

}  // namespace swivel::formats
