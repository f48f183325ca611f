#pragma once
// SPDX-License-Identifier: MIT
// The table of solved poses, written as it is produced: one line per frame, character and limb. It has the three local
// rotations as quaternions x, y, z, w, the flag word as a decimal number, and the character's place, size and start.
// Numbers have the fewest digits that give the same number back. Knows no solver and no meaning of flags.

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "tools/formats/limb_name.h"
#include "tools/formats/limits.h"
#include "tools/formats/output_file.h"

namespace swivel::formats {

struct PoseRow {
    std::uint32_t character = 0;
    LimbName limb;
    std::array<float, 4> shoulder{};  // or hip; x y z w, as are the next two; written as they are, finite or not
    std::array<float, 4> elbow{};     // or knee
    std::array<float, 4> wrist{};     // or ankle
    std::uint32_t flags = 0;
    std::array<double, 3> place{};  // of the character: where it stands, its size, the frame it starts at
    double size = 1;
    std::uint64_t start = 0;
    float heading_deg = 0;  // these two are optional columns; a name must last for the call
    std::string_view name{};
};

// Further results of a limb, for optional columns.
struct PoseExtra {
    float stretch = 1;  // factor of both bone lengths
    bool has_clavicle = false;
    std::array<float, 4> clavicle{};                           // local rotation of the joint above, x y z w
    unsigned twist_count = 0;                                  // the number of bones in `twist`; other cells stay empty
    std::array<std::array<float, 4>, kMaxTwistBones> twist{};  // x y z w
};

// The optional columns, after those that every table has.
struct PoseColumns {
    bool stretch = false;      // "stretch"
    bool clavicle = false;     // "clavicle_x" and so on
    unsigned twist_count = 0;  // "twist1_x" and so on
    bool heading = false;      // "heading_deg"
    bool name = false;         // "name"

    // Whether a PoseExtra has some of them.
    bool has_extras() const { return stretch || clavicle || twist_count > 0; }
};

class PosesCsv {
public:
    // Opens the file and writes the line of column names. Throws InputError as OutputFile does.
    explicit PosesCsv(const std::filesystem::path& path, const PoseColumns& columns = {});

    // Writes the rows of one frame in the order given. Frames may come in any order and in several pieces. extras: one
    // for each row, or none if there are no columns for them. Throws InputError when the disk is full.
    void append(std::uint32_t frame, std::span<const PoseRow> rows, std::span<const PoseExtra> extras = {});

    // Makes the file appear; without it there is none. To be called once, last.
    void commit() { out_.commit(); }

private:
    OutputFile out_;
    PoseColumns columns_;
};

}  // namespace swivel::formats
