// SPDX-License-Identifier: MIT
//
// What swivel needs of character C's rifle.
#pragma once

#include "swivel/swivel_regions.h"

namespace bench {

// Where its arm may point: kArmCones (character.h).
const swivel_region& rifle_region();

}  // namespace bench
