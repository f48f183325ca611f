#pragma once
// SPDX-License-Identifier: MIT
// A glTF file's JSON text as a document. Knows which documents are refused, not what they say.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

namespace swivel::formats {

// The text as a document. Throws InputError for
// - text that is no JSON object;
// - text that is nested deeper than 500 levels;
// - members that check_members() refuses;
// - a document that says that its buffers are compressed.
nlohmann::json gltf_document(const std::filesystem::path& path, std::string_view json);

}  // namespace swivel::formats
