#pragma once
// SPDX-License-Identifier: MIT
// A glTF file's JSON text as a document, and its lists. Refuses invalid documents, but does not interpret them.

#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "tools/formats/error.h"

namespace swivel::formats {

// The text as a document. Throws InputError for
// - text that is no JSON object;
// - text that is nested deeper than 500 levels;
// - members that check_members() refuses;
// - a document that says that its buffers are compressed.
nlohmann::json gltf_document(const std::filesystem::path& path, std::string_view json);

// Checks the members of a document that a reader of skeletons needs: version, nodes, skins, animations, accessors,
// buffer views and buffers.
// Throws InputError, naming the place, for
// - a list or an element of a wrong type;
// - a member that is missing;
// - a member that is not what the specification says.
// Allocates little; any number of threads may call it.
void check_members(const std::filesystem::path& path, const nlohmann::json& document);

// A list of the document or of one of its objects; an empty one where it is missing.
inline const nlohmann::json& list_in(const nlohmann::json& owner, const char* name)
{
    static const nlohmann::json kNone = nlohmann::json::array();
    const auto found = owner.find(name);
    return found == owner.end() ? kNone : *found;
}

// The type of an accessor whose elements have this many components: 1, 3, 4 or 16.
constexpr const char* accessor_type(std::size_t width)
{
    return width == 1 ? "SCALAR" : width == 3 ? "VEC3" : width == 4 ? "VEC4" : "MAT4";
}

// The list's element of this index. path: of the file. name: of the list's elements, for the message. Throws InputError
// if there is none.
template <class List>
const auto& element(const std::filesystem::path& path, const List& list, int index, const char* name)
{
    if (index < 0 || static_cast<std::size_t>(index) >= list.size())
        throw InputError(
            path, fmt::format("{} {} does not exist; there are {}; export the file again", name, index, list.size()));
    return list[static_cast<std::size_t>(index)];
}

}  // namespace swivel::formats
