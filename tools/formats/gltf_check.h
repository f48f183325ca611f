#pragma once
// SPDX-License-Identifier: MIT
// The types of glTF's members, before a reader takes them. Knows which members there are, not what their values mean.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace swivel::formats {

// Checks what a reader of skeletons needs of a document: its version, nodes, skins, animations, accessors, buffer views
// and buffers.
// Throws InputError, naming the place, for
// - a list or an element of a wrong type;
// - a member that is missing;
// - a member that is not what the specification says.
// Allocates little; any number of threads may call it.
void check_members(const std::filesystem::path& path, const nlohmann::json& document);

}  // namespace swivel::formats
