#pragma once
// SPDX-License-Identifier: MIT
// An element of one of a glTF file's lists, by the index that the file has for it.

#include <fmt/format.h>

#include <cstddef>
#include <filesystem>

#include "tools/formats/error.h"

namespace swivel::formats {

// The list's element of this index. path, name: of the file and what the list holds, for the message. Throws InputError
// where there is none.
template <class List>
const auto& element(const std::filesystem::path& path, const List& list, int index, const char* name)
{
    if (index < 0 || static_cast<std::size_t>(index) >= list.size())
        throw InputError(path, fmt::format("{} {} does not exist; there are {}", name, index, list.size()));
    return list[static_cast<std::size_t>(index)];
}

}  // namespace swivel::formats
