// SPDX-License-Identifier: MIT
#include "tools/formats/csv_rows.h"

#include <algorithm>
#include <string>

#include "tools/formats/error.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

// The cells of a line, without surrounding blanks and quotes.
void split(const std::filesystem::path& path, std::size_t line, std::string_view text,
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

}  // namespace

void for_each_row(const std::filesystem::path& path,
                  const std::function<void(std::size_t, const std::vector<std::string_view>&)>& take)
{
    const std::string text = read_text(path);
    std::vector<std::string_view> cells;
    std::size_t line = 0;
    for (std::string_view rest = without_byte_order_mark(text); !rest.empty();) {
        const std::string_view row = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(row.size() + 1, rest.size()));
        ++line;
        if (trimmed(row).empty() || row[0] == '#') continue;
        split(path, line, row, cells);
        take(line, cells);
    }
}

}  // namespace swivel::formats
