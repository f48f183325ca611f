// SPDX-License-Identifier: MIT
//
// What the library knows of its input fields, asked of crowds of one limb: nothing here has to be kept in step with it.
#pragma once

#include <array>
#include <cstdint>

#include "swivel/swivel.hpp"

namespace swivel::python {

// Numbers in a value of each field, by the field's number, of crowds with these features; 0 where they do not have it.
// Not those of the rows of a compact crowd, which are words.
std::array<std::uint32_t, SWIVEL_RESULT_END> component_counts(swivel_features features);

// The smallest set of features with which a crowd has an input field, and the numbers in its value then. 0 numbers for
// results.
struct FieldNeeds {
    swivel_features features;
    std::uint32_t component_count;
};
const FieldNeeds& needs_of(swivel_field field);

}  // namespace swivel::python
