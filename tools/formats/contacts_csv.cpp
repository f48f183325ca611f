// SPDX-License-Identifier: MIT
#include "tools/formats/contacts_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <tuple>

#include "tools/formats/csv_rows.h"
#include "tools/formats/error.h"
#include "tools/formats/output_file.h"
#include "tools/formats/printable.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

constexpr std::string_view kContactColumns = "frame,limb,contact";

ContactRow parse_contact(const std::filesystem::path& path, std::size_t line,
                         const std::vector<std::string_view>& cells)
{
    if (cells.size() != 3)
        throw InputError(path, line, fmt::format("has {} values; a line has three, {}", cells.size(), kContactColumns));
    const auto refuse = [&](std::string_view column, std::string_view cell, std::string_view problem) {
        throw InputError(path, line, fmt::format("column {}: '{}' {}", column, printable(cell), problem));
    };
    const std::optional<std::int64_t> frame = parse_integer(cells[0]);
    if (!frame || *frame < 0 || *frame > std::numeric_limits<std::uint32_t>::max())
        refuse("frame", cells[0], "is not a whole number from 0 to 4294967295");
    const std::optional<LimbName> limb = limb_of_word(cells[1]);
    if (!limb) refuse("limb", cells[1], "is neither left_leg nor right_leg");
    if (cells[2] != "on" && cells[2] != "off") refuse("contact", cells[2], "is neither on nor off");
    return {static_cast<std::uint32_t>(*frame), *limb, cells[2] == "on", line};
}

}  // namespace

std::vector<ContactRow> read_contacts_csv(const std::filesystem::path& path)
{
    std::vector<ContactRow> rows;
    bool has_columns = false;
    for_each_row(path, [&](std::size_t line, const std::vector<std::string_view>& cells) {
        if (has_columns)
            rows.push_back(parse_contact(path, line, cells));
        else if (joined(cells, ",") != kContactColumns)
            throw InputError(path, line,
                             fmt::format("is no table of contacts; its first line must be {}", kContactColumns));
        has_columns = true;
    });
    if (rows.empty()) throw InputError(path, fmt::format("has no rows below its first line, {}", kContactColumns));
    const auto place = [](const ContactRow& row) { return std::tuple(row.frame, row.limb); };
    std::ranges::stable_sort(rows, {}, place);
    const auto twin = std::ranges::adjacent_find(rows, {}, place);
    if (twin != rows.end())
        throw InputError(path, (twin + 1)->line,
                         fmt::format("frame {} of {} is already in line {}; remove one", twin->frame,
                                     limb_word(twin->limb), twin->line));
    return rows;
}

void write_contacts_csv(const std::filesystem::path& path, std::span<const ContactRow> rows)
{
    OutputFile out(path);
    out.write(fmt::format("{}\n", kContactColumns));
    for (const ContactRow& row : rows)
        out.write(fmt::format("{},{},{}\n", row.frame, limb_word(row.limb), row.is_on ? "on" : "off"));
    out.commit();
}

}  // namespace swivel::formats
