// SPDX-License-Identifier: MIT
//
// Which bone of which finger a joint is, by its name. Knows no skeleton.
#pragma once

#include <string>
#include <string_view>

namespace swivel::tools {

// "left index 1" for LeftHandIndex1, index_01_l and f_index.01.L: the side, the finger and its bone, counted from the
// hand outwards. Empty if the name is none of a finger. plain_name: as plain() has it.
std::string finger_bone(std::string_view plain_name);

}  // namespace swivel::tools
