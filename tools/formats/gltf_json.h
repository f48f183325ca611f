#pragma once
// SPDX-License-Identifier: MIT
// A glTF file's JSON text as a document. Knows which documents are refused, not what they say.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace swivel::formats {

// The text as a document. Throws InputError for text that is no JSON object or is nested deeper than 500 levels, for
// members that check_members() refuses, and if the document says that its buffers are compressed.
nlohmann::ordered_json gltf_document(const std::filesystem::path& path, std::string_view json);

}  // namespace swivel::formats
