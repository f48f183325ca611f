#pragma once
// SPDX-License-Identifier: MIT
// The rows of a table with commas between its cells. Knows no columns.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

namespace swivel::formats {

// Calls take(line, cells) for each line of the file, except blank lines and those that begin with #. Lines count from
// 1. Cells come without surrounding blanks and quotes, and last for the call. Throws InputError for a quote that is not
// closed, and as read_text() does.
void for_each_row(const std::filesystem::path& path,
                  const std::function<void(std::size_t, const std::vector<std::string_view>&)>& take);

}  // namespace swivel::formats
