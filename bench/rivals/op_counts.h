// SPDX-License-Identifier: MIT
//
// What a character costs, counted.
#pragma once

namespace bench {

struct OpCounts {
    int roots = 0, divisions = 0, multiplications = 0;
    int additions = 0;  // and subtractions
};

// The sum over the stages of character C (character.h): all joints, two planted feet on ground, the body's shift, the
// look, the rifle's arm, the one that holds its grip, and the legs.
OpCounts count_character_ops();

}  // namespace bench
