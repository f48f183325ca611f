#pragma once
// SPDX-License-Identifier: MIT
// The tables of `swivel solve`: of poses, as --out poses.csv writes them, and of targets, as --export-targets does.
// Both are read by name of column.

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

namespace swivel::test {

inline const std::string kPoseHeader =
    "frame,character,limb,shoulder_x,shoulder_y,shoulder_z,shoulder_w,elbow_x,elbow_y,elbow_z,elbow_w,"
    "wrist_x,wrist_y,wrist_z,wrist_w,flags,place_x,place_y,place_z,size,start";

struct PoseLine {
    std::size_t frame = 0, character = 0;
    std::string limb;
    std::array<Eigen::Quaterniond, 3> joint;  // shoulder, elbow, wrist
    unsigned flags = 0;
    std::map<std::string, std::string> cell;  // all of them

    auto place() const { return std::tuple(frame, character, limb); }
    double number(const std::string& column) const { return std::strtod(cell.at(column).c_str(), nullptr); }
    Eigen::Quaterniond rotation(const std::string& column) const
    {
        return {number(column + "_w"), number(column + "_x"), number(column + "_y"), number(column + "_z")};
    }
};

inline std::vector<std::string> cells_of(const std::string& line)
{
    std::vector<std::string> cells(1);
    for (const char c : line)
        if (c == ',')
            cells.emplace_back();
        else
            cells.back() += c;
    return cells;
}

// The largest angle between the two tables, of all joints in all rows.
inline double worst_rotation(const std::vector<PoseLine>& a, const std::vector<PoseLine>& b)
{
    REQUIRE(a.size() == b.size());
    double worst = 0;
    for (std::size_t n = 0; n < a.size(); ++n)
        for (std::size_t j = 0; j < 3; ++j) worst = std::max(worst, a[n].joint[j].angularDistance(b[n].joint[j]));
    return worst;
}

inline constexpr const char* kTargetHeader = "frame,character,limb,x,y,z,pole_x,pole_y,pole_z,qx,qy,qz,qw";

// One row of a table, read by hand: cells by column.
using Cells = std::map<std::string, std::string>;
struct TargetTable {
    std::vector<std::string> columns;
    std::vector<Cells> rows;

    explicit TargetTable(const std::string& text)
    {
        std::istringstream in(text);
        std::string line;
        REQUIRE(std::getline(in, line));
        columns = cells_of(line);
        while (std::getline(in, line)) {
            const std::vector<std::string> cells = cells_of(line);
            REQUIRE(cells.size() == columns.size());
            Cells& row = rows.emplace_back();
            for (std::size_t n = 0; n < cells.size(); ++n) row[columns[n]] = cells[n];
        }
    }
    std::string text() const
    {
        std::string all;
        for (std::size_t n = 0; n < columns.size(); ++n) all += (n > 0 ? "," : "") + columns[n];
        for (const Cells& row : rows) {
            all += "\n";
            for (std::size_t n = 0; n < columns.size(); ++n) all += (n > 0 ? "," : "") + row.at(columns[n]);
        }
        return all + "\n";
    }
    void leave_out(const std::vector<std::string>& names)
    {
        std::erase_if(columns, [&](const std::string& each) {
            return std::find(names.begin(), names.end(), each) != names.end();
        });
    }
};

// more: what the header has after these columns.
inline std::vector<PoseLine> pose_lines(const std::string& text, const std::string& more = "")
{
    const TargetTable table(text);
    REQUIRE(text.starts_with(kPoseHeader + more + "\n"));
    std::vector<PoseLine> lines;
    for (const Cells& row : table.rows) {
        PoseLine& line = lines.emplace_back();
        line.cell = row;
        line.frame = static_cast<std::size_t>(line.number("frame"));
        line.character = static_cast<std::size_t>(line.number("character"));
        line.limb = line.cell["limb"];
        line.joint = {line.rotation("shoulder"), line.rotation("elbow"), line.rotation("wrist")};
        line.flags = static_cast<unsigned>(line.number("flags"));
    }
    return lines;
}

inline double number(const Cells& row, const std::string& column)
{
    return std::strtod(row.at(column).c_str(), nullptr);
}
inline Eigen::Vector3d point(const Cells& row, const std::string& prefix)
{
    return {number(row, prefix + "x"), number(row, prefix + "y"), number(row, prefix + "z")};
}
inline Eigen::Matrix3d hand_of(const Cells& row)
{
    return Eigen::Quaterniond(number(row, "qw"), number(row, "qx"), number(row, "qy"), number(row, "qz"))
        .toRotationMatrix();
}

}  // namespace swivel::test
