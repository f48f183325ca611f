#pragma once
// SPDX-License-Identifier: MIT
// The table of agents: who is in a crowd, one row each. The first line names the columns, in any order: name, x, y and
// z always, heading_deg, start, clip, size and build as wanted. Blank lines and lines starting with # are skipped. The
// caller checks whether a clip, a build or a frame exists; `line` lets its message name the place.

#include <filesystem>
#include <string>
#include <vector>

namespace swivel::formats {

struct Agent {
    std::string name;            // unique
    double x = 0, y = 0, z = 0;  // where it stands at first, in the world
    double heading_deg = 0;      // about y, -360 to 360
    double size = 1;             // factor of all lengths, 0.01 to 100
    double start = 0;            // frame of its clip; this and the next two are whole numbers
    double clip = 0, build = 0;  // 0: the first
    std::size_t line = 0;        // of the file, for messages
};

// Reads all rows, in order. Throws InputError that names the line, for
// - a first line that lacks a column, repeats one or has another;
// - a row with more or fewer cells, and a cell that is empty or out of its range;
// - a name that another row has, or that is_plain_name() refuses.
std::vector<Agent> read_agents_csv(const std::filesystem::path& path);

}  // namespace swivel::formats
