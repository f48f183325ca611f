// SPDX-License-Identifier: MIT
//
// Poses of bodies as Python gives them.
#pragma once

#include <vector>

#include "tools/python/crowd.h"

namespace swivel::python {

// A pose, and the arrays behind it.
struct PoseArrays {
    swivel_pose view;
    std::vector<pybind11::array> owners;
};

// A swivel.Pose of a crowd of bodies, else TypeError; ValueError or TypeError for arrays that do not go with the crowd.
PoseArrays pose_of(const HeldCrowd& held, const pybind11::object& given);

}  // namespace swivel::python
