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

// Checks what a reader of skeletons needs of a document: its version, nodes, skins, animations, accessors, buffer views
// and buffers.
// Throws InputError, naming the place, for
// - a list or an element of a wrong type;
// - a member that is missing;
// - a member that is not what the specification says.
// Allocates little; any number of threads may call it.
void check_members(const std::filesystem::path& path, const nlohmann::json& document);

}  // namespace swivel::formats
