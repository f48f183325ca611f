// SPDX-License-Identifier: MIT
//
// What a joint's name says, whoever exported it. Knows no skeleton.
#pragma once

#include <string>
#include <string_view>

#include "tools/formats/limb_name.h"

namespace swivel::tools {

// A joint's name in the form that tables of names are written in: lower case, no name space before a colon or bar, no
// separators, no prefix that exporters put before every name. Letters beyond ASCII stay as they are.
std::string plain(std::string_view joint_name);

// A joint's name without what converters put behind all of them: a number after an underscore ("LeftArm_09", glTF from
// Sketchfab), or "jnt" or "joint" after a separator ("LeftArm_jnt").
std::string_view without_ending(std::string_view joint_name);

// True for two joints that are called the same but for what tools add where a file holds a name twice: name spaces,
// prefixes, "_1", ".001".
bool are_namesakes(std::string_view a, std::string_view b);

// True if it ends in the number that Blender gives a copy: "thigh.L.001".
bool is_copy_name(std::string_view joint_name);

// True for two parts of one bone by name: "DEF-thigh.L" and "DEF-thigh.L.001", "upperarm01.L" and "upperarm02.L",
// "Shoulder_L" and "ShoulderPart1_L". Not for other shoulders: the first of two may be the clavicle.
bool are_parts(std::string_view top, std::string_view below);

// True if a joint's name says that it shares out another's twist: "upperarm_twist_01_l".
bool is_twist_name(std::string_view joint_name);

// The same of "lForearmRoll", which may also be a joint that rolls the whole limb: a robot's shoulder.
bool is_roll_name(std::string_view joint_name);

// The side that a joint's name speaks of, or `otherwise` where it speaks of none or of both.
formats::Side side_of(std::string_view joint_name, formats::Side otherwise);

}  // namespace swivel::tools
