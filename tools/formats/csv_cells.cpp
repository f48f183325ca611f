// SPDX-License-Identifier: MIT
#include "tools/formats/csv_cells.h"

#include "tools/formats/error.h"
#include "tools/formats/text.h"

namespace swivel::formats {

void split_cells(const std::filesystem::path& path, std::size_t line, std::string_view text,
                 std::vector<std::string_view>& cells)
{
    cells.clear();
    for (bool is_last = false; !is_last;) {
        bool is_quoted = false;
        std::size_t end = 0;
        for (; end < text.size() && (is_quoted || text[end] != ','); ++end) is_quoted = is_quoted != (text[end] == '"');
        if (is_quoted) throw InputError(path, line, "a quote is opened and not closed; close it or remove it");
        std::string_view cell = trimmed(text.substr(0, end));
        if (cell.size() > 1 && cell.starts_with('"') && cell.ends_with('"')) cell = cell.substr(1, cell.size() - 2);
        cells.push_back(cell);
        is_last = end == text.size();
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

}  // namespace swivel::formats
