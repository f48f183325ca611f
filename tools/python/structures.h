// SPDX-License-Identifier: MIT
//
// Converts Python's skeletons at rest, limbs' joints, and constants of plants, shifts, grounds, props and looks. Knows
// no crowd.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "swivel/swivel_bodies.h"
#include "tools/python/arrays.h"

namespace swivel::python {

// A skeleton, and the arrays that it views.
struct SkeletonArrays {
    swivel_skeleton view;
    Input parents, translations, rotations;
};
// parents: (n,) whole numbers; translations: (n, 3); rotations: (n, 4), or None if no joint is turned at rest.
SkeletonArrays skeleton_of(const pybind11::object& parents, const pybind11::object& translations,
                           const pybind11::object& rotations);

// A limb's joints, and the list that they view. Moves keep the view, so there are no copies.
struct LimbJoints {
    swivel_limb_joints view;
    std::vector<std::uint32_t> twist_bones;

    LimbJoints() = default;
    LimbJoints(LimbJoints&&) = default;
    LimbJoints& operator=(LimbJoints&&) = default;
};
LimbJoints joints_of(std::int64_t shoulder, std::int64_t elbow, std::int64_t wrist,
                     const std::vector<std::int64_t>& twist_bones, const pybind11::object& bend);

// Makes the classes Plant, Ground, LookGroup, PropGroup and ShiftGroup in the module, of the constants that the library
// describes.
void add_constants(pybind11::module_& module);
// An object of each. TypeError for what is no number.
swivel_plant plant_of(const pybind11::object& given);
swivel_ground ground_of(const pybind11::object& given);
swivel_look_def look_of(const pybind11::handle& group);
swivel_prop_def prop_of(const pybind11::handle& group);
swivel_shift_def shift_of(const pybind11::handle& group);

// Supports of some bodies, and the arrays that they view.
struct SupportArrays {
    Input position, rotation;

    swivel_supports view() const { return {position.values, rotation.values}; }
};
// A swivel.Support, else TypeError. name is for messages.
SupportArrays supports_of(const char* name, const pybind11::object& given, std::size_t body_count);

}  // namespace swivel::python
