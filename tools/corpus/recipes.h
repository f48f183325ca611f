// SPDX-License-Identifier: MIT
//
// The tables of the corpus's crowds, part by part. Rows may be added at a table's end.
#pragma once

#include <span>

#include "tools/corpus/recipe.h"

namespace swivel::corpus {

// Both have the same sets of features: all of plain arms.
std::span<const Recipe> ordinary_recipes();
std::span<const Recipe> hard_recipes();
// Each feature alone, with what it needs, and sets of many.
std::span<const Recipe> limb_recipes();
// Each form of poses, and each thing that they may have; the features of limbs, many together.
std::span<const Recipe> body_recipes();
// Bodies of a few joints' movements, for the features that carry something from frame to frame.
std::span<const Recipe> standing_recipes();

}  // namespace swivel::corpus
