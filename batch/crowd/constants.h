// SPDX-License-Identifier: MIT
//
// The table of the constants of plants, grounds, shifts, props and looks. Defaults are in swivel_bodies.h, and rules
// between several constants in body_check.cpp. Checks, swivel_describe_constant(), bindings, scenes and the page of
// fields read the table.
#pragma once

#include <cstdint>
#include <span>

#include "batch/crowd/group_def.h"

namespace swivel {

// One float, or several with the same bounds. Exactly the constants of SWIVEL_MAX_LOOK_JOINTS floats have one float for
// each joint of a look. Bindings rely on this count in swivel_constant_info, so other constants must have another one.
struct ConstantRow {
    std::uint32_t place, offset;  // bytes: of the structure in a GroupDef, and of the member in it
    std::uint32_t count;          // of floats
    const char* structure;        // the member of GroupDef
    const char* name;             // the structure's member
    float min, max;               // of each
    const char* unit;             // empty: none
    const char* text;

    // Whether a look has one float for each of its joints.
    constexpr bool is_of_each_joint() const { return count == SWIVEL_MAX_LOOK_JOINTS; }
};
std::span<const ConstantRow> constants();
// The floats of a group's constant.
const float* values_of(const GroupDef& group, const ConstantRow& row);

}  // namespace swivel
