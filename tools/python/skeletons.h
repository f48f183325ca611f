// SPDX-License-Identifier: MIT
//
// Skeletons at rest, and the joints of limbs in them, as Python gives them. Knows no crowd.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <vector>

#include "swivel/swivel.h"
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

}  // namespace swivel::python
