// SPDX-License-Identifier: MIT
#include "tools/formats/poses_csv.h"

#include <charconv>
#include <cstddef>
#include <string_view>

namespace swivel::formats {
namespace {

constexpr std::string_view kHeader =
    "frame,character,limb,shoulder_x,shoulder_y,shoulder_z,shoulder_w,"
    "elbow_x,elbow_y,elbow_z,elbow_w,wrist_x,wrist_y,wrist_z,wrist_w,flags\n";

// Longest line: three whole numbers of 10 digits, "right_arm", 12 floats such as -1.17549435e-38 (15), 16 separators:
// 235.
constexpr std::size_t kMaxLineBytes = 256;

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
    put(line, '\n');
}

}  // namespace

PosesCsv::PosesCsv(const std::filesystem::path& path) : out_(path) { out_.write(kHeader); }

void PosesCsv::append(std::uint32_t frame, std::span<const PoseRow> rows)
{
    for (const PoseRow& row : rows) {
        Line line;
        put_row(line, frame, row);
        out_.write({line.text.data(), static_cast<std::size_t>(line.end - line.text.data())});
    }
}

void PosesCsv::commit() { out_.commit(); }

}  // namespace swivel::formats
