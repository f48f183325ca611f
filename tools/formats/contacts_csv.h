#pragma once
// SPDX-License-Identifier: MIT
// The table of contacts: the frames at which a limb begins or ends to stand. The first line is frame,limb,contact. Each
// other line has a frame, counted from 0; left_arm, right_arm, left_leg or right_leg; on or off. Blank lines and lines
// starting with # are skipped. The caller checks whether a frame or a limb exists; `line` lets its message name the
// place.

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "tools/formats/limb_name.h"

namespace swivel::formats {

struct ContactRow {
    std::uint32_t frame = 0;
    LimbName limb;
    bool is_on = false;
    std::size_t line = 0;  // of the file, for messages
};

// Reads all rows, sorted by frame. Throws InputError that names the line, for
// - another first line;
// - a cell that is missing, too many or none of the above;
// - a second row for a limb and frame.
std::vector<ContactRow> read_contacts_csv(const std::filesystem::path& path);

// Writes such a table, whole or not at all. Throws InputError as OutputFile does.
void write_contacts_csv(const std::filesystem::path& path, std::span<const ContactRow> rows);

}  // namespace swivel::formats
