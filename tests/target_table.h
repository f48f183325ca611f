#pragma once
// SPDX-License-Identifier: MIT
// The table of targets that `swivel solve --export-targets` writes, read and written by name of column.

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/pose_rows.h"

namespace swivel::test {

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
