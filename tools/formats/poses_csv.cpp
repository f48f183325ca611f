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

// The fewest digits that give the same number back. line: a row in the making.
template <class Number>
void put(std::string& line, Number number)
{
    char digits[32];
    line.append(digits, std::to_chars(digits, std::end(digits), number).ptr);
}

void put_cells(std::string& line, bool filled, const std::array<float, 4>& rotation)
{
    for (const float component : rotation) {
        line.push_back(',');
        if (filled) put(line, component);
    }
}

void put_row(std::string& line, std::uint32_t frame, const PoseRow& row)
{
    line += fmt::format("{},{},{}", frame, row.character, limb_word(row.limb));
    for (const auto* rotation : {&row.shoulder, &row.elbow, &row.wrist}) put_cells(line, true, *rotation);
    line += fmt::format(",{}", row.flags);
    for (const double number : {row.place[0], row.place[1], row.place[2], row.size}) {
        line.push_back(',');
        put(line, number);
    }
    line += fmt::format(",{}", row.start);
}

void put_extra(std::string& line, const PoseColumns& columns, const PoseExtra& extra)
{
    if (columns.stretch) {
        line.push_back(',');
        put(line, extra.stretch);
    }
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
        line.clear();
        put_row(line, frame, rows[n]);
        if (!extras.empty()) put_extra(line, columns_, extras[n]);
        if (columns_.heading) {
            line.push_back(',');
            put(line, rows[n].heading_deg);
        }
        if (columns_.name) line.append(",").append(rows[n].name);
        line.push_back('\n');
        out_.write(line);
    }
}

void PosesCsv::commit() { out_.commit(); }

}  // namespace swivel::formats
