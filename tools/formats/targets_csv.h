#pragma once
// SPDX-License-Identifier: MIT
// The table of targets: where each wrist or ankle must be in each frame, where its elbow or knee should point, and how
// its hand or foot is turned. The first line names the columns, in any order: frame,character,limb,x,y,z, and as one
// likes pole_x,pole_y,pole_z and qx,qy,qz,qw. A table has all columns of a pole or none, and a row fills in all of them
// or none. The same holds for the orientation. limb is left_arm, right_arm, left_leg or right_leg. A table of arms may
// have side, left or right, instead. Commas stand between cells, which may be quoted. Blank lines and lines starting
// with # are skipped. Knows no crowd: the caller checks whether a frame or a character exists; `line` lets its message
// name the place.

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "tools/formats/limb_name.h"
#include "tools/formats/output_file.h"

namespace swivel::formats {

struct Target {
    std::uint32_t frame = 0;
    std::uint32_t character = 0;
    LimbName limb;
    bool has_pole = false, has_orientation = false;      // false too where a row leaves all their cells empty
    std::uint32_t line = 0;                              // of the file, for messages
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  // of wrist or ankle, world space, the file's unit
    Eigen::Vector3d pole = Eigen::Vector3d::Zero();      // a point on the elbow's or knee's side, same space
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // of hand or foot, world space, made unit
};

// All targets, sorted by frame, then character, then limb. Holds 96 bytes a row, and the file while reading. Throws
// InputError that names line and column, for
// - a missing, unknown or repeated column;
// - a value that is missing, too many or not a finite number;
// - an unknown limb, and a quaternion outside 1e-15 to 1e15;
// - a second row for a limb and frame, and a table without rows.
std::vector<Target> read_targets_csv(const std::filesystem::path& path);

// Writes such a table, with all columns. Numbers have the fewest digits that give the same double back; a missing pole
// or orientation leaves its cells empty.
class TargetsCsv {
public:
    // Opens the file and writes the line of column names. Throws InputError as OutputFile does.
    explicit TargetsCsv(const std::filesystem::path& path);

    // Writes them in the order given. Throws InputError when the disk is full.
    void append(std::span<const Target> targets);

    // Makes the file appear; without it there is none. To be called once, last.
    void commit() { out_.commit(); }

private:
    OutputFile out_;
};

}  // namespace swivel::formats
