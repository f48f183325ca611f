// SPDX-License-Identifier: MIT
#include "tools/formats/poses_csv.h"

#include <fmt/format.h>

#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>

namespace swivel::formats {
namespace {

constexpr std::string_view kHeader =
    "frame,character,limb,shoulder_x,shoulder_y,shoulder_z,shoulder_w,"
    "elbow_x,elbow_y,elbow_z,elbow_w,wrist_x,wrist_y,wrist_z,wrist_w,flags,"
    "place_x,place_y,place_z,size,start";

// Longest line: three whole numbers of 10 digits and one of 20, "right_arm", 45 floats such as -1.17549435e-38 (15), 4
// doubles such as -2.2250738585072014e-308 (24), 54 separators: 884.
constexpr std::size_t kMaxLineBytes = 896;

// A line in the making.
struct Line {
    std::array<char, kMaxLineBytes> text;
    char* end = text.data();
};

void put(Line& line, char c) { *line.end++ = c; }

void put(Line& line, std::string_view word) { line.end += word.copy(line.end, word.size()); }

template <class Number>
void put_number(Line& line, Number number)
{
    line.end = std::to_chars(line.end, line.text.data() + line.text.size(), number).ptr;
}

void put_rotation(Line& line, const std::array<float, 4>& rotation)
{
    for (const float component : rotation) {
        put_number(line, component);
        put(line, ',');
    }
}

void put_row(Line& line, std::uint32_t frame, const PoseRow& row)
{
    put_number(line, frame);
    put(line, ',');
    put_number(line, row.character);
    put(line, ',');
    put(line, limb_word(row.limb));
    put(line, ',');
    put_rotation(line, row.shoulder);
    put_rotation(line, row.elbow);
    put_rotation(line, row.wrist);
    put_number(line, row.flags);
    for (const double coordinate : row.place) {
        put(line, ',');
        put_number(line, coordinate);
    }
    put(line, ',');
    put_number(line, row.size);
    put(line, ',');
    put_number(line, row.start);
}

void put_cells(Line& line, bool filled, const std::array<float, 4>& rotation)
{
    for (const float component : rotation) {
        put(line, ',');
        if (filled) put_number(line, component);
    }
}

void put_extra(Line& line, const PoseColumns& columns, const PoseExtra& extra)
{
    if (columns.stretch) {
        put(line, ',');
        put_number(line, extra.stretch);
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
    out_.write(header + "\n");
}

void PosesCsv::append(std::uint32_t frame, std::span<const PoseRow> rows, std::span<const PoseExtra> extras)
{
    for (std::size_t n = 0; n < rows.size(); ++n) {
        Line line;
        put_row(line, frame, rows[n]);
        if (!extras.empty()) put_extra(line, columns_, extras[n]);
        put(line, '\n');
        out_.write({line.text.data(), static_cast<std::size_t>(line.end - line.text.data())});
    }
}

void PosesCsv::commit() { out_.commit(); }

}  // namespace swivel::formats
