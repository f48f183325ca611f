// SPDX-License-Identifier: MIT
//
// Reads joints' names, whoever exported them. Knows no skeleton.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tools/formats/limb_name.h"

namespace swivel::tools {

// A joint's name in the form of the table of names: lower case, without separators and exporters' additions. These are
// - a name space before a colon or bar, and "FBXASC046" for the character of that number;
// - an ending that is a number after an underscore, "jnt" or "joint" ("LeftArm_09", "LeftArm_jnt");
// - before that, m or x as a last word of its own, which says the middle ("Head_M", "head.x");
// - all before a side that is a word of its own and not the last one ("Bob_L_shoulder" is "lshoulder");
// - a prefix that exporters put before names ("mixamorig", "DEF-").
// Letters beyond ASCII stay as they are.
std::string plain(std::string_view joint_name);

// Its last word, without such endings and without a number: "head" of "CC_Base_Head" and "ValveBiped.Bip01_Head1".
std::string last_word(std::string_view joint_name);

// The side in a joint's name: left or right as a part of a word, l or r as a whole word. Nothing if the name has none
// or both.
std::optional<formats::Side> side_word(std::string_view joint_name);

}  // namespace swivel::tools
