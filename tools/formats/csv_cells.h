#pragma once
// SPDX-License-Identifier: MIT
// A line of a table with commas, for the tables that are read here.

#include <cstddef>
#include <filesystem>
#include <string_view>
#include <vector>

namespace swivel::formats {

// The cells of a line, without blanks around them and the quotes that they may stand in. They point into `text`.
// Throws InputError, naming path and line, for a quote that is not closed.
void split_cells(const std::filesystem::path& path, std::size_t line, std::string_view text,
                 std::vector<std::string_view>& cells);

}  // namespace swivel::formats
