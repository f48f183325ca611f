// SPDX-License-Identifier: MIT
//
// How limbs stand, how bodies are shifted for them, what they stand on, hold and look with, as Python gives these.
// Knows no crowd.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>

#include "swivel/swivel.h"
#include "tools/python/arrays.h"

namespace swivel::python {

// A swivel.Plant, a swivel.Ground, and the members of a swivel.FitGroup, a swivel.PropGroup and a swivel.LookGroup.
// TypeError for what is no number.
swivel_plant plant_of(const pybind11::object& given);
swivel_ground ground_of(const pybind11::object& given);
swivel_fit fit_of(const pybind11::handle& group);
swivel_prop prop_of(const pybind11::handle& group);
swivel_look look_of(const pybind11::handle& group);

// Supports of some bodies, and the arrays that they view.
struct SupportArrays {
    Input position, rotation;

    swivel_supports view() const { return {position.values, rotation.values}; }
};
// A swivel.Support, else TypeError. name is for messages.
SupportArrays supports_of(const char* name, const pybind11::object& given, std::size_t body_count);

}  // namespace swivel::python
