#pragma once
// SPDX-License-Identifier: MIT
// The table of targets: where each wrist must be in each frame, and where its elbow should point. The first line names
// the columns, in any order: frame,character,side,x,y,z,pole_x,pole_y,pole_z and, all four or none, qx,qy,qz,qw.
// Comma-separated, no quotes; blank lines and lines starting with # are skipped. Knows no crowd: whether a frame or a
// character exists is the caller's question, and `line` lets the answer name the place.

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "tools/formats/side.h"

namespace swivel::formats {

struct Target {
    std::uint32_t frame = 0;
    std::uint32_t character = 0;
    Side side = Side::left;
    bool has_orientation = false;                        // false too where a row leaves all four of qx to qw empty
    std::uint32_t line = 0;                              // of the file, for messages
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  // of the wrist, world space, the file's unit
    Eigen::Vector3d pole = Eigen::Vector3d::Zero();      // a point on the elbow's side, same space
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // of the hand, world space, made unit
};

// All targets, sorted by frame, then character, then side. Throws InputError naming line and column for a missing,
// unknown or repeated column, a value that is missing, too many or not a finite number, a side other than left or
// right, a quaternion outside 1e-15 to 1e15, a row for the same arm and frame as another, or a table without rows.
// Holds 96 bytes a row, and a 48 MiB window of the file while reading.
std::vector<Target> read_targets_csv(const std::filesystem::path& path);

}  // namespace swivel::formats
