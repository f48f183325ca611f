// SPDX-License-Identifier: MIT
//
// The table of the constants of plants, grounds, shifts, props and looks. A row is all that the library knows of one
// but its default, which is in swivel_bodies.h, its formula, and rules between several (body_check.cpp). Checks,
// swivel_describe_constant(), bindings, scenes and the page of fields read it.
#pragma once

#include <cstdint>
#include <span>

#include "batch/crowd/group_def.h"

namespace swivel {

// A float, or several that have the same bounds. A constant of SWIVEL_MAX_LOOK_JOINTS floats, and no other, is a look's
// and has one float for each of its joints. swivel_constant_info has this count, too, so bindings tell such a constant
// by it: a constant that is something else needs another count.
struct ConstantRow {
    std::uint32_t place, offset;  // of its structure in a GroupDef, and of it there; in bytes
    std::uint32_t count;          // of floats
    const char* structure;        // the member of GroupDef
    const char* name;             // the member of that
    float min, max;               // of each
    const char* unit;             // empty: it has none
    const char* text;

    // Whether a look has one float for each of its joints.
    constexpr bool is_of_each_joint() const { return count == SWIVEL_MAX_LOOK_JOINTS; }
};
std::span<const ConstantRow> constants();
// The floats of a group's constant.
const float* values_of(const GroupDef& group, const ConstantRow& row);

}  // namespace swivel
