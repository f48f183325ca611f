// SPDX-License-Identifier: MIT
//
// A crowd's definition. Its groups have one form for all kinds, with the features that the caller's imply. And the
// table of the constants of plants, grounds, shifts, props and looks.
#pragma once

#include <cstdint>
#include <span>

#include "include/swivel/swivel_bodies.h"
#include "simd/fields.h"

namespace swivel {

// Members of other kinds have their defaults.
struct GroupDef {
    swivel_features asked;     // by the caller
    swivel_features features;  // these, those that they bring, and the library's own bits
    std::uint32_t limb_count;
    swivel_on_bad_input on_bad_input;
    swivel_euler_order shoulder_order, wrist_order;
    const swivel_region* region;
    swivel_binding binding;            // of free limbs, as given
    const swivel_limb_joints* joints;  // null: no limb of a body
    std::uint32_t link;
    swivel_plant plant;
    swivel_ground ground;
    swivel_look_def look;
    swivel_prop_def prop;
    swivel_shift_def shift;
};

// A group whose members have their defaults.
GroupDef default_group();
// Group g of a crowd def that check_group_defs() found right. unlinked_group() is cheaper: it does not add
// SWIVEL_WITH_HAND_TRANSFORM where another group links to this one.
GroupDef group_at(const swivel_crowd_def& def, std::uint32_t g);
GroupDef unlinked_group(const swivel_crowd_def& def, std::uint32_t g);
// Refuses a def unless each group has exactly one definition, of a size that some header has.
swivel_status check_group_defs(const swivel_crowd_def& def);

// crowd_check.cpp: refuses a definition that no crowd can be made of.
swivel_status check_def(const swivel_crowd_def* def);
// body_check.cpp: checks the skeleton's part of a def, as swivel_crowd_create() promises. Groups are otherwise valid.
swivel_status check_bodies(const swivel_crowd_def& def);
// The definition with all members: those that an older, shorter structure lacks get defaults.
swivel_crowd_def full_def(const swivel_crowd_def* def);

// constants.cpp: the table of constants. Defaults are in swivel_bodies.h, and rules between several constants in
// body_check.cpp. Checks, swivel_describe_constant(), bindings, scenes and the page of fields read the table.
//
// A row is one float, or several with the same bounds. Exactly the constants of SWIVEL_MAX_LOOK_JOINTS floats have one
// float for each joint of a look. Bindings rely on this count in swivel_constant_info, so other constants must have
// another one.
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
