// SPDX-License-Identifier: MIT
//
// A crowd's definition. Its groups have one form for all kinds, with the features that the caller's imply.
#pragma once

#include <cstdint>

#include "include/swivel/swivel_bodies.h"
#include "simd/fields.h"

namespace swivel {

// Members of other kinds have their defaults.
struct GroupDef {
    swivel_features asked;     // by the caller
    swivel_features features;  // these, those that they bring, and the library's own bits
    std::uint32_t limb_count;
    std::uint32_t on_bad_input, shoulder_order, wrist_order;  // as numbers, since callers may give any
    const swivel_region* region;
    float pole_behind[3];
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
// The definition with all members: those that an older, shorter structure lacks get defaults.
swivel_crowd_def full_def(const swivel_crowd_def* def);
// body_check.cpp: checks the skeleton's part of a def, as swivel_crowd_create() promises. Groups are otherwise valid.
swivel_status check_bodies(const swivel_crowd_def& def);

}  // namespace swivel
