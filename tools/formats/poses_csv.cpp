// SPDX-License-Identifier: MIT
#include "tools/formats/poses_csv.h"

#include <fmt/format.h>

#include <charconv>
#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>

namespace swivel::formats {
namespace {

constexpr std::string_view kHeader =
    "frame,character,limb,shoulder_x,shoulder_y,shoulder_z,shoulder_w,"
    "elbow_x,elbow_y,elbow_z,elbow_w,wrist_x,wrist_y,wrist_z,wrist_w,flags,"
    "place_x,place_y,place_z,size,start";

// A cell of a line in the making: the fewest digits that give the same number back, or nothing.
void put_cell(std::string& line, bool is_filled, auto number)
{
    char digits[32];
    line.push_back(',');
    if (is_filled) line.append(digits, std::to_chars(digits, std::end(digits), number).ptr);
}
void put_cells(std::string& line, bool is_filled, const auto& numbers)
{
    for (const auto number : numbers) put_cell(line, is_filled, number);
}

void put_row(std::string& line, std::uint32_t frame, const PoseRow& row)
{
    line = fmt::format("{},{},{}", frame, row.character, limb_word(row.limb));
    for (const auto* rotation : {&row.shoulder, &row.elbow, &row.wrist}) put_cells(line, true, *rotation);
    put_cell(line, true, row.flags);
    put_cells(line, true, row.place);
    put_cell(line, true, row.size);
    put_cell(line, true, row.start);
}

void put_extra(std::string& line, const PoseColumns& columns, const PoseExtra& extra)
{
    if (columns.stretch) put_cell(line, true, extra.stretch);
    if (columns.clavicle) put_cells(line, extra.has_clavicle, extra.clavicle);
    for (unsigned bone = 0; bone < columns.twist_count; ++bone)
        put_cells(line, bone < extra.twist_count, extra.twist[bone]);
}

}  // namespace

PosesCsv::PosesCsv(const std::filesystem::path& path, const PoseColumns& columns) : out_(path), columns_(columns)
{
    std::string header(kHeader);
    if (columns.stretch) header += ",stretch";
    if (columns.clavicle) header += ",clavicle_x,clavicle_y,clavicle_z,clavicle_w";
    for (unsigned bone = 1; bone <= columns.twist_count; ++bone)
        for (const char component : {'x', 'y', 'z', 'w'}) header += fmt::format(",twist{}_{}", bone, component);
    if (columns.heading) header += ",heading_deg";
    if (columns.name) header += ",name";
    out_.write(header + "\n");
}

void PosesCsv::append(std::uint32_t frame, std::span<const PoseRow> rows, std::span<const PoseExtra> extras)
{
    std::string line;
    for (std::size_t n = 0; n < rows.size(); ++n) {
        put_row(line, frame, rows[n]);
        if (!extras.empty()) put_extra(line, columns_, extras[n]);
        if (columns_.heading) put_cell(line, true, rows[n].heading_deg);
        if (columns_.name) line.append(",").append(rows[n].name);
        line.push_back('\n');
        out_.write(line);
    }
}

}  // namespace swivel::formats
