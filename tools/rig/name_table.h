// SPDX-License-Identifier: MIT
//
// How exporters and rigging tools name the joints of limbs and fingers. docs/rigs.md shows the same table of limbs.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "tools/formats/limb_name.h"

namespace swivel::tools {

// Names as plain() has them, with * for the side. Empty names: this row knows no such limb.
struct NameRow {
    std::array<std::string_view, 3> arm, leg;  // shoulder, elbow and wrist; hip, knee and ankle
    std::string_view from;                     // the tools that use these names, for people

    const std::array<std::string_view, 3>& joints(formats::LimbKind kind) const
    {
        return kind == formats::LimbKind::arm ? arm : leg;
    }
};

// The first row that fits counts. So rows with clear names of upper arms come before rows with names that may be a
// clavicle's.
std::span<const NameRow> name_table();

// The words that * may stand for.
std::array<std::string_view, 3> side_words(formats::Side side);

// The side in a joint's name: the one with which the name is in the table, else that of a word in it, else `otherwise`.
formats::Side side_of(std::string_view joint_name, formats::Side otherwise);

// A name of the table with this side.
std::string with_side(std::string_view name, std::string_view side);

// "left index 1" for LeftHandIndex1, index_01_l and f_index.01.L: the side, the finger and its bone, counted from the
// hand outwards. Empty if the name is none of a finger. plain_name: as plain() has it.
std::string finger_bone(std::string_view plain_name);

}  // namespace swivel::tools
