#pragma once
// SPDX-License-Identifier: MIT
// Lists of a glTF file, and their elements by the indices that the file has for them.

#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tools/formats/error.h"

namespace swivel::formats {

// A list of the document or of one of its objects; an empty one where it is missing.
inline const nlohmann::json& list_in(const nlohmann::json& owner, const char* name)
{
    static const nlohmann::json kNone = nlohmann::json::array();
    const auto found = owner.find(name);
    return found == owner.end() ? kNone : *found;
}

// The list's element of this index. path, name: of the file and what the list holds, for the message. Throws InputError
// where there is none.
template <class List>
const auto& element(const std::filesystem::path& path, const List& list, int index, const char* name)
{
    if (index < 0 || static_cast<std::size_t>(index) >= list.size())
        throw InputError(
            path, fmt::format("{} {} does not exist; there are {}; export the file again", name, index, list.size()));
    return list[static_cast<std::size_t>(index)];
}

}  // namespace swivel::formats
